#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <map>
#include <ostream>

#include "tests/reference/runner.h"
#include "tests/reference/score.h"

// Every case of data/reference_cases.json, run by the library and judged by the tolerances that
// come with the case.

namespace limber::reference {

void PrintTo(const CaseRecord& record, std::ostream* out) { *out << record.id; }

namespace {

const std::vector<CaseRecord>& all_cases() {
  static const std::vector<CaseRecord> cases = read_cases(LIMBER_TEST_DATA "/reference_cases.json");
  return cases;
}

struct Judgement {
  std::string quantity;
  Grade grade;
  std::string text;  // quantity, error and tolerance
};

Judgement judged(const std::string& name, const nlohmann::json& expected,
                 const nlohmann::json& found) {
  const nlohmann::json& tolerance = expected.at(name).at("tol");
  if (!found.contains(name)) return {name, grade(INFINITY, tolerance), name + ": missing"};
  const double error = error_of_quantity(name, found, expected);
  return {name, grade(error, tolerance),
          fmt::format("{}: error {:.3g}, tolerance {}", name, error, tolerance.dump())};
}

// Runs each case once, whoever asks.
const std::vector<Judgement>& judgements_of(const CaseRecord& record) {
  static std::map<std::string, std::vector<Judgement>> known;
  const auto [entry, is_new] = known.try_emplace(record.id);
  if (!is_new) return entry->second;
  const Outcome outcome = run_case(record);
  const nlohmann::json found =
      outcome.quantities.is_null() ? nlohmann::json::object() : outcome.quantities;
  for (const std::string& reason : outcome.left_out) {
    fmt::print("left out {}: {}\n", record.id, reason);
  }
  for (const auto& [name, wanted] : record.expected.items()) {
    if (!is_input(wanted)) entry->second.push_back(judged(name, record.expected, found));
  }
  return entry->second;
}

class ReferenceCase : public testing::TestWithParam<CaseRecord> {};

TEST_P(ReferenceCase, IsGoodInEveryQuantity) {
  const std::vector<Judgement>& judgements = judgements_of(GetParam());
  EXPECT_FALSE(judgements.empty());
  for (const Judgement& judgement : judgements) {
    if (judgement.grade == Grade::kFailure) ADD_FAILURE() << judgement.text;
  }
}

std::string test_name(const testing::TestParamInfo<CaseRecord>& info) {
  std::string name = info.param.id;
  for (char& c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, ReferenceCase, testing::ValuesIn(all_cases()), test_name);

TEST(ReferenceCases, AreExcellentInNineOfTenQuantities) {
  int excellent = 0, asked_for = 0;
  for (const CaseRecord& record : all_cases()) {
    for (const Judgement& judgement : judgements_of(record)) {
      if (judgement.grade == Grade::kInformation) continue;
      ++asked_for;
      excellent += judgement.grade == Grade::kExcellent;
      if (judgement.grade != Grade::kExcellent) {
        fmt::print("not excellent: {} {}\n", record.id, judgement.text);
      }
    }
  }
  fmt::print("{} of {} quantities are excellent\n", excellent, asked_for);
  EXPECT_GT(asked_for, 0);
  EXPECT_GE(10 * excellent, 9 * asked_for);
}

// Nothing is left out by accident.
TEST(ReferenceCases, AllHaveAKind) {
  for (const CaseRecord& record : all_cases()) {
    EXPECT_TRUE(all_kinds().contains(kind_of(record.id))) << record.id;
  }
}

}  // namespace
}  // namespace limber::reference

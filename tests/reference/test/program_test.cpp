#include "tests/reference/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/temporary_folder.h"

// The command line of limber_reference: what it refuses, and that one bad case does not take the
// others with it.

namespace limber::reference {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

class ReferenceProgram : public testing::Test {
 protected:
  int run(const std::vector<std::string>& arguments) {
    std::vector<const char*> argv = {"limber_reference"};
    for (const std::string& argument : arguments) argv.push_back(argument.c_str());
    out_.str("");
    err_.str("");
    return program(static_cast<int>(argv.size()), argv.data(), out_, err_);
  }

  int run_on(const std::string& contents) {
    std::ofstream(cases_) << contents;
    return run({cases_, "-o", results_});
  }

  void expect_refused(const std::string& contents, const std::string& what) {
    EXPECT_EQ(run_on(contents), 2);
    const std::string said = err_.str();
    EXPECT_THAT(said, HasSubstr(what));
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
    EXPECT_FALSE(std::filesystem::exists(results_));
  }

  Json results() const { return Json::parse(std::ifstream(results_)); }

  test::TemporaryFolder folder_;
  std::string cases_ = folder_ / "cases.json";
  std::string results_ = folder_ / "results.json";
  std::ostringstream out_, err_;
};

constexpr const char* kHangingPoint = R"({"id": "G02.hanging_chain.x", "params":
  {"n": 1, "m": 2.0, "k": 100.0, "L0": 1.0, "m_end": 2.0, "g": 10.0}, "expected": {}})";

std::string file_of(const std::string& cases) { return R"({"cases": [)" + cases + "]}"; }

TEST_F(ReferenceProgram, WritesWhatItFound) {
  ASSERT_EQ(run_on(file_of(kHangingPoint)), 0) << err_.str();
  EXPECT_EQ(err_.str(), "");
  // 2 kg on 100 N/m at 10 m/s^2.
  EXPECT_NEAR(results()["G02.hanging_chain.x"]["total_extension"].get<double>(), 0.2, 1e-12);
}

TEST_F(ReferenceProgram, WritesTheOtherCasesWhenOneFails) {
  const std::string without_parameters =
      R"({"id": "G02.hanging_chain.y", "params": {}, "expected": {}})";
  const std::string unknown = R"({"id": "G99.perpetual_motion.z", "params": {}, "expected": {}})";
  ASSERT_EQ(run_on(file_of(without_parameters + "," + unknown + "," + kHangingPoint)), 0);
  EXPECT_EQ(results().size(), 1u);
  EXPECT_TRUE(results().contains("G02.hanging_chain.x"));
  EXPECT_THAT(err_.str(), HasSubstr("G02.hanging_chain.y: "));
  EXPECT_THAT(err_.str(), HasSubstr("there is no kind 'perpetual_motion'"));
}

TEST_F(ReferenceProgram, SaysWhichQuantityIsMissing) {
  Json item = Json::parse(kHangingPoint);
  item["expected"]["colour"] = {
      {"value", 1.0}, {"how", "closed form"}, {"tol", {{"kind", "rel"}, {"good", 0.1}}}};
  ASSERT_EQ(run_on(file_of(item.dump())), 0);
  EXPECT_THAT(err_.str(), HasSubstr("G02.hanging_chain.x: colour: "));
}

TEST_F(ReferenceProgram, RefusesAMissingFile) {
  EXPECT_EQ(run({cases_, "-o", results_}), 2);
  EXPECT_THAT(err_.str(), HasSubstr("cases.json: cannot be read"));
}

TEST_F(ReferenceProgram, RefusesWhatIsNoJson) { expect_refused("{\"cases\": [", "is not JSON"); }

TEST_F(ReferenceProgram, RefusesAnotherSchema) {
  expect_refused("[]", "has no list \"cases\"");
  expect_refused(R"({"cases": 3})", "has no list \"cases\"");
  expect_refused(file_of("4"), "case 0: is no object");
  expect_refused(file_of(R"({"params": {}})"), "case 0: has no \"id\"");
  expect_refused(file_of(R"({"id": "nameless"})"), "names no kind");
  expect_refused(file_of(R"({"id": "G1.a.b", "expected": {}})"), "has no \"params\"");
  expect_refused(file_of(R"({"id": "G1.a.b", "params": {}})"), "has no \"expected\"");
  expect_refused(file_of(R"({"id": "G1.a.b", "params": {}, "expected": {"x": {"how": "input"}}})"),
                 "x: has no \"value\"");
}

TEST_F(ReferenceProgram, RefusesTheSameIdTwice) {
  expect_refused(file_of(std::string(kHangingPoint) + "," + kHangingPoint), "id was there before");
}

TEST_F(ReferenceProgram, RefusesAnIncompleteCommandLine) {
  EXPECT_EQ(run({}), 2);
  EXPECT_EQ(run({cases_}), 2);
  EXPECT_THAT(err_.str(), HasSubstr("CASES.json -o RESULTS.json"));
  EXPECT_EQ(run({cases_, "-o", results_, "--fast"}), 2);
}

TEST_F(ReferenceProgram, RefusesAPlaceItCannotWriteTo) {
  std::ofstream(cases_) << file_of(kHangingPoint);
  EXPECT_EQ(run({cases_, "-o", folder_ / "nowhere/results.json"}), 2);
  EXPECT_THAT(err_.str(), HasSubstr("cannot be written"));
}

TEST_F(ReferenceProgram, ExplainsItself) {
  EXPECT_EQ(run({"--help"}), 0);
  EXPECT_THAT(out_.str(), HasSubstr("CASES"));
}

}  // namespace
}  // namespace limber::reference

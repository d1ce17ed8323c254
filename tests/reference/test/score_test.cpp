#include "tests/reference/score.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

// The judge itself: numbers computed by hand, and proof that it can fail.

namespace limber::reference {
namespace {

using Json = nlohmann::json;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Json tolerance(const char* kind) { return {{"kind", kind}, {"good", 0.01}, {"excellent", 1e-4}}; }

TEST(Score, RelativeErrorIsAShareOfTheLargestEntry) {
  EXPECT_DOUBLE_EQ(error_of({1.0, -8.5}, {1.5, -8.0}, tolerance("rel")), 0.5 / 8.0);
  EXPECT_DOUBLE_EQ(error_of(3.0, 2.0, tolerance("rel")), 0.5);
}

TEST(Score, RelativeErrorUsesTheScaleWhereGiven) {
  Json by_scale = tolerance("rel");
  by_scale["scale"] = 0.25;
  EXPECT_DOUBLE_EQ(error_of(3.0, 2.0, by_scale), 4.0);
}

TEST(Score, ZeroIsMetByZeroAlone) {
  EXPECT_EQ(error_of(0.0, 0.0, tolerance("rel")), 0.0);
  EXPECT_GT(error_of(1e-15, 0.0, tolerance("rel")), 1e200);
}

TEST(Score, AbsoluteErrorIsTheLargestDistance) {
  EXPECT_DOUBLE_EQ(error_of({1.0, 2.0}, {1.25, 1.0}, tolerance("abs")), 1.0);
}

TEST(Score, ExactMeansEqual) {
  EXPECT_EQ(error_of(7, 7, tolerance("exact")), 0.0);
  EXPECT_EQ(error_of(7.000001, 7, tolerance("exact")), kInfinity);
  EXPECT_EQ(error_of(true, true, tolerance("exact")), 0.0);
  EXPECT_EQ(error_of(false, true, tolerance("exact")), kInfinity);
}

TEST(Score, ListsOfWordsHaveToBeTheSame) {
  const Json words = {"nx", "ny"};
  EXPECT_EQ(error_of(words, words, tolerance("exact")), 0.0);
  EXPECT_EQ(error_of({"ny", "nx"}, words, tolerance("exact")), kInfinity);
}

TEST(Score, ShapesHaveToBeTheSame) {
  EXPECT_EQ(error_of({1.0, 2.0}, {1.0, 2.0, 3.0}, tolerance("rel")), kInfinity);
  EXPECT_EQ(error_of(1.0, Json::array({1.0}), tolerance("rel")), kInfinity);
  EXPECT_EQ(error_of({{1.0}, {2.0, 3.0}}, {{1.0, 2.0}, {3.0, 4.0}}, tolerance("rel")), kInfinity);
}

TEST(Score, WhatIsNoNumberIsInfinitelyWrong) {
  for (const Json& wrong : {Json("1"), Json(nullptr), Json::object(), Json(std::nan(""))}) {
    EXPECT_EQ(error_of(wrong, 1.0, tolerance("rel")), kInfinity) << wrong;
  }
}

TEST(Score, PartsAreJudgedByTheWorst) {
  const Json reference = {{"time", 2.0}, {"edge", 4}};
  EXPECT_DOUBLE_EQ(error_of({{"time", 2.0}, {"edge", 5}}, reference, tolerance("rel")), 0.25);
  EXPECT_EQ(error_of({{"time", 2.0}}, reference, tolerance("rel")), kInfinity);
}

TEST(Score, TablesAreJudgedEntryByEntry) {
  Json table = tolerance("rel");
  table["per_column"] = true;
  const Json reference = {{1.0, 1000.0}, {2.0, 4000.0}};
  EXPECT_DOUBLE_EQ(error_of({{1.0, 1000.0}, {2.5, 4000.0}}, reference, table), 0.25);
}

TEST(Score, ColumnsMayBeAbsoluteOrIgnored) {
  Json table = tolerance("rel");
  table["per_column"] = true;
  table["column_scale"] = {"value", "one", "-"};
  const Json reference = {{10.0, 100.0, 7.0}};
  EXPECT_DOUBLE_EQ(error_of(Json::array({{11.0, 100.0, 7.0}}), reference, table), 0.1);
  EXPECT_DOUBLE_EQ(error_of(Json::array({{10.0, 103.0, 7.0}}), reference, table), 3.0);
  EXPECT_DOUBLE_EQ(error_of(Json::array({{10.0, 100.0, 99.0}}), reference, table), 0.0);
}

TEST(GroupSums, AddWhatHasEqualKeys) {
  const Json keys = {1.0, 1.0 + 1e-9, 1.0 + 1e-5, 2.0, 2.0, 2.0};
  EXPECT_EQ(group_sums({1.0, 2.0, 4.0, 8.0, 16.0, 32.0}, keys), Json({3.0, 4.0, 56.0}));
  EXPECT_EQ(group_sums(Json::array(), Json::array()), Json::array());
}

Json modes(const char* how) {
  return {{"mode_omega", {{"value", {5.0, 5.0, 7.0}}}},
          {"energies", {{"value", {1.0, 3.0, 4.0}}, {"how", how}, {"tol", tolerance("rel")}}}};
}

TEST(ErrorOfQuantity, ComparesGroupSumsWhereTheCaseSaysSo) {
  const Json expected = modes("projections (degenerate groups: compare group sums)");
  EXPECT_EQ(error_of_quantity("energies", {{"energies", {2.0, 2.0, 4.0}}}, expected), 0.0);
  EXPECT_DOUBLE_EQ(error_of_quantity("energies", {{"energies", {2.0, 3.0, 4.0}}}, expected), 0.25);
  EXPECT_DOUBLE_EQ(error_of_quantity("energies", {{"energies", {1.0, 3.0, 5.0}}}, expected), 0.25);
}

TEST(ErrorOfQuantity, ComparesEntriesElsewhere) {
  const Json found = {{"energies", {2.0, 2.0, 4.0}}};
  EXPECT_DOUBLE_EQ(error_of_quantity("energies", found, modes("projections")), 0.25);
}

TEST(ErrorOfQuantity, TakesNoListOfAnotherLength) {
  const Json expected = modes("compare group sums");
  for (const Json& wrong : {Json({4.0, 4.0}), Json({1.0, 3.0, "4"}), Json(8.0)}) {
    EXPECT_EQ(error_of_quantity("energies", {{"energies", wrong}}, expected), kInfinity) << wrong;
  }
}

TEST(Score, GradesByTheTwoLimits) {
  EXPECT_EQ(grade(1e-4, tolerance("rel")), Grade::kExcellent);
  EXPECT_EQ(grade(1.1e-4, tolerance("rel")), Grade::kGood);
  EXPECT_EQ(grade(0.011, tolerance("rel")), Grade::kFailure);
  EXPECT_EQ(grade(kInfinity, tolerance("rel")), Grade::kFailure);
  EXPECT_EQ(grade(9.0, {{"kind", "rel"}, {"good", nullptr}, {"excellent", nullptr}}),
            Grade::kInformation);
}

}  // namespace
}  // namespace limber::reference

#include "core/model/median.h"

#include <gtest/gtest.h>

namespace limber {
namespace {

TEST(UpperMedian, IsZeroForNone) { EXPECT_EQ(upper_median({}), 0.0); }

TEST(UpperMedian, IsTheOnlyOne) { EXPECT_EQ(upper_median({-7.5}), -7.5); }

TEST(UpperMedian, IsTheMiddleOfAnOddNumber) {
  EXPECT_EQ(upper_median({9.0, -1.0, 4.0}), 4.0);
  EXPECT_EQ(upper_median({5.0, 1.0, 4.0, 2.0, 3.0}), 3.0);
}

TEST(UpperMedian, IsTheLargerMiddleOneOfAnEvenNumber) {
  EXPECT_EQ(upper_median({2.0, 1.0}), 2.0);
  EXPECT_EQ(upper_median({4.0, 1.0, 3.0, 2.0}), 3.0);
}

TEST(UpperMedian, CountsEqualValuesEach) { EXPECT_EQ(upper_median({1.0, 8.0, 1.0, 1.0}), 1.0); }

}  // namespace
}  // namespace limber

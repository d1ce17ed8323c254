#include "core/environment/track.h"

#include <gtest/gtest.h>

namespace limber {
namespace {

TEST(Track, IsLinearBetweenItsKeysAndConstantBeyond) {
  const Track<double> track({{1.0, 10.0}, {2.0, 20.0}, {4.0, 0.0}});
  EXPECT_EQ(track.at(-5.0), 10.0);
  EXPECT_EQ(track.at(1.0), 10.0);
  EXPECT_DOUBLE_EQ(track.at(1.25), 12.5);
  EXPECT_EQ(track.at(2.0), 20.0);
  EXPECT_DOUBLE_EQ(track.at(3.5), 5.0);
  EXPECT_EQ(track.at(4.0), 0.0);
  EXPECT_EQ(track.at(99.0), 0.0);
  EXPECT_EQ(Track<double>(7.0).at(3.0), 7.0);
}

}  // namespace
}  // namespace limber

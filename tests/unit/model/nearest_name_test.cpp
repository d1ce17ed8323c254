#include "core/model/nearest_name.h"

#include <gtest/gtest.h>

namespace limber {
namespace {

TEST(EditDistance, CountsLettersToChange) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);  // the textbook's example
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("steel", "steel"), 0u);
}

TEST(NearestName, IsTheOneWithTheFewestChanges) {
  struct Named {
    std::string_view name;
  };
  const std::vector<Named> items = {{"oak"}, {"spruce"}, {"steel"}};
  EXPECT_EQ(nearest_name(items, "stell"), "steel");
  EXPECT_EQ(nearest_name(items, "sprce"), "spruce");
}

}  // namespace
}  // namespace limber

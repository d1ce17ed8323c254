#include "demos/cli/progress_bar.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace limber::demos {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

TEST(ProgressBar, SaysNothingInAPipe) {
  std::ostringstream stream;
  {
    ProgressBar bar(stream);
    bar.show("teapot", 0.5);
  }
  EXPECT_EQ(stream.str(), "");
}

TEST(ProgressBar, CleansUpOnATerminal) {
  std::ostringstream stream;
  {
    ProgressBar bar(stream, true);
    bar.show("teapot", 0.5);
  }
  EXPECT_THAT(stream.str(), HasSubstr("teapot [###############...............]  50 %"));
  EXPECT_THAT(stream.str(), EndsWith("\r\x1b[K"));
}

TEST(ProgressBar, IsNotRedrawnAtEveryCall) {
  std::ostringstream stream;
  ProgressBar bar(stream, true);
  bar.show("teapot", 0.0);
  const std::size_t once = stream.str().size();
  for (int i = 0; i < 100; ++i) bar.show("teapot", 0.001 * i);
  EXPECT_LE(stream.str().size(), 3 * once);
}

}  // namespace
}  // namespace limber::demos

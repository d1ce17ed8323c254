#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "demos/cli/comparison.h"
#include "tests/end_to_end/slow/teapot_runs.h"

// Breaking is chaotic: any two runs break into different pieces. The switching run must not differ
// from flexible ones by much more than these differ from one another.

namespace limber::demos::test {
namespace {

// The least that gives more than one pair, to bound the time of a test. The full measurement is
// `limber compare tipsy_teapot --noise 5`.
constexpr std::size_t kRuns = 3;

std::vector<RunResult> runs_of(Policy policy) {
  std::vector<RunResult> runs;
  for (std::size_t k = 0; k < kRuns; ++k) runs.push_back(teapot_run(policy, k).result);
  return runs;
}

TEST(TipsyTeapotNoise, FragmentsDifferHardlyMoreThanThoseOfFlexibleRuns) {
  const std::vector<RunResult> flexible = runs_of(Policy::kFlexible);
  const std::vector<RunResult> switching = runs_of(Policy::kSwitching);
  const auto noise = noise_of(flexible).fragment_mass_l1;
  const auto error = error_of(flexible, switching).fragment_mass_l1;
  ASSERT_TRUE(noise && error);
  ASSERT_GT(*noise, 0.0) << "runs at different steps must not be the same run";
  RecordProperty("noise", std::to_string(*noise));
  RecordProperty("error", std::to_string(*error));
  EXPECT_LE(*error, 1.3 * *noise) << "noise floor " << *noise;
}

}  // namespace
}  // namespace limber::demos::test

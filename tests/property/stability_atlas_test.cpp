// The rule of the stability atlas, on its fast part: nothing crashes, hangs or carries a NaN on;
// well within the analytic limit nothing stops or grows.

#include "core/analysis/stability_atlas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

namespace limber {
namespace {

const StabilityAtlas& fast_atlas() {
  static const StabilityAtlas atlas = make_stability_atlas(AtlasExtent::kFast);
  return atlas;
}

TEST(StabilityAtlas, HasNoCaseThatBreaksTheRule) {
  for (const StabilityResult& r : fast_atlas().cases) {
    EXPECT_EQ(r.violation, "") << r.tried.sweep << ", " << r.tried.scheme.name << ", stiffness "
                               << r.tried.stiffness << ", damping ratio " << r.tried.damping_ratio
                               << ", mass ratio " << r.tried.mass_ratio << ", step " << r.step;
  }
}

// A rule that nothing comes near would prove nothing.
TEST(StabilityAtlas, HasCasesOnBothSidesOfTheLimit) {
  std::map<std::string, std::map<StabilityOutcome, int>> counts;
  for (const StabilityResult& r : fast_atlas().cases) ++counts[r.tried.scheme.name][r.outcome];
  for (const Scheme& scheme : schemes()) {
    EXPECT_GT(counts[scheme.name][StabilityOutcome::kStable], 20) << scheme.name;
    EXPECT_GT(counts[scheme.name][StabilityOutcome::kRefused], 5) << scheme.name;
    if (!std::isfinite(scheme.step_limit(1.0, 0.1))) continue;
    EXPECT_GT(counts[scheme.name][StabilityOutcome::kStopped], 20) << scheme.name;
  }
}

// Explicit Euler just above its limit grows by less in 512 steps than is counted as growth.
TEST(StabilityAtlas, HasNoStableCaseFarBeyondTheLimit) {
  for (const StabilityResult& r : fast_atlas().cases) {
    if (!vibrates_little(r.tried) || !(r.step > 1.5 * r.limit) || r.limit == 0.0) continue;
    EXPECT_NE(r.outcome, StabilityOutcome::kStable)
        << r.tried.scheme.name << ", step " << r.step << " s, limit " << r.limit << " s";
  }
}

TEST(StabilityAtlas, FindsTheLimitsOfChainsWithAnyMassRatio) {
  for (const LimitSample& l : fast_atlas().mass_ratio) {
    if (!std::isfinite(l.analytic)) {
      EXPECT_TRUE(std::isinf(l.measured)) << l.at;
    } else {
      EXPECT_NEAR(l.measured / l.analytic, 1.0, 0.01) << l.at;
    }
  }
}

TEST(StabilityAtlas, IsTheSameEveryTime) {
  StabilityCase one;
  one.scheme = schemes().front();
  one.damping_ratio = 0.1;
  one.motion = Motion::kScatter;
  one.speed = 30.0;
  EXPECT_EQ(try_case(one).growth, try_case(one).growth);
}

TEST(TryCase, NamesTheBodyOfWhatStopped) {
  StabilityCase one;
  one.scheme = schemes().front();
  one.step = 100.0;
  const StabilityResult result = try_case(one);
  EXPECT_EQ(result.outcome, StabilityOutcome::kStopped);
  EXPECT_TRUE(result.message.starts_with("block: point "));
  EXPECT_EQ(result.violation, "");
}

// An integrator with a wrong limit is found out: the rule can be broken.
TEST(TryCase, SeesWhatGrowsOrStopsWithinTheLimit) {
  StabilityCase one;
  one.scheme = schemes().front();
  one.scheme.step_limit = [](double omega, double) { return 2.3 / omega; };
  one.model = StabilityModel::kChain;
  one.step = 0.9;
  EXPECT_NE(try_case(one).violation, "");
  one.step = 0.8;  // 1.84 / omega
  EXPECT_EQ(try_case(one).violation, "");
}

}  // namespace
}  // namespace limber

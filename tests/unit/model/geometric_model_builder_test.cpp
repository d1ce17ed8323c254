#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "core/model/geometric_model.h"

namespace limber {
namespace {

GeometricModelBuilder with_points(int count) {
  GeometricModelBuilder builder;
  builder.begin_subobject("points");
  for (int i = 0; i < count; ++i) builder.add_point(Vec3(i, 0, 0));
  return builder;
}

// Random pairs, most of them asked for several times and either way round, and a hub that has an
// edge to every point: against a map of what was given before.
TEST(GeometricModelBuilder, GivesEveryPairOfPointsOneEdge) {
  constexpr int kPoints = 60;
  GeometricModelBuilder builder = with_points(kPoints);
  std::map<std::pair<PointId, PointId>, EdgeId> given;
  std::mt19937 random(11);
  for (int n = 0; n < 6000; ++n) {
    const PointId a(n % 3 == 0 ? std::size_t{7} : random() % kPoints), b(random() % kPoints);
    if (a == b) continue;
    const EdgeId e = builder.edge(a, b);
    const auto [known, is_new] = given.try_emplace(std::minmax(a, b), e);
    EXPECT_EQ(known->second, e);
    if (is_new) {
      EXPECT_EQ(e.index() + 1, given.size());
    }
  }
  const GeometricModel model = builder.finish();
  ASSERT_EQ(model.edges.size(), given.size());
  for (const auto& [pair, e] : given) {
    EXPECT_EQ(model.edges[e].a, pair.first);  // the smaller id first
    EXPECT_EQ(model.edges[e].b, pair.second);
  }
}

TEST(GeometricModelBuilder, StartsAnewAfterFinish) {
  GeometricModelBuilder builder = with_points(3);
  builder.edge(PointId(0ul), PointId(1ul));
  builder.finish();
  builder.begin_subobject("again");
  const PointId a = builder.add_point(Vec3::Zero()), b = builder.add_point(Vec3::UnitX());
  EXPECT_EQ(builder.edge(a, b), EdgeId(0ul));
  EXPECT_EQ(builder.finish().edges.size(), 1u);
}

}  // namespace
}  // namespace limber

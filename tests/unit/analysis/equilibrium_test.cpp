#include "core/analysis/equilibrium.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/model/errors.h"
#include "tests/support/blocks.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

const Vec3 kGravity(0.0, 0.0, -9.81);

PhysicalModel pinned_chain(const test::ChainShape& shape, std::vector<int> pins) {
  PhysicalModel model = test::chain(shape);
  for (int p : pins) model.points[PointId(p)].pinned = true;
  return model;
}

double tension(const PhysicalModel& model, EdgeId e) {
  const auto [a, b] = model.geometry.edges[e];
  const double length = (model.geometry.points[b] - model.geometry.points[a]).norm();
  return model.edges[e].stiffness * (length - model.edges[e].rest_length);
}

Vec3 pull_on_first(const PhysicalModel& model, EdgeId e) {
  const auto [a, b] = model.geometry.edges[e];
  return tension(model, e) * (model.geometry.points[b] - model.geometry.points[a]).normalized();
}

// z of the points of a chain that hangs from its first point: edge j carries all that is below it.
std::vector<double> hanging_heights(const test::ChainShape& shape) {
  std::vector<double> z(shape.points, 0.0);
  for (int j = 1; j < shape.points; ++j) {
    const double load = (shape.points - j) * shape.mass * 9.81;
    z[j] = z[j - 1] - shape.spacing - load / shape.stiffness;
  }
  return z;
}

TEST(Settle, HangingChainHasItsClosedForm) {
  const test::ChainShape shape{
      .points = 11, .stiffness = 500.0, .mass = 0.1, .spacing = 0.1, .along = -Vec3::UnitZ()};
  PhysicalModel model = pinned_chain(shape, {0});
  model.points[PointId(4)].velocity = Vec3::Ones();
  const Equilibrium result = settle(model, kGravity);
  EXPECT_TRUE(result.converged);
  const std::vector<double> z = hanging_heights(shape);
  for (PointId p : ids_of(model.points)) {
    EXPECT_LT((model.geometry.points[p] - Vec3(0.0, 0.0, z[p.index()])).norm(), 1e-14);
    EXPECT_EQ(model.points[p].velocity, Vec3::Zero());
  }
  EXPECT_NEAR(support_forces(model, kGravity)[PointId(0)].z(), 11 * 0.1 * 9.81, 1e-12);
}

// One point between two supports 2 w apart: 2 k (L - L0) s / L = m g with s the sag, L^2 = w^2 +
// s^2.
double sag_between_supports(double w, double rest_length, double k, double weight) {
  double low = 0.0, high = 10.0;
  for (int i = 0; i < 200; ++i) {
    const double s = 0.5 * (low + high), length = std::hypot(w, s);
    (2.0 * k * (length - rest_length) * s / length < weight ? low : high) = s;
  }
  return low;
}

TEST(Settle, PointBetweenTwoSupports) {
  // Slack or squeezed at first, so that the stiffness across is nil or negative.
  for (double rest_length : {0.9, 1.0, 1.3}) {
    PhysicalModel model = pinned_chain({.points = 3, .stiffness = 1e4}, {0, 2});
    for (EdgeAttributes& e : model.edges) e.rest_length = rest_length;
    EXPECT_TRUE(settle(model, kGravity).converged);
    const double sag = sag_between_supports(1.0, rest_length, 1e4, 9.81);
    EXPECT_LT((model.geometry.points[PointId(1)] - Vec3(1.0, 0.0, -sag)).norm(), 1e-13);
  }
}

// Horizontal tension is the same everywhere, vertical tension grows by a weight from edge to edge.
void expect_catenary(const PhysicalModel& model) {
  for (EdgeId e : ids_of(model.edges)) {
    EXPECT_GT(tension(model, e), 0.0);
    if (e.index() == 0) continue;
    const Vec3 jump = pull_on_first(model, e) - pull_on_first(model, EdgeId(e.index() - 1));
    const double weight = 9.81 * model.points[model.geometry.edges[e].a].mass;
    EXPECT_LT((jump - Vec3(0.0, 0.0, weight)).norm(), 1e-9 * weight);
  }
}

TEST(Settle, RopeFromASqueezedStraightLine) {
  for (double squeezed : {0.5, 0.9, 0.999}) {
    PhysicalModel model = pinned_chain(
        {.points = 51, .stiffness = 1e4, .mass = 0.02, .spacing = squeezed * 0.02}, {0, 50});
    for (EdgeAttributes& e : model.edges) e.rest_length = 0.02;
    const Equilibrium result = settle(model, kGravity);
    EXPECT_TRUE(result.converged);
    EXPECT_LT(result.iterations, 200);
    expect_catenary(model);
  }
}

TEST(Settle, FarFromTheOriginToo) {
  test::ChainShape shape{.points = 21, .stiffness = 1e4, .mass = 0.02, .spacing = 0.05};
  PhysicalModel near = pinned_chain(shape, {0, 20});
  shape.origin = {1e4, -2e4, 3e4};
  PhysicalModel far = pinned_chain(shape, {0, 20});
  // Rest lengths as far away rounding leaves them would differ from edge to edge.
  for (EdgeAttributes& e : far.edges) e.rest_length = 0.05;
  EXPECT_TRUE(settle(near, kGravity).converged);
  EXPECT_TRUE(settle(far, kGravity).converged);
  for (PointId p : ids_of(near.points)) {
    const Vec3 same = far.geometry.points[p] - shape.origin;
    EXPECT_LT((same - near.geometry.points[p]).norm(), 1e-9);
  }
}

TEST(Settle, SqueezedStrutBucklesWithoutGravity) {
  PhysicalModel model = pinned_chain({.points = 11, .spacing = 0.8}, {0, 10});
  for (EdgeAttributes& e : model.edges) e.rest_length = 1.0;
  EXPECT_TRUE(settle(model, Vec3::Zero()).converged);
  for (EdgeId e : ids_of(model.edges)) EXPECT_NEAR(tension(model, e), 0.0, 1e-10);
}

TEST(Settle, ChainStandingOnItsEndFallsAndHangs) {
  test::ChainShape shape{.points = 21, .stiffness = 1e4, .mass = 0.05, .spacing = 0.05};
  shape.along = Vec3::UnitZ();
  PhysicalModel model = pinned_chain(shape, {0});
  EXPECT_TRUE(settle(model, kGravity).converged);
  EXPECT_NEAR(model.geometry.points[PointId(20)].z(), hanging_heights(shape).back(), 1e-12);
}

TEST(Settle, FreeStrainedBlockReturnsToItsShape) {
  PhysicalModel model = test::block({.cells = {2, 2, 2}});
  for (Vec3& p : model.geometry.points) p.x() *= 1.1;
  EXPECT_TRUE(settle(model, Vec3::Zero()).converged);
  for (EdgeId e : ids_of(model.edges)) EXPECT_NEAR(tension(model, e), 0.0, 1e-10);
}

TEST(Settle, LeavesLooseAndPinnedPointsAlone) {
  PhysicalModel model = pinned_chain({.points = 4}, {0, 1});
  model.edges[EdgeId(2)].broken = true;
  const auto before = model.geometry.points;
  EXPECT_TRUE(settle(model, kGravity).converged);
  for (int p : {0, 1, 3}) EXPECT_EQ(model.geometry.points[PointId(p)], before[PointId(p)]);
  EXPECT_NE(model.geometry.points[PointId(2)], before[PointId(2)]);
}

TEST(Settle, ModelWithoutSprings) {
  PhysicalModel model = test::chain({.points = 1});
  EXPECT_TRUE(settle(model, kGravity).converged);
}

TEST(Settle, SaysSoWhenIterationsDoNotSuffice) {
  PhysicalModel model = pinned_chain({.points = 21, .spacing = 0.9}, {0, 20});
  for (EdgeAttributes& e : model.edges) e.rest_length = 1.0;
  const Equilibrium result = settle(model, kGravity, {.most_iterations = 3});
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.iterations, 3);
}

TEST(Settle, RefusesWhatFallsForEver) {
  PhysicalModel model = pinned_chain({.points = 4}, {0});
  model.edges[EdgeId(1)].broken = true;
  EXPECT_THROW(settle(model, kGravity), InputError);
}

TEST(LinearSag, IsTheLimitOfWeakGravity) {
  constexpr double kWeak = 1e-6;
  PhysicalModel block = test::block({.cells = {1, 1, 4}});
  for (int p = 0; p < 4; ++p) block.points[PointId(p)].pinned = true;
  PhysicalModel settled = block;
  ASSERT_TRUE(settle(settled, kWeak * kGravity).converged);
  const IdVector<PointId, Vec3> sag = linear_sag(block, kGravity);
  for (PointId p : ids_of(sag)) {
    const Vec3 moved = (settled.geometry.points[p] - block.geometry.points[p]) / kWeak;
    EXPECT_LT((moved - sag[p]).norm(), 1e-5 * sag[PointId(19)].norm());
  }
}

TEST(LinearSag, RefusesWhatMovesWithoutForce) {
  const PhysicalModel chain = pinned_chain({.points = 4}, {0, 3});
  EXPECT_THROW(linear_sag(chain, kGravity), InputError);
  PhysicalModel hinged = test::block({});
  hinged.points[PointId(0)].pinned = hinged.points[PointId(1)].pinned = true;
  EXPECT_THROW(linear_sag(hinged, kGravity), InputError);
  EXPECT_THROW(linear_sag(test::block({}), kGravity), InputError);
}

TEST(SupportForces, CarryTheWholeWeight) {
  PhysicalModel model = test::block({.cells = {3, 1, 1}});
  for (EdgeAttributes& e : model.edges) e.stiffness = 5000.0;
  for (PointId p : ids_of(model.points)) model.points[p].pinned = p.index() % 4 == 0;
  EXPECT_TRUE(settle(model, kGravity).converged);
  Vec3 sum = Vec3::Zero();
  for (const Vec3& force : support_forces(model, kGravity)) sum += force;
  EXPECT_LT((sum - Vec3(0.0, 0.0, 16 * 9.81)).norm(), 1e-9);
}

}  // namespace
}  // namespace limber

#include "core/analysis/tangent_stiffness.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/blocks.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

// A stressed block: points moved off their places, one pinned, one edge broken.
PhysicalModel stressed_block() {
  PhysicalModel model = test::block({.cells = {2, 1, 1}});
  std::mt19937 random(7);
  for (Vec3& p : model.geometry.points) p += test::random_vector(random, 0.2);
  for (EdgeAttributes& e : model.edges) e.stiffness = 50.0 + static_cast<double>(random() % 100);
  model.points[PointId(3)].pinned = true;
  model.edges[EdgeId(5)].broken = true;
  return model;
}

Eigen::VectorXd free_forces(const PhysicalModel& model, const FreePoints& free) {
  const IdVector<PointId, Vec3> force = spring_forces(model);
  Eigen::VectorXd stacked(free.size());
  for (PointId p : free.points) stacked.segment<3>(free.row[p]) = force[p];
  return stacked;
}

TEST(TangentStiffness, IsTheDerivativeOfTheForces) {
  constexpr double kStep = 1e-5;  // m; central differences err by its square
  PhysicalModel model = stressed_block();
  const FreePoints free = unpinned_points(model);
  const Eigen::MatrixXd lower = tangent_stiffness(model, free);
  const Eigen::MatrixXd stiffness = lower.selfadjointView<Eigen::Lower>();
  for (PointId p : free.points) {
    for (int axis = 0; axis < 3; ++axis) {
      double& x = model.geometry.points[p][axis];
      const double before = x;
      x = before + kStep;
      const Eigen::VectorXd forward = free_forces(model, free);
      x = before - kStep;
      const Eigen::VectorXd backward = free_forces(model, free);
      x = before;
      const Eigen::VectorXd column = (backward - forward) / (2.0 * kStep);
      EXPECT_LT((column - stiffness.col(free.row[p] + axis)).norm(), 1e-8 * stiffness.norm());
    }
  }
}

TEST(TangentStiffness, OfOneSpring) {
  const Mat3 slack = spring_stiffness(100.0, 2.0, {2.0, 0.0, 0.0});
  EXPECT_TRUE(slack.isApprox(Vec3(100.0, 0.0, 0.0).asDiagonal().toDenseMatrix()));
  // Tension 300 N over 5 m turns with the spring: 60 N/m across.
  const Mat3 taut = spring_stiffness(100.0, 2.0, {0.0, 3.0, 4.0});
  EXPECT_NEAR((taut * Vec3::UnitX()).x(), 60.0, 1e-12);
  EXPECT_NEAR(Vec3(0.0, 0.6, 0.8).dot(taut * Vec3(0.0, 0.6, 0.8)), 100.0, 1e-12);
  EXPECT_EQ(spring_stiffness(100.0, 2.0, Vec3::Zero()), Mat3::Zero());
}

TEST(TangentStiffness, OfABlockIsBlindToTranslation) {
  PhysicalModel model = stressed_block();
  model.points[PointId(3)].pinned = false;
  const FreePoints free = unpinned_points(model);
  const SparseMatrix lower = tangent_stiffness(model, free);
  const Eigen::VectorXd moved = Vec3(1.0, 2.0, 3.0).replicate(free.points.size(), 1);
  const Eigen::VectorXd force = lower.selfadjointView<Eigen::Lower>() * moved;
  EXPECT_LT(force.norm(), 1e-11 * lower.norm());
}

TEST(FreePoints, LeavePinnedAndOnRequestLoosePointsOut) {
  PhysicalModel model = test::chain({.points = 4});
  model.points[PointId(1)].pinned = true;
  model.edges[EdgeId(2)].broken = true;  // point 3 is loose then
  EXPECT_EQ(unpinned_points(model).points, (std::vector{PointId(0), PointId(2), PointId(3)}));
  const FreePoints sprung = sprung_points(model);
  EXPECT_EQ(sprung.points, (std::vector{PointId(0), PointId(2)}));
  EXPECT_EQ(sprung.row[PointId(2)], 3);
  EXPECT_EQ(sprung.row[PointId(3)], -1);
}

TEST(SpringForces, PullTogetherWhenStretchedAndCancel) {
  PhysicalModel model = test::chain({.points = 2, .stiffness = 100.0, .spacing = 1.0});
  model.geometry.points[PointId(1)].x() = 1.5;
  const IdVector<PointId, Vec3> force = spring_forces(model);
  EXPECT_EQ(force[PointId(0)], Vec3(50.0, 0.0, 0.0));
  EXPECT_EQ(force[PointId(1)], Vec3(-50.0, 0.0, 0.0));
}

}  // namespace
}  // namespace limber

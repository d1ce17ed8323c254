#include "core/dynamics/element_bound.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

#include "core/dynamics/stable_step.h"
#include "tests/support/blocks.h"

namespace limber {
namespace {

// Two points, no cell: the bond is the only element.
TEST(ElementBound, OfADumbbellIsExact) {
  GeometricModelBuilder builder;
  builder.begin_subobject("dumbbell");
  builder.edge(builder.add_point(Vec3::Zero()), builder.add_point(Vec3::UnitX()));
  PhysicalModel model = with_default_attributes(builder.finish(), "dumbbell");
  model.points[PointId(std::size_t{0})].mass = 2.0;
  model.points[PointId(std::size_t{1})].mass = 3.0;
  model.edges[EdgeId(std::size_t{0})].stiffness = 60.0;
  EXPECT_NEAR(element_frequency_bound(model), std::sqrt(60.0 / 2.0 + 60.0 / 3.0), 1e-7);
}

// One element: its own eigenvalue, which the factorisation meets within a few per cent.
TEST(ElementBound, OfOneCellIsExact) {
  const PhysicalModel model = test::block({});
  const double proved = highest_frequency(model).omega_max;
  EXPECT_LE(element_frequency_bound(model), proved * (1.0 + 1e-6));
  EXPECT_GE(element_frequency_bound(model), proved / 1.06);
}

TEST(ElementBound, OfABlockIsNotBelowTheProvedFrequencyLessItsMargin) {
  const PhysicalModel model = test::block({.cells = {4, 3, 2}});
  EXPECT_GE(element_frequency_bound(model), highest_frequency(model).omega_max / 1.06);
}

// The definition, one dense matrix over all points for each element and nothing remembered. Springs
// under tension are stiff across as well.
double plain_bound(const PhysicalModel& model) {
  const IndexRows cells_of = edge_cells(model.geometry);
  std::vector<double> total(model.points.size(), 0.0);
  for (EdgeId e : ids_of(model.edges)) {
    total[model.geometry.edges[e].a.index()] += model.edges[e].stiffness;
    total[model.geometry.edges[e].b.index()] += model.edges[e].stiffness;
  }
  double largest = 0.0;
  for (const Cell& cell : model.geometry.cells) {
    const auto n = static_cast<Eigen::Index>(3 * model.points.size());
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd share = Eigen::VectorXd::Zero(n);
    for (EdgeId e : cell.edges) {
      const auto [a, b] = model.geometry.edges[e];
      const double k = model.edges[e].stiffness / static_cast<double>(cells_of[e.index()].size());
      const Vec3 d = model.geometry.points[b] - model.geometry.points[a];
      const double tension = std::max(0.0, 1.0 - model.edges[e].rest_length / d.norm());
      const Vec3 first = d.unitOrthogonal(), second = d.normalized().cross(first);
      for (const auto& [direction, share_of_k] :
           {std::pair(Vec3(d.normalized()), 1.0), {first, tension}, {second, tension}}) {
        Eigen::VectorXd along = Eigen::VectorXd::Zero(n);
        along.segment<3>(3 * b.value) = direction;
        along.segment<3>(3 * a.value) = -direction;
        K += share_of_k * k * along * along.transpose();
      }
      share.segment<3>(3 * a.value).array() += k;
      share.segment<3>(3 * b.value).array() += k;
    }
    Eigen::VectorXd scale = Eigen::VectorXd::Zero(n);
    for (PointId p : ids_of(model.points)) {
      const double mass = model.points[p].mass * share[3 * p.value] / total[p.index()];
      if (mass > 0.0) scale.segment<3>(3 * p.value).array() = 1.0 / std::sqrt(mass);
    }
    const Eigen::MatrixXd scaled = scale.asDiagonal() * K * scale.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled, Eigen::EigenvaluesOnly);
    largest = std::max(largest, solver.eigenvalues().maxCoeff());
  }
  return std::sqrt(largest);
}

// Congruent elements are solved once: the result has to be that of solving each.
TEST(ElementBound, IsThatOfEveryElementByItself) {
  const PhysicalModel regular = test::block({.cells = {3, 2, 2}, .spacing = 0.1});
  EXPECT_NEAR(element_frequency_bound(regular) / plain_bound(regular), 1.0, 2e-9);
  PhysicalModel irregular = regular;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> factor(0.5, 2.0);
  for (PointAttributes& p : irregular.points) p.mass *= factor(random);
  for (EdgeAttributes& e : irregular.edges) e.stiffness *= factor(random);
  for (Vec3& x : irregular.geometry.points) x += 0.01 * Vec3(factor(random), factor(random), 0);
  EXPECT_NEAR(element_frequency_bound(irregular) / plain_bound(irregular), 1.0, 2e-9);
}

// Light points between anchors of a million tonnes: the frequency is theirs, and two light points
// that differ must not be taken for each other because the anchors dwarf both.
TEST(ElementBound, TellsLightPointsBesideHeavyOnesApart) {
  PhysicalModel model = test::block({.cells = {4, 1, 1}, .spacing = 0.1});
  for (PointId p : ids_of(model.points)) {
    const double x = model.geometry.points[p].x();
    model.points[p].mass = x < 0.05 ? 1.4e-3 : x > 0.35 ? 0.5e-3 : 1e9;
  }
  EXPECT_NEAR(element_frequency_bound(model) / plain_bound(model), 1.0, 2e-9);
}

// One light point, found among hundreds of congruent elements.
TEST(ElementBound, DoesNotMissTheOneElementThatDiffers) {
  PhysicalModel model = test::block({.cells = {5, 5, 5}, .spacing = 0.1});
  const double before = element_frequency_bound(model);
  model.points[PointId(100ul)].mass /= 4.0;
  EXPECT_GT(element_frequency_bound(model), 1.3 * before);
}

TEST(ElementBound, OfNothingButBrokenEdgesIsZero) {
  PhysicalModel model = test::block({});
  for (EdgeAttributes& e : model.edges) e.broken = true;
  EXPECT_EQ(element_frequency_bound(model), 0.0);
}

}  // namespace
}  // namespace limber

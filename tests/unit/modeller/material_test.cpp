#include "core/modeller/material.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "core/dynamics/stable_step.h"
#include "core/model/errors.h"
#include "core/model/validate.h"
#include "tests/support/blocks.h"

namespace limber {
namespace {

using test::block_geometry;
using test::BlockShape;
using ::testing::HasSubstr;

constexpr double kModulus = 2e6;  // Pa
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Material rubber() {
  Material m;
  m.density = 1000.0;
  m.youngs_modulus = kModulus;
  m.strain_at_break = 0.1;
  m.damping_ratio = 0.25;
  m.internal_damping = 3.0;
  m.friction = 0.7;
  m.restitution = 0.2;
  return m;
}

// Sum over the edges at one point of k l^2 n_i^2 n_j^2 / (2 V): the tensor of a lattice that
// repeats with the volume V.
double modulus_at(const PhysicalModel& model, PointId point, int i, int j, double volume) {
  double sum = 0.0;
  for (EdgeId e : ids_of(model.edges)) {
    const auto [a, b] = model.geometry.edges[e];
    if (a != point && b != point) continue;
    const Vec3 d = model.geometry.points[b] - model.geometry.points[a];
    const double l2 = d.squaredNorm();
    sum += model.edges[e].stiffness * d[i] * d[i] * d[j] * d[j] / l2 / (2.0 * volume);
  }
  return sum;
}

TEST(WithMaterial, GivesALatticeTheWantedModuli) {
  const BlockShape shape{.cells = {2, 2, 2}, .spacing = 0.05};
  const PhysicalModel model = with_material(block_geometry(shape), "block", rubber());
  const PointId middle = test::block_point(shape, {1, 1, 1});
  const double volume = 0.05 * 0.05 * 0.05;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      EXPECT_NEAR(modulus_at(model, middle, i, j, volume), (i == j ? 1.2 : 0.4) * kModulus,
                  1e-9 * kModulus);
    }
  }
}

TEST(WithMaterial, SpreadsEachCellsMassOverItsCorners) {
  const BlockShape shape{.cells = {2, 1, 1}, .spacing = 0.1};
  const PhysicalModel model = with_material(block_geometry(shape), "block", rubber());
  EXPECT_NEAR(model.points[test::block_point(shape, {0, 0, 0})].mass, 1.0 / 8.0, 1e-12);
  EXPECT_NEAR(model.points[test::block_point(shape, {1, 0, 0})].mass, 2.0 / 8.0, 1e-12);
}

TEST(WithMaterial, RestsAtTodaysLengthAndBreaksAtTheStrain) {
  const PhysicalModel model = with_material(block_geometry({.spacing = 0.1}), "block", rubber());
  for (EdgeId e : ids_of(model.edges)) {
    const auto [a, b] = model.geometry.edges[e];
    const double length = (model.geometry.points[b] - model.geometry.points[a]).norm();
    EXPECT_DOUBLE_EQ(model.edges[e].rest_length, length);
    EXPECT_DOUBLE_EQ(model.edges[e].break_threshold, 0.1 * length);
  }
}

TEST(WithMaterial, DampsTheHighestFrequencyWithTheRatio) {
  const PhysicalModel model = with_material(block_geometry({.spacing = 0.1}), "block", rubber());
  const double omega = highest_frequency(model).omega_max;
  for (const EdgeAttributes& e : model.edges)
    EXPECT_DOUBLE_EQ(e.damping, 2.0 * 0.25 / omega * e.stiffness);
}

TEST(WithMaterial, FillsInTheObjectAndIsValid) {
  Material m = rubber();
  m.softening = 4.0;
  const PhysicalModel model = with_material(block_geometry({}), "block", m);
  EXPECT_EQ(model.object.friction, 0.7);
  EXPECT_EQ(model.object.restitution, 0.2);
  EXPECT_EQ(model.object.internal_damping, 3.0);
  EXPECT_EQ(model.object.softening, 4.0);
  EXPECT_TRUE(validate(model).empty());
}

// Breaking speed is strain x sqrt(E / rho): it stays when E / S and strain x sqrt S.
TEST(WithMaterial, SoftensStiffnessButNotTheBreakingSpeed) {
  Material soft = rubber();
  soft.softening = 100.0;
  soft.strain_at_crush = 0.2;
  Material real = rubber();
  real.strain_at_crush = 0.2;
  const PhysicalModel hard = with_material(block_geometry({}), "block", real);
  const PhysicalModel model = with_material(block_geometry({}), "block", soft);
  for (EdgeId e : ids_of(model.edges)) {
    EXPECT_NEAR(model.edges[e].stiffness * 100.0, hard.edges[e].stiffness, 1e-6);
    EXPECT_NEAR(model.edges[e].break_threshold, 10.0 * hard.edges[e].break_threshold, 1e-12);
    EXPECT_NEAR(model.edges[e].crush_threshold, 10.0 * hard.edges[e].crush_threshold, 1e-12);
  }
}

TEST(WithMaterial, RefusesValuesOutOfRangeByName) {
  const std::vector<std::pair<std::string, std::function<void(Material&)>>> wrong = {
      {"density", [](Material& m) { m.density = 0.0; }},
      {"density", [](Material& m) { m.density = kNaN; }},
      {"Young's modulus", [](Material& m) { m.youngs_modulus = -1.0; }},
      {"Young's modulus", [](Material& m) { m.youngs_modulus = kUnbreakable; }},
      {"strain at break", [](Material& m) { m.strain_at_break = 0.0; }},
      {"strain at break", [](Material& m) { m.strain_at_break = kNaN; }},
      {"strain at crush", [](Material& m) { m.strain_at_crush = 0.0; }},
      {"damping ratio", [](Material& m) { m.damping_ratio = -0.1; }},
      {"internal damping", [](Material& m) { m.internal_damping = kNaN; }},
      {"friction", [](Material& m) { m.friction = -1.0; }},
      {"restitution", [](Material& m) { m.restitution = 1.5; }},
      {"softening", [](Material& m) { m.softening = 0.5; }}};
  for (const auto& [quantity, spoil] : wrong) {
    Material m = rubber();
    spoil(m);
    try {
      with_material(block_geometry({}), "block", m);
      ADD_FAILURE() << quantity;
    } catch (const InputError& error) {
      EXPECT_EQ(error.diagnostic.where, "block: material");
      EXPECT_THAT(error.diagnostic.what, HasSubstr(quantity));
      EXPECT_FALSE(error.diagnostic.remedy.empty());
    }
  }
}

TEST(WithMaterial, NamesTheCellThatIsInsideOut) {
  GeometricModel g = block_geometry({.cells = {2, 1, 1}});
  for (FaceId f : g.cells[CellId(std::size_t{1})].faces)
    g.faces[f].corners = reversed(g.faces[f].corners);
  try {
    with_material(g, "block", rubber());
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(error.diagnostic.where, "block: cell 1");
    EXPECT_THAT(error.diagnostic.what, HasSubstr("volume"));
  }
}

TEST(WithMaterial, NamesAnEdgeWithoutACell) {
  GeometricModelBuilder builder;
  builder.begin_subobject("rope");
  builder.edge(builder.add_point(Vec3::Zero()), builder.add_point(Vec3::UnitX()));
  try {
    with_material(builder.finish(), "rope", rubber());
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(error.diagnostic.where, "rope: edge 0");
  }
}

TEST(StiffnessProportionalDamping, FollowsAChangedModel) {
  PhysicalModel model = with_material(block_geometry({}), "block", rubber());
  const double before = model.edges[EdgeId(std::size_t{0})].damping;
  for (PointAttributes& p : model.points) p.mass *= 4.0;  // halves omega_max
  set_stiffness_proportional_damping(model, 0.25);
  EXPECT_NEAR(model.edges[EdgeId(std::size_t{0})].damping, 2.0 * before, 0.04 * before);
}

}  // namespace
}  // namespace limber

#include "core/modeller/material_assignment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/dynamics/stable_step.h"
#include "core/model/errors.h"
#include "core/model/validate.h"
#include "core/modeller/box_lattice.h"

namespace limber {
namespace {

using ::testing::HasSubstr;

Material light() {
  return {.density = 500.0, .youngs_modulus = 1e6, .strain_at_break = 0.02, .strain_at_crush = 0.5};
}

Material heavy() {
  return {
      .density = 8000.0, .youngs_modulus = 3e6, .strain_at_break = 0.01, .strain_at_crush = 0.9};
}

// Two cells of 0.1 m side by side along x.
GeometricModel two_cells() {
  return box_lattice({2, 1, 1}, Vec3::Constant(0.1), Vec3::Zero(), "pair");
}

const MaterialChoice kHeavyOnTheRight = by_region({{in_half_space({0.1, 0, 0}, {1, 0, 0}), 1}}, 0);

PhysicalModel pair_of_both() {
  const std::vector<Material> both = {light(), heavy()};
  return with_materials(two_cells(), "pair", both, kHeavyOnTheRight);
}

std::string refusal(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.diagnostic.text();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

// Every spring and mass is the sum of what the cells would have alone.
TEST(WithMaterials, AddsUpOverTheCells) {
  const PhysicalModel model = pair_of_both();
  const PhysicalModel left = with_material(two_cells(), "left", light());
  const PhysicalModel right = with_material(two_cells(), "right", heavy());
  int shared = 0;
  for (EdgeId e : ids_of(model.edges)) {
    const auto [a, b] = model.geometry.edges[e];
    const double xa = model.geometry.points[a].x(), xb = model.geometry.points[b].x();
    const bool between = xa == 0.1 && xb == 0.1;
    const double l = left.edges[e].stiffness, r = right.edges[e].stiffness;
    const double wanted = between ? (l + r) / 2 : std::min(xa, xb) < 0.1 ? l : r;
    EXPECT_NEAR(model.edges[e].stiffness, wanted, 1e-9 * wanted);
    shared += between;
  }
  EXPECT_EQ(shared, 6);  // the square between the cells: four sides, two diagonals
  EXPECT_NEAR(total_mass(model), 1e-3 * (500.0 + 8000.0), 1e-12);
  EXPECT_NEAR(centre_of_mass(model).x(), (500.0 * 0.05 + 8000.0 * 0.15) / 8500.0, 1e-12);
  EXPECT_TRUE(validate(model).empty());
}

TEST(WithMaterials, TheWeakerStrainDecidesOnASharedEdge) {
  const PhysicalModel model = pair_of_both();
  for (EdgeId e : ids_of(model.edges)) {
    const auto [a, b] = model.geometry.edges[e];
    const double xa = model.geometry.points[a].x(), xb = model.geometry.points[b].x();
    const bool in_left = std::max(xa, xb) <= 0.1, in_right = std::min(xa, xb) >= 0.1;
    const double length = model.edges[e].rest_length;
    EXPECT_DOUBLE_EQ(model.edges[e].break_threshold / length, in_right ? 0.01 : 0.02);
    EXPECT_DOUBLE_EQ(model.edges[e].crush_threshold / length, in_left ? 0.5 : 0.9);
  }
}

TEST(WithMaterials, DampsTheHighestFrequencyOfTheWhole) {
  Material a = light(), b = heavy();
  a.damping_ratio = b.damping_ratio = 0.2;
  const std::vector<Material> both = {a, b};
  const PhysicalModel model = with_materials(two_cells(), "pair", both, kHeavyOnTheRight);
  const double seconds = 0.4 / highest_frequency(model).omega_max;
  for (const EdgeAttributes& e : model.edges) EXPECT_DOUBLE_EQ(e.damping, seconds * e.stiffness);
}

TEST(WithMaterials, ChoosesBySubobject) {
  GeometricModelBuilder builder;
  const auto add_block = [&](const char* name, double x) {
    const GeometricModel g = box_lattice({1, 1, 1}, Vec3::Constant(0.1), {x, 0, 0}, name);
    builder.begin_subobject(name);
    std::vector<PointId> points;
    for (const Vec3& p : g.points) points.push_back(builder.add_point(p));
    std::vector<std::array<PointId, 2>> edges;
    for (const Edge& e : g.edges) edges.push_back({points[e.a.index()], points[e.b.index()]});
    std::vector<std::array<PointId, 3>> faces;
    for (const Face& f : g.faces)
      faces.push_back({points[f.corners[0].index()], points[f.corners[1].index()],
                       points[f.corners[2].index()]});
    builder.add_cell(edges, faces);
  };
  add_block("cork", 0.0);
  add_block("lead", 0.5);
  const GeometricModel geometry = builder.finish();
  const std::vector<Material> both = {light(), heavy()};
  const PhysicalModel model =
      with_materials(geometry, "float", both, by_subobject({{"lead", 1}, {"cork", 0}}));
  EXPECT_NEAR(model.points[PointId(0ul)].mass, 0.5 / 8, 1e-12);
  EXPECT_NEAR(model.points[PointId(8ul)].mass, 8.0 / 8, 1e-12);
  EXPECT_THAT(refusal([&] {
                with_materials(geometry, "float", both, by_subobject({{"lead", 1}}));
              }),
              HasSubstr("cell 0 of subobject cork: no material is chosen"));
  EXPECT_THAT(refusal([&] {
                with_materials(geometry, "float", both, by_subobject({{"Lead", 1}}, 0));
              }),
              HasSubstr("float: material 1: no cell has it"));
}

TEST(WithMaterials, TakesAnyFunctionOfThePlace) {
  const std::vector<Material> both = {light(), heavy()};
  const auto checkerboard = [](const CellPlace& place) {
    return static_cast<std::size_t>(std::lround(place.centre.sum() / 0.1 - 1.5)) % 2;
  };
  const GeometricModel g = box_lattice({4, 4, 4}, Vec3::Constant(0.1), Vec3::Zero(), "board");
  const PhysicalModel model = with_materials(g, "board", both, checkerboard);
  EXPECT_NEAR(total_mass(model), 32 * 1e-3 * 8500.0, 1e-9);
}

TEST(WithMaterials, RefusesValuesThatAnObjectHasOnceButMaterialsDisagreeOn) {
  Material other = heavy();
  other.friction = 0.9;
  const std::vector<Material> both = {light(), other};
  const std::string text =
      refusal([&] { with_materials(two_cells(), "pair", both, kHeavyOnTheRight); });
  EXPECT_THAT(text, HasSubstr("pair: material 1: friction is 0.9, that of material 0 is 0.5"));
  const PhysicalModel stated =
      with_materials(two_cells(), "pair", both, kHeavyOnTheRight, {.friction = 0.7});
  EXPECT_EQ(stated.object.friction, 0.7);
  EXPECT_THAT(refusal([&] {
                with_materials(two_cells(), "pair", both, kHeavyOnTheRight, {.friction = -1.0});
              }),
              HasSubstr("pair: whole object: friction is -1"));
}

TEST(WithMaterials, RefusesTwoSoftenings) {
  Material other = heavy();
  other.softening = 10.0;
  const std::vector<Material> both = {light(), other};
  EXPECT_THAT(refusal([&] { with_materials(two_cells(), "pair", both, kHeavyOnTheRight); }),
              HasSubstr("give all the same S"));
}

TEST(WithMaterials, RefusesAnIndexThatIsNone) {
  const std::vector<Material> both = {light(), heavy()};
  const auto third = [](const CellPlace&) { return std::size_t{2}; };
  EXPECT_THAT(refusal([&] { with_materials(two_cells(), "pair", both, third); }),
              HasSubstr("cell 0 of subobject pair: material 2 is chosen for it, there are 2"));
  EXPECT_THAT(refusal([&] { with_materials(two_cells(), "pair", {}, third); }),
              HasSubstr("there is none"));
}

TEST(Region, OfEachKindHasItsInside) {
  const Region box = in_box({0, 0, 0}, {1, 2, 3}), sphere = in_sphere({1, 1, 1}, 0.5);
  const Region half = in_half_space({0, 1, 0}, {0, -2, 0});
  EXPECT_TRUE(box({1, 2, 0}));
  EXPECT_FALSE(box({1.001, 1, 1}));
  EXPECT_TRUE(sphere({1, 1.5, 1}));
  EXPECT_FALSE(sphere({1.4, 1.4, 1}));
  EXPECT_TRUE(half({7, 1, 7}));
  EXPECT_FALSE(half({0, 1.001, 0}));
}

TEST(EdgesIn, AreThoseWithTheirMiddleInside) {
  const GeometricModel g = two_cells();
  const std::vector<EdgeId> found = edges_in(g, in_box({0.09, -1, -1}, {0.11, 1, 1}));
  EXPECT_EQ(found.size(), 6u);
  for (EdgeId e : found) {
    EXPECT_EQ(g.points[g.edges[e].a].x(), 0.1);
    EXPECT_EQ(g.points[g.edges[e].b].x(), 0.1);
  }
}

}  // namespace
}  // namespace limber

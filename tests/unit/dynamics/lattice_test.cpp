#include "core/dynamics/lattice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/dynamics/memory_use.h"
#include "core/model/validate.h"
#include "tests/support/blocks.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

PhysicalModel moving_block(const Vec3& origin) {
  PhysicalModel model = test::block({.cells = {2, 1, 3}, .spacing = 0.5, .origin = origin});
  int i = 0;
  for (PointAttributes& p : model.points) p.mass = 1.0 + i++ % 4;
  set_in_motion(model, {1.0, 2.0, 3.0}, {0.5, -0.5, 1.0});
  return model;
}

void expect_same_state(const PhysicalModel& found, const PhysicalModel& wanted) {
  EXPECT_EQ(found.name, wanted.name);
  EXPECT_EQ(found.geometry.points.raw(), wanted.geometry.points.raw());
  for (PointId p : ids_of(wanted.points)) {
    EXPECT_EQ(found.points[p].velocity, wanted.points[p].velocity);
    EXPECT_EQ(found.points[p].mass, wanted.points[p].mass);
  }
  for (EdgeId e : ids_of(wanted.edges)) {
    EXPECT_EQ(found.edges[e].broken, wanted.edges[e].broken);
    EXPECT_EQ(found.edges[e].rest_length, wanted.edges[e].rest_length);
  }
  for (CellId c : ids_of(wanted.cells)) EXPECT_EQ(found.cells[c].valid, wanted.cells[c].valid);
}

TEST(Lattice, KeepsTheIndicesOfOthersWhenAnObjectRetires) {
  Lattice lattice = test::lattice_of({moving_block(Vec3::Zero()), moving_block({5.0, 0.0, 0.0})});
  const std::size_t springs = lattice.active.size();
  const std::size_t authored = memory_use(lattice).authored;
  const PhysicalModel other = extract_model(lattice, 1);
  retire_object(lattice, 0);
  rebuild_active(lattice);
  expect_same_state(extract_model(lattice, 1), other);
  EXPECT_EQ(lattice.active.size(), springs / 2);
  EXPECT_EQ(lattice.dynamic_points.front(), lattice.objects[1].points.begin);
  EXPECT_LT(memory_use(lattice).authored, 0.6 * authored);
  EXPECT_EQ(lattice.objects[0].authored.name, other.name);
}

TEST(Lattice, GivesTheModelBackAsItWasAdded) {
  PhysicalModel model = moving_block({1.0, 2.0, 3.0});
  const std::vector<EdgeId> first = {EdgeId(3)};
  break_edges(model, first);
  const Lattice lattice = test::lattice_of({model});
  expect_same_state(extract_model(lattice, 0), model);
  EXPECT_TRUE(validate(extract_model(lattice, 0)).empty());
}

TEST(Lattice, GivesBackWhereThePointsAreNowAndWhatBroke) {
  Lattice lattice = test::lattice_of({moving_block(Vec3::Zero()), moving_block({9.0, 0.0, 0.0})});
  PhysicalModel wanted = lattice.objects[1].authored;
  const std::vector<EdgeId> edge = {EdgeId(5)};
  break_edges(wanted, edge);
  const std::vector<std::int32_t> same_edge = {lattice.objects[1].edges.begin + 5};
  break_edges(lattice.topology, lattice.breaking, same_edge);
  for (PointId p : ids_of(wanted.points)) {
    wanted.geometry.points[p] += Vec3(0.0, 1.0, 0.0);
    wanted.points[p].velocity *= 2.0;
    lattice.motion[lattice.objects[1].points.begin + p.index()] = {wanted.geometry.points[p],
                                                                   wanted.points[p].velocity};
  }
  expect_same_state(extract_model(lattice, 1), wanted);
  expect_same_state(extract_model(lattice, 0), lattice.objects[0].authored);
}

TEST(Lattice, TakesItsOwnOutputAsInput) {
  Lattice lattice = test::lattice_of({moving_block(Vec3::Zero())});
  test::shake(lattice, 31, 1.0);
  const std::vector<std::int32_t> edges = {2};
  break_edges(lattice.topology, lattice.breaking, edges);
  rebuild_active(lattice);
  const Lattice again = test::lattice_of({extract_model(lattice, 0)});
  EXPECT_EQ(again.active_edge, lattice.active_edge);
  EXPECT_EQ(again.breaking.edge_broken, lattice.breaking.edge_broken);
  EXPECT_EQ(again.breaking.face_external, lattice.breaking.face_external);
  EXPECT_EQ(again.motion.back().velocity, lattice.motion.back().velocity);
}

TEST(Lattice, AppendsObjectsWithoutMovingThoseThatWereThere) {
  const PhysicalModel a = moving_block(Vec3::Zero()), b = moving_block({9.0, 0.0, 0.0});
  const Lattice one = test::lattice_of({a}), both = test::lattice_of({a, b});
  const auto points = static_cast<std::int32_t>(a.points.size());
  ASSERT_EQ(both.springs.size(), 2 * one.springs.size());
  for (std::size_t e = 0; e < one.springs.size(); ++e) {
    const Spring& first = both.springs[e];
    const Spring& second = both.springs[e + one.springs.size()];
    EXPECT_EQ(first.a, one.springs[e].a);
    EXPECT_EQ(first.b, one.springs[e].b);
    EXPECT_EQ(second.a, first.a + points);
    EXPECT_EQ(second.b, first.b + points);
  }
  EXPECT_EQ(both.point_object.front(), 0);
  EXPECT_EQ(both.point_object.back(), 1);
}

TEST(Lattice, LinksThePointsOfTheSecondObjectAsIfItWereAlone) {
  const PhysicalModel a = moving_block(Vec3::Zero()), b = test::chain({.points = 4});
  const Lattice alone = test::lattice_of({b}), both = test::lattice_of({a, b});
  const std::size_t points = a.points.size(), edges = a.edges.size();
  ASSERT_EQ(both.point_edges.rows(), points + 4);
  ASSERT_EQ(both.point_neighbours.size(), both.point_edges.items.size());
  for (std::size_t p = 0; p < 4; ++p) {
    const std::int32_t first = alone.point_edges.start[p];
    const std::int32_t shifted = both.point_edges.start[points + p];
    ASSERT_EQ(both.point_edges[points + p].size(), alone.point_edges[p].size());
    for (std::size_t i = 0; i < alone.point_edges[p].size(); ++i) {
      EXPECT_EQ(both.point_edges.items[shifted + i] - alone.point_edges.items[first + i], edges);
      EXPECT_EQ(both.point_neighbours[shifted + i] - alone.point_neighbours[first + i], points);
    }
  }
}

// The links of the second object lead to the same result as when it is alone.
TEST(Lattice, BreaksTheSecondObjectAsIfItWereAlone) {
  const PhysicalModel a = moving_block(Vec3::Zero()), b = moving_block({9.0, 0.0, 0.0});
  Lattice alone = test::lattice_of({b}), both = test::lattice_of({a, b});
  const auto offset = static_cast<std::int32_t>(a.edges.size());
  const std::vector<std::int32_t> edge = {7}, shifted = {7 + offset};
  BreakingResult wanted = break_edges(alone.topology, alone.breaking, edge);
  const BreakingResult found = break_edges(both.topology, both.breaking, shifted);
  for (std::int32_t& e : wanted.broken_edges) e += offset;
  for (std::int32_t& c : wanted.invalid_cells) c += static_cast<std::int32_t>(a.cells.size());
  for (std::int32_t& f : wanted.exposed_faces) f += static_cast<std::int32_t>(a.faces.size());
  EXPECT_GT(found.broken_edges.size(), 1u);
  EXPECT_EQ(found.broken_edges, wanted.broken_edges);
  EXPECT_EQ(found.invalid_cells, wanted.invalid_cells);
  EXPECT_EQ(found.exposed_faces, wanted.exposed_faces);
}

TEST(Lattice, ActiveSpringsAreTheUnbrokenOnesOfDynamicPoints) {
  Lattice lattice = test::lattice_of(
      {test::chain({.points = 4}), test::chain({.points = 3, .origin = {0.0, 5.0, 0.0}})});
  EXPECT_THAT(lattice.active_edge, testing::ElementsAre(0, 1, 2, 3, 4));
  lattice.breaking.edge_broken[1] = 1;
  for (std::int32_t p : {4, 5, 6}) lattice.role[p] = PointRole::kCarried;
  rebuild_active(lattice);
  EXPECT_THAT(lattice.active_edge, testing::ElementsAre(0, 2));
  EXPECT_THAT(lattice.active_of_edge, testing::ElementsAre(0, -1, 1, -1, -1));
  EXPECT_THAT(lattice.dynamic_points, testing::ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(lattice.carried_points, testing::ElementsAre(4, 5, 6));
}

TEST(Lattice, SlackenedSpringsExertNothingAndNeverBreak) {
  Lattice lattice = test::lattice_of({test::block({})});
  const std::vector<std::int32_t> edges = {4};
  slacken(lattice, edges);
  EXPECT_EQ(lattice.active[4].stiffness, 0.0);
  EXPECT_EQ(lattice.active[4].damping, 0.0);
  EXPECT_EQ(lattice.active[4].break_threshold, kUnbreakable);
  EXPECT_EQ(lattice.springs[4].stiffness, 100.0);  // the constant stays for the ledger
  EXPECT_EQ(lattice.active[3].stiffness, 100.0);
}

TEST(Lattice, ContactRadiusIsLessThanHalfOfThePointsShortestEdge) {
  PhysicalModel model = test::chain({.points = 3});
  model.geometry.points[PointId(2)] = Vec3(1.25, 0.0, 0.0);
  model.edges[EdgeId(1)].rest_length = 0.25;
  const Lattice lattice = test::lattice_of({model});
  EXPECT_DOUBLE_EQ(lattice.contact_radius[0], 0.45);
  EXPECT_DOUBLE_EQ(lattice.contact_radius[1], 0.45 * 0.25);
  EXPECT_DOUBLE_EQ(lattice.contact_radius[2], 0.45 * 0.25);
}

// The stated share of k / m = 1e8 N/m / 1 kg, squared frequency.
TEST(Lattice, ContactFrequencyFollowsTheSprings) {
  const Lattice lattice = test::lattice_of({test::chain({.points = 5, .stiffness = 1e8})});
  EXPECT_NEAR(lattice.objects[0].contact_frequency, std::sqrt(kContactStiffnessShare * 1e8), 1e-9);
}

// But a column of five points of mass m, 1 m apart, must be able to stand on one contact: under
// four metres of its own weight, 4 m g, the contact of stiffness omega^2 m gives way by 4 g /
// omega^2.
TEST(Lattice, ContactOfASoftObjectBearsItsWeight) {
  const Lattice lattice = test::lattice_of({test::chain({.points = 5, .stiffness = 1e-3})});
  const double omega = lattice.objects[0].contact_frequency;
  EXPECT_NEAR(4.0 * kStandardGravity / (omega * omega), kContactSinkShare * 1.0, 1e-12);
}

TEST(Lattice, ElasticEnergyCountsEveryUnbrokenSpringOnce) {
  Lattice lattice = test::lattice_of({moving_block(Vec3::Zero())});
  std::mt19937 random(32);
  for (PointMotion& p : lattice.motion) p.position += test::random_vector(random, 0.1);
  const std::vector<std::int32_t> edges = {6};
  const double whole = elastic_energy(lattice, lattice.dynamic_points);
  EXPECT_NEAR(whole, test::totals(lattice).elastic, 1e-13 * whole);
  break_edges(lattice.topology, lattice.breaking, edges);
  const double broken = elastic_energy(lattice, lattice.dynamic_points);
  EXPECT_LT(broken, whole);
  EXPECT_NEAR(broken, test::totals(lattice).elastic, 1e-13 * whole);
}

TEST(Lattice, RefusesAnInvalidModel) {
  PhysicalModel model = test::chain({});
  model.points[PointId(1)].mass = -1.0;
  Lattice lattice;
  EXPECT_THROW(add_object(lattice, model), InputError);
}

}  // namespace
}  // namespace limber

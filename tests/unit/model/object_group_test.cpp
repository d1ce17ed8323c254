#include "core/model/object_group.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/dynamics/lattice.h"
#include "core/dynamics/rigid_motion.h"
#include "tests/support/blocks.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

PhysicalModel cube_at(const Vec3& origin, const std::string& name) {
  return test::block({.origin = origin, .name = name});
}

// Two cubes of 8 kg and, one level down, one of 24 kg: the centres of the cubes are (0.5, 0.5,
// 0.5), (4.5, 0.5, 0.5) and (0.5, 6.5, 0.5).
ObjectGroup kitchen() {
  ObjectGroup shelf{.name = "shelf", .objects = {cube_at({0, 6, 0}, "teapot")}, .groups = {}};
  for (PointAttributes& p : shelf.objects[0].points) p.mass = 3.0;
  return {.name = "kitchen",
          .objects = {cube_at({0, 0, 0}, "table"), cube_at({4, 0, 0}, "chair")},
          .groups = {shelf}};
}

TEST(ObjectGroup, AddsUpMassesAtEveryDepth) {
  EXPECT_EQ(total_mass(kitchen()), 40.0);
  EXPECT_LT((centre_of_mass(kitchen()) - Vec3(1.3, 4.1, 0.5)).norm(), 1e-15);
}

TEST(ObjectGroup, FlattensToModelsNamedByTheirPaths) {
  std::vector<std::string> names;
  for (const PhysicalModel& m : flattened(kitchen())) names.push_back(m.name);
  EXPECT_THAT(names, ElementsAre("kitchen/table", "kitchen/chair", "kitchen/shelf/teapot"));
  EXPECT_EQ(flattened(kitchen())[2].points[PointId(0)].mass, 3.0);
}

// Three quarter turns about z and a shift; the distance of any two points of the group stays.
TEST(ObjectGroup, IsPlacedAsOneBody) {
  ObjectGroup group = kitchen();
  group.groups[0].objects[0].points[PointId(0)].velocity = Vec3(1, 0, 0);
  const Mat3 turn{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}};
  place(group, turn, Vec3(10, 20, 30));
  EXPECT_LT((centre_of_mass(group) - (turn * Vec3(1.3, 4.1, 0.5) + Vec3(10, 20, 30))).norm(),
            1e-14);
  EXPECT_EQ(group.objects[1].geometry.points[PointId(0)], Vec3(10, 16, 30));
  EXPECT_EQ(group.groups[0].objects[0].geometry.points[PointId(0)], Vec3(16, 20, 30));
  EXPECT_EQ(group.groups[0].objects[0].points[PointId(0)].velocity, Vec3(0, -1, 0));
}

// The rigid motion of all points together, by sums over the compiled lattice, is what was asked
// for.
TEST(ObjectGroup, MovesAsOneBody) {
  ObjectGroup group = kitchen();
  set_in_motion(group, Vec3(1, -2, 3), Vec3(0.5, 0.25, -4));
  const Lattice lattice = test::lattice_of(flattened(group));
  const RigidMotion all = rigid_motion(lattice.motion, lattice.mass, lattice.dynamic_points);
  EXPECT_LT((all.velocity - Vec3(1, -2, 3)).norm(), 1e-14);
  EXPECT_LT((all.angular_velocity - Vec3(0.5, 0.25, -4)).norm(), 1e-13);
  EXPECT_NEAR(all.kinetic_energy(), test::totals(lattice).kinetic, 1e-11);
}

TEST(ObjectGroup, WithoutMassHasNoCentre) {
  EXPECT_THROW(centre_of_mass(ObjectGroup{.name = "nothing", .objects = {}, .groups = {}}),
               InputError);
  EXPECT_EQ(total_mass(ObjectGroup{}), 0.0);
  ObjectGroup half_empty = kitchen();
  half_empty.objects.push_back({});
  EXPECT_LT((centre_of_mass(half_empty) - Vec3(1.3, 4.1, 0.5)).norm(), 1e-15);
}

TEST(ObjectGroup, IsValidWhenItsObjectsAre) {
  ObjectGroup group = kitchen();
  EXPECT_TRUE(validate(group).empty());
  group.groups[0].objects[0].points[PointId(7)].mass = -1;
  group.objects[1].object.friction = -1;
  const std::vector<Diagnostic> found = validate(group);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].where, "kitchen/chair: object");
  EXPECT_EQ(found[1].where, "kitchen/shelf/teapot: point 7");
  EXPECT_EQ(validate(group, 1).size(), 1u);
}

TEST(ObjectGroup, NamesTellObjectsApart) {
  ObjectGroup group = kitchen();
  group.objects[1].name = "table";
  group.groups[0].objects[0].name = "tea/pot";
  group.groups[0].groups.push_back({});
  const std::vector<Diagnostic> found = validate(group);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].where, "kitchen");
  EXPECT_THAT(found[0].what, HasSubstr("N1 the name 'table' is used twice"));
  EXPECT_EQ(found[1].where, "kitchen/shelf");
  EXPECT_THAT(found[1].what, HasSubstr("'tea/pot'"));
  EXPECT_THAT(found[2].what, HasSubstr("N1 the name '' is empty"));
}

}  // namespace
}  // namespace limber

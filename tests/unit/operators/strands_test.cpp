#include "core/operators/strands.h"

#include <gtest/gtest.h>

#include "core/modeller/box_lattice.h"
#include "core/modeller/material.h"
#include "core/modeller/particle_cloud.h"
#include "core/modeller/rope.h"
#include "core/modeller/thin_material.h"
#include "core/operators/gluing_operator.h"

namespace limber {
namespace {

Material plain() {
  Material m;
  m.density = 1000.0;
  m.youngs_modulus = 1e6;
  return m;
}

// A cube of 0.1 m and a rope of three segments that ends 1 cm above a corner.
PhysicalModel kite() {
  const PhysicalModel cube =
      with_material(box_lattice({1, 1, 1}, Vec3::Constant(0.1), Vec3::Zero(), "cube"), "cube",
                    plain());
  const auto points = points_along(polyline({Vec3(0, 0.11, 0), Vec3(0, 0.41, 0)}), 3);
  const PhysicalModel line =
      with_rope_material(rope(points, "line"), "line", plain(), round_section(0.006));
  return glue(cube, line, {.distance = 0.011, .stiffness = 100.0}).model;
}

TEST(Strands, AreTheEdgesOfTheRopeAsThickAsItsSection) {
  const PhysicalModel model = kite();
  const std::vector<Strand> all = strands(model);
  ASSERT_EQ(all.size(), 3u);  // neither the cube's edges nor the bond
  for (const Strand& strand : all) {
    EXPECT_NEAR(strand.radius, 0.003, 1e-12);
    EXPECT_EQ(model.geometry.subobjects[strand.subobject].name, "line");
    EXPECT_NEAR((model.geometry.points[strand.a] - model.geometry.points[strand.b]).norm(), 0.1,
                1e-12);
  }
}

TEST(Strands, LeaveOutWhatIsBrokenOrNotToBeSeen) {
  PhysicalModel model = kite();
  model.edges[EdgeId(std::size_t(model.geometry.subobjects[1].edges.begin))].broken = true;
  EXPECT_EQ(strands(model).size(), 2u);
  model.parts[1].surface.strand_radius = 0.0;
  EXPECT_TRUE(strands(model).empty());
}

TEST(Strands, OfAGrainHasNoLength) {
  const std::vector<Vec3> at = {Vec3::Zero(), Vec3::UnitX()};
  const PhysicalModel sand =
      with_particles(particle_cloud(at, "sand"), "sand", ball_particle(2000.0, 0.01));
  const std::vector<Strand> all = strands(sand);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[1].a, all[1].b);
  EXPECT_EQ(all[1].a, PointId(std::size_t{1}));
  EXPECT_EQ(all[1].radius, 0.01);
}

}  // namespace
}  // namespace limber

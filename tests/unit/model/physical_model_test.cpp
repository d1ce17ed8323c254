#include "core/model/physical_model.h"

#include <gtest/gtest.h>

#include "core/model/errors.h"
#include "tests/support/blocks.h"

namespace limber {
namespace {

using test::block;
using test::block_geometry;

// An axial edge of the unit cube is 1 m long, a face diagonal sqrt 2, a body diagonal sqrt 3.
TEST(DefaultAttributes, RestLengthsAreTodaysLengths) {
  const PhysicalModel m = with_default_attributes(block_geometry({}), "cube");
  double sum = 0.0;
  for (const EdgeAttributes& edge : m.edges) sum += edge.rest_length;
  EXPECT_NEAR(sum, 12 + 12 * std::sqrt(2.0) + 4 * std::sqrt(3.0), 1e-12);
}

TEST(DefaultAttributes, EveryElementHasSomeAndNothingIsBroken) {
  const PhysicalModel m = with_default_attributes(block_geometry({.cells = {2, 1, 1}}), "bar");
  EXPECT_EQ(m.name, "bar");
  EXPECT_EQ(m.points.size(), 12u);
  EXPECT_EQ(m.edges.size(), m.geometry.edges.size());
  EXPECT_EQ(m.faces.size(), 24u);
  EXPECT_EQ(m.cells.size(), 2u);
  EXPECT_EQ(m.parts.size(), 1u);
  for (const EdgeAttributes& edge : m.edges) EXPECT_FALSE(edge.broken);
  for (const CellAttributes& cell : m.cells) EXPECT_TRUE(cell.valid);
}

// A quarter turn about z takes (1, 0, 0) to (0, 1, 0).
TEST(Place, TurnsPositionsAndVelocitiesAndMovesPositionsOnly) {
  PhysicalModel m = block({});
  m.points[PointId(1)].velocity = Vec3(1, 2, 3);
  const Mat3 quarter_turn{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
  place(m, quarter_turn, Vec3(10, 20, 30));
  EXPECT_EQ(m.geometry.points[PointId(1)], Vec3(10, 21, 30));
  EXPECT_EQ(m.points[PointId(1)].velocity, Vec3(-2, 1, 3));
  EXPECT_EQ(m.points[PointId(0)].velocity, Vec3::Zero());
}

// Centre of mass of the unit cube with one corner, at (1, 0, 0), of 3 kg:
// (7 x 1 kg elsewhere sum to (3, 4, 4)) + 3 (1, 0, 0) = (6, 4, 4) / 10 kg.
TEST(SetInMotion, TurnsAboutTheCentreOfMass) {
  PhysicalModel m = block({});
  m.points[PointId(1)].mass = 3.0;
  m.points[PointId(0)].velocity = Vec3(0, 0, 7);  // is kept
  set_in_motion(m, Vec3(1, 0, 0), Vec3(0, 0, 2));
  // v + omega x r at the origin, r = (-0.6, -0.4, -0.4): omega x r = 2 (0.4, -0.6, 0).
  EXPECT_LT((m.points[PointId(0)].velocity - Vec3(1.8, -1.2, 7)).norm(), 1e-15);
  Vec3 momentum = Vec3::Zero();
  for (const PointAttributes& p : m.points) momentum += p.mass * p.velocity;
  EXPECT_LT((momentum - Vec3(10, 0, 7)).norm(), 1e-14);
}

TEST(SetInMotion, WithoutMassIsAnInputErrorThatNamesTheModel) {
  PhysicalModel m = with_default_attributes(block_geometry({}), "ghost");
  try {
    set_in_motion(m, Vec3(1, 0, 0), Vec3::Zero());
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(error.diagnostic.where, "ghost: points");
    EXPECT_NE(error.diagnostic.what.find("mass"), std::string::npos);
  }
}

}  // namespace
}  // namespace limber

#include "core/environment/face_drag.h"

#include <gtest/gtest.h>

namespace limber {
namespace {

// A triangle in uniform wind, with the forces of the three laws computed elsewhere.
struct TriangleCase {
  Vec3 area_vector;    // m^2
  Vec3 relative_wind;  // m/s
  double density;
  FaceAttributes linear, quadratic;
  Vec3 linear_force, quadratic_force, pressure_force;  // N
};

Vec3 area_vector(const Vec3& a, const Vec3& b, const Vec3& c) { return 0.5 * (b - a).cross(c - a); }

FaceAttributes with(DragLaw law, double normal, double tangential) {
  return {law, normal, tangential};
}

const TriangleCase kCases[] = {
    {area_vector({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
     {0, 0, 5},
     1.225,
     with(DragLaw::kLinear, 1.0, 0.2),
     with(DragLaw::kQuadratic, 1.1, 0.02),
     {0, 0, 2.5},
     {0, 0, 8.421875},
     {0, 0, 8.421875}},
    {area_vector({0, 0, 0}, {0.5, 0.1, 0}, {0.1, 0.4, 0.3}),
     Vec3(3, -2, 1) - Vec3(0.1, 0.2, -0.3) / 3.0,
     1.2,
     with(DragLaw::kLinear, 2.0, 0.1),
     with(DragLaw::kQuadratic, 1.3, 0.05),
     {0.10722026320058625, -0.3803950799542603, 0.4633224782603847},
     {0.10033861933753237, -0.36900028528708567, 0.45162504540426957},
     {0.11021199179957802, -0.5510599589978902, 0.6980092813973275}},
    {area_vector({0.1, 0.2, 0.3}, {0.4, 0.1, 0.2}, {0.2, 0.5, 0.9}),
     -(Vec3(1, 1, 1) + Vec3(1.2, 0.8, 1) + Vec3(0.9, 1.1, 1.3)) / 3.0,
     1.225,
     with(DragLaw::kLinear, 0.7, 0.3),
     with(DragLaw::kQuadratic, 1.17, 0.01),
     {-0.036499947245662856, -0.049781321537252045, -0.02611532094728435},
     {-0.003613145049252392, -0.01649133231636855, 0.006836057584124092},
     {-0.00930133891906681, -0.05890847982075645, 0.031004463063556018}},
};

void expect_near(const Vec3& found, const Vec3& wanted) {
  EXPECT_LE((found - wanted).norm(), 1e-14 * wanted.norm())
      << found.transpose() << " instead of " << wanted.transpose();
}

TEST(FaceDrag, HasTheReferenceForcesInAllThreeLaws) {
  for (const TriangleCase& c : kCases) {
    const auto force = [&](const FaceAttributes& face) {
      return face_drag(face, c.area_vector, c.relative_wind, c.density);
    };
    FaceAttributes pressure = c.quadratic;
    pressure.drag_law = DragLaw::kPressure;
    expect_near(force(c.linear), c.linear_force);
    expect_near(force(c.quadratic), c.quadratic_force);
    expect_near(force(pressure), c.pressure_force);
  }
}

// A square metre across a wind of 10 m/s with C = 1.2: F = 1.225 / 2 * 1.2 * 100 = 73.5 N.
TEST(FaceDrag, AcrossTheWindIsTheDynamicPressure) {
  for (DragLaw law : {DragLaw::kQuadratic, DragLaw::kPressure}) {
    expect_near(face_drag(with(law, 1.2, 0.7), Vec3::UnitX(), {10, 0, 0}, 1.225), {73.5, 0, 0});
  }
}

TEST(FaceDrag, AlongTheWindIsSkinFrictionAlone) {
  const Vec3 area = 2.0 * Vec3::UnitY(), wind(0, 0, 3);
  expect_near(face_drag(with(DragLaw::kQuadratic, 5.0, 0.1), area, wind, 1.0), {0, 0, 0.9});
  expect_near(face_drag(with(DragLaw::kLinear, 5.0, 0.1), area, wind, 1.0), {0, 0, 0.6});
  EXPECT_EQ(face_drag(with(DragLaw::kPressure, 5.0, 0.1), area, wind, 1.0), Vec3::Zero());
}

TEST(FaceDrag, OfAFaceWithoutAreaOrInItsOwnFrameIsZero) {
  for (DragLaw law : {DragLaw::kQuadratic, DragLaw::kLinear, DragLaw::kPressure}) {
    const FaceAttributes face = with(law, 1.0, 1.0);
    EXPECT_EQ(face_drag(face, Vec3::Zero(), {1, 2, 3}, 1.2), Vec3::Zero());
    EXPECT_EQ(face_drag(face, Vec3::Constant(1e-200), {1, 2, 3}, 1.2), Vec3::Zero());
    EXPECT_EQ(face_drag(face, {1, 2, 3}, Vec3::Zero(), 1.2), Vec3::Zero());
  }
}

TEST(HasDrag, CountsTheCoefficientsThatTheLawUses) {
  EXPECT_FALSE(has_drag(FaceAttributes{}));
  EXPECT_TRUE(has_drag(with(DragLaw::kQuadratic, 0.0, 0.1)));
  EXPECT_TRUE(has_drag(with(DragLaw::kLinear, 0.1, 0.0)));
  EXPECT_TRUE(has_drag(with(DragLaw::kPressure, 0.1, 0.0)));
  EXPECT_FALSE(has_drag(with(DragLaw::kPressure, 0.0, 0.1)));
}

}  // namespace
}  // namespace limber

#include "core/contact/face_contact.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>
#include <vector>

#include "core/contact/passive_contact.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

// A point somewhere behind a random triangle.
struct Case {
  Triangle triangle;
  Vec3 point;
  FaceContact contact;
  FaceMotion motion;
  std::array<Vec3, 3> gradients;
};

Case random_case(std::mt19937& random) {
  Case c;
  do {
    for (Vec3& corner : c.triangle) corner = test::random_vector(random, 1.0);
  } while (twice_area_vector(c.triangle).norm() < 0.3);
  const Vec3 w = test::random_vector(random, 0.1) + Vec3::Constant(1.0 / 3.0);
  c.contact.weights = w / w.sum();
  c.contact.normal = twice_area_vector(c.triangle).normalized();
  c.contact.depth = 0.3 + test::random_vector(random, 0.2).x();
  c.point = point_at(c.triangle, c.contact.weights) - c.contact.depth * c.contact.normal;
  c.motion.point = test::random_vector(random, 1.0);
  for (Vec3& v : c.motion.corners) v = test::random_vector(random, 1.0);
  c.gradients = weight_gradients(c.triangle);
  return c;
}

Vec3 across(const Case& c, const Vec3& v) { return v - v.dot(c.contact.normal) * c.contact.normal; }

TEST(FaceContact, ForcesKeepMomentumAndAngularMomentum) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Case c = random_case(random);
    FaceForces f = push_apart(c.contact, 3.0);
    f += drag_across(c.contact, across(c, test::random_vector(random, 2.0)), c.gradients);
    Vec3 sum = f.on_point, moment = c.point.cross(f.on_point);
    for (int i = 0; i < 3; ++i) {
      sum += f.on_corners[i];
      moment += c.triangle[i].cross(f.on_corners[i]);
    }
    EXPECT_LT(sum.norm(), 1e-13);
    EXPECT_LT(moment.norm(), 1e-13);
  }
}

double power(const FaceForces& f, const FaceMotion& motion) {
  double sum = f.on_point.dot(motion.point);
  for (int i = 0; i < 3; ++i) sum += f.on_corners[i].dot(motion.corners[i]);
  return sum;
}

// So friction against the slip takes energy whatever the triangle does.
TEST(FaceContact, PowersAreForceTimesSpeed) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const Case c = random_case(random);
    const Vec3 force = across(c, test::random_vector(random, 2.0));
    const Vec3 slip = slip_velocity(c.contact, c.motion, c.gradients);
    EXPECT_NEAR(power(drag_across(c.contact, force, c.gradients), c.motion), force.dot(slip),
                1e-12);
    EXPECT_NEAR(power(push_apart(c.contact, 2.0), c.motion),
                2.0 * separation_speed(c.contact, c.motion), 1e-12);
  }
}

// The point as if it were part of the triangle: nothing slips, nothing separates.
TEST(FaceContact, NothingSlipsInARigidMotion) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 50; ++trial) {
    Case c = random_case(random);
    const Vec3 v = test::random_vector(random, 1.0), omega = test::random_vector(random, 1.0);
    c.motion.point = v + omega.cross(c.point);
    for (int i = 0; i < 3; ++i) c.motion.corners[i] = v + omega.cross(c.triangle[i]);
    EXPECT_LT(slip_velocity(c.contact, c.motion, c.gradients).norm(), 1e-13);
    EXPECT_NEAR(separation_speed(c.contact, c.motion), 0.0, 1e-13);
  }
}

// Of 2 kg against corners of 1, 2 and 4 kg with weights 1/2, 1/4, 1/4.
TEST(FaceContact, EffectiveMassIsThatOfItsWeights) {
  FaceContact contact;
  contact.weights = {0.5, 0.25, 0.25};
  contact.normal = Vec3::UnitZ();
  const double inverse = 1.0 / 2.0 + 0.25 / 1.0 + 0.0625 / 2.0 + 0.0625 / 4.0;
  EXPECT_NEAR(contact_mass(contact, {0.5, {1.0, 0.5, 0.25}}), 1.0 / inverse, 1e-15);
  EXPECT_TRUE(std::isinf(contact_mass(contact, {0.0, {0.0, 0.0, 0.0}})));
}

// Many springs on one triangle: the highest eigenvalue of M^-1 K by a dense solver. One spring
// gives the frequency that was asked for, and any number no more.
double highest_frequency_of(int points, double point_mass, std::mt19937& random) {
  constexpr double kCornerMass = 1.0;
  const int n = points + 3;
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n, n);
  for (int p = 0; p < points; ++p) {
    FaceContact contact;
    const Vec3 w = test::random_vector(random, 0.3) + Vec3::Constant(1.0 / 3.0);
    contact.weights = w / w.sum();
    contact.normal = Vec3::UnitZ();
    const double shared = points / kCornerMass;
    const double k = contact_mass(contact, {1.0 / point_mass, {shared, shared, shared}});
    Eigen::VectorXd g = Eigen::VectorXd::Zero(n);
    g[p] = 1.0 / std::sqrt(point_mass);
    for (int i = 0; i < 3; ++i) g[points + i] = -contact.weights[i] / std::sqrt(kCornerMass);
    stiffness += k * g * g.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness);
  return std::sqrt(solver.eigenvalues().maxCoeff());
}

TEST(FaceContact, ManyOnOneFaceStayBelowOneFrequency) {
  std::mt19937 random(4);
  EXPECT_NEAR(highest_frequency_of(1, 0.5, random), 1.0, 1e-12);
  for (int points : {2, 10, 100}) {
    for (double mass : {1e-3, 1.0, 1e3}) {
      const double frequency = highest_frequency_of(points, mass, random);
      EXPECT_LE(frequency, 1.0 + 1e-12) << points << " of " << mass << " kg";
      EXPECT_GE(frequency, 0.5) << points << " of " << mass << " kg: softer than need be";
    }
  }
}

// The impulse that uses up what is stored and what comes in, by the energies before and after.
TEST(FaceContact, TheLargestImpulseGivesBackWhatThereWas) {
  for (double closing : {-2.0, 0.0, 3.0}) {
    for (double stored : {0.0, 0.5, 4.0}) {
      const double mass = 0.7;
      const double impulse = largest_passive_impulse(mass, closing, stored);
      const double after = closing - impulse / mass;
      EXPECT_NEAR(0.5 * mass * after * after, 0.5 * mass * closing * closing + stored, 1e-13);
      EXPECT_LE(after, 0.0);
    }
  }
  EXPECT_EQ(largest_passive_impulse(1.0, -1.0, -2.0), 0.0);
}

}  // namespace
}  // namespace limber

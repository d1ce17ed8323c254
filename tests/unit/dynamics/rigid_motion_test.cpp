#include "core/dynamics/rigid_motion.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <numeric>
#include <random>

#include "tests/support/lattices.h"

namespace limber {
namespace {

using std::numbers::pi;

struct Points {
  std::vector<PointMotion> motion;
  std::vector<double> mass;

  void add(double m, const Vec3& x, const Vec3& v = Vec3::Zero()) {
    motion.push_back({x, v});
    mass.push_back(m);
  }
  std::vector<std::int32_t> all() const {
    std::vector<std::int32_t> ids(mass.size());
    std::iota(ids.begin(), ids.end(), 0);
    return ids;
  }
  RigidMotion rigid() const { return rigid_motion(motion, mass, all()); }
};

void expect_near(const Vec3& found, const Vec3& wanted, double tolerance) {
  EXPECT_LE((found - wanted).norm(), tolerance)
      << found.transpose() << " instead of " << wanted.transpose();
}

// 1 kg at x = 0 and 3 kg at x = 4: centre at 3, arms -3 and 1. With 3 m/s down and 1 m/s up:
// P = 0, L = 1 * 3 * 3 + 3 * 1 * 1 = 12, I = 9 + 3 = 12, omega = 1 about +z, E = 4.5 + 1.5 = 6.
TEST(RigidMotion, OfADumbbellIsWhatAHandFinds) {
  Points points;
  points.add(1.0, {0.0, 0.0, 0.0}, {2.0, -3.0, 0.0});
  points.add(3.0, {4.0, 0.0, 0.0}, {2.0, 1.0, 0.0});
  const RigidMotion body = points.rigid();
  EXPECT_DOUBLE_EQ(body.mass, 4.0);
  expect_near(body.centre, {3.0, 0.0, 0.0}, 1e-15);
  expect_near(body.momentum(), {8.0, 0.0, 0.0}, 1e-15);
  expect_near(body.angular_momentum, {0.0, 0.0, 12.0}, 1e-14);
  expect_near(body.angular_velocity, {0.0, 0.0, 1.0}, 1e-14);
  EXPECT_NEAR(body.kinetic_energy(), 6.0 + 0.5 * 4.0 * 4.0, 1e-13);
  expect_near(body.velocity_at({0.0, 0.0, 0.0}), {2.0, -3.0, 0.0}, 1e-14);
}

// A ring of 12 points of 0.5 kg, radius 2 m: m r^2 = 24 about its axis, half of it across.
TEST(RigidMotion, OfASpinningRingHasTheInertiaOfAHoop) {
  const Vec3 axis = Vec3(1.0, 2.0, 2.0) / 3.0, velocity(1.0, -2.0, 0.5), centre(7.0, 1.0, -3.0);
  const Vec3 across = axis.unitOrthogonal();
  Points points;
  for (int i = 0; i < 12; ++i) {
    const Vec3 r = Eigen::AngleAxisd(i * pi / 6.0, axis) * (2.0 * across);
    points.add(0.5, centre + r, velocity + (5.0 * axis).cross(r));
  }
  const RigidMotion body = points.rigid();
  expect_near(body.centre, centre, 1e-14);
  expect_near(body.velocity, velocity, 1e-14);
  expect_near(body.angular_momentum, 5.0 * 24.0 * axis, 1e-12);
  expect_near(body.angular_velocity, 5.0 * axis, 1e-13);
  EXPECT_NEAR(across.dot(body.inertia * across), 12.0, 1e-13);
  EXPECT_NEAR(body.kinetic_energy(), kinetic_energy(points.motion, points.mass, points.all()),
              1e-11);
}

TEST(RigidMotion, OfCollinearPointsKeepsAllOfTheirAngularMomentum) {
  const Vec3 axis = Vec3(2.0, -1.0, 2.0) / 3.0;
  std::mt19937 random(4);
  Points points;
  for (int i = 0; i < 7; ++i) points.add(0.1 + i, 0.3 * i * axis, test::random_vector(random, 1.0));
  const RigidMotion body = points.rigid();
  expect_near(body.inertia * body.angular_velocity, body.angular_momentum,
              1e-14 * body.inertia.norm());
  EXPECT_NEAR(body.angular_velocity.dot(axis), 0.0, 1e-12);
  EXPECT_LE(body.kinetic_energy(), kinetic_energy(points.motion, points.mass, points.all()));
}

TEST(RigidMotion, OfOnePointOrNoneIsFinite) {
  Points points;
  EXPECT_EQ(points.rigid().mass, 0.0);
  EXPECT_TRUE(points.rigid().centre.allFinite());
  points.add(2.0, {1.0, 2.0, 3.0}, {4.0, 5.0, 6.0});
  expect_near(points.rigid().momentum(), {8.0, 10.0, 12.0}, 1e-15);
  EXPECT_EQ(points.rigid().angular_velocity, Vec3::Zero());
}

TEST(RigidMotion, IsThatOfTheNamedPointsOnly) {
  Points points;
  points.add(1.0, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
  points.add(9.0, {5.0, 5.0, 5.0}, {7.0, 7.0, 7.0});
  points.add(1.0, {2.0, 0.0, 0.0}, {3.0, 0.0, 0.0});
  const std::vector<std::int32_t> outer = {0, 2};
  const RigidMotion body = rigid_motion(points.motion, points.mass, outer);
  EXPECT_DOUBLE_EQ(body.mass, 2.0);
  expect_near(body.centre, {1.0, 0.0, 0.0}, 1e-15);
  // 0.5 * 1 * (1 + 9), of which the vibration along the line is not rigid: 0.5 * 2 * 4.
  EXPECT_DOUBLE_EQ(kinetic_energy(points.motion, points.mass, outer), 5.0);
  EXPECT_NEAR(body.kinetic_energy(), 4.0, 1e-14);
}

// ---------------------------------------------------------------------------------------------

std::vector<Vec3> random_cloud(const Vec3& size, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Vec3> cloud;
  for (int i = 0; i < 20; ++i) {
    cloud.push_back(test::random_vector(random, 1.0).cwiseProduct(size) + Vec3(3.0, -1.0, 2.0));
  }
  return cloud;
}

template <class Map>
Points mapped(const std::vector<Vec3>& reference, Map map) {
  Points points;
  for (std::size_t i = 0; i < reference.size(); ++i) points.add(1.0 + i % 3, map(reference[i]));
  return points;
}

Mat3 fitted(const Points& points, const std::vector<Vec3>& reference) {
  return best_rotation(points.motion, reference, points.mass, points.all());
}

void expect_recovered(const std::vector<Vec3>& reference, const Mat3& rotation) {
  const Points points = mapped(
      reference, [&](const Vec3& r) -> Vec3 { return rotation * r + Vec3(10.0, 20.0, -30.0); });
  EXPECT_LE((fitted(points, reference) - rotation).norm(), 1e-13) << rotation;
}

TEST(BestRotation, RecoversARotationOfAnyAngle) {
  const Vec3 axis = Vec3(3.0, -4.0, 12.0) / 13.0;
  for (double angle : {0.0, 1e-9, 0.5, pi / 2.0, pi - 1e-9, pi, -2.0}) {
    const Mat3 rotation = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    expect_recovered(random_cloud({1.0, 1.0, 1.0}, 5), rotation);
    expect_recovered(random_cloud({1.0, 1.0, 0.0}, 6), rotation);  // flat: rank 2
  }
}

// Mirrored across its thinnest direction, a set is best matched by not rotating it.
TEST(BestRotation, OfAMirroredSetIsProper) {
  const std::vector<Vec3> reference = random_cloud({3.0, 2.0, 0.1}, 7);
  const Points points = mapped(reference, [](const Vec3& r) { return Vec3(r.x(), r.y(), -r.z()); });
  const Mat3 rotation = fitted(points, reference);
  EXPECT_NEAR(rotation.determinant(), 1.0, 1e-13);
  EXPECT_LE((rotation - Mat3::Identity()).norm(), 0.05);
}

TEST(BestRotation, OfADegenerateSetIsProper) {
  for (const Vec3& size : {Vec3(1.0, 0.0, 0.0), Vec3(0.0, 0.0, 0.0)}) {
    const std::vector<Vec3> reference = random_cloud(size, 8);
    const Points points = mapped(reference, [](const Vec3& r) { return r; });
    const Mat3 rotation = fitted(points, reference);
    EXPECT_NEAR(rotation.determinant(), 1.0, 1e-13);
    EXPECT_LE((rotation * rotation.transpose() - Mat3::Identity()).norm(), 1e-13);
  }
}

double squared_distance(const Points& points, const std::vector<Vec3>& reference, const Mat3& R) {
  const Vec3 centre = points.rigid().centre;
  Points before = points;
  for (std::size_t i = 0; i < reference.size(); ++i) before.motion[i].position = reference[i];
  const Vec3 reference_centre = before.rigid().centre;
  double sum = 0.0;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const Vec3 x = points.motion[i].position - centre;
    sum += points.mass[i] * (x - R * (reference[i] - reference_centre)).squaredNorm();
  }
  return sum;
}

TEST(BestRotation, OfADeformedSetIsTheMassWeightedOptimum) {
  const std::vector<Vec3> reference = random_cloud({1.0, 1.0, 1.0}, 9);
  std::mt19937 random(10);
  const Points points = mapped(reference, [&](const Vec3& r) -> Vec3 {
    return Eigen::AngleAxisd(2.5, Vec3::UnitY()) * r + test::random_vector(random, 0.3);
  });
  const Mat3 best = fitted(points, reference);
  const double least = squared_distance(points, reference, best);
  for (int axis = 0; axis < 3; ++axis) {
    for (double angle : {-1e-4, 1e-4, -1.0, 1.0, pi}) {
      const Mat3 other = Eigen::AngleAxisd(angle, Vec3::Unit(axis)).toRotationMatrix() * best;
      EXPECT_GT(squared_distance(points, reference, other), least);
    }
  }
}

// ---------------------------------------------------------------------------------------------

RigidFit fit_of(const Points& points, const std::vector<Vec3>& reference) {
  return rigid_fit(points.motion, reference, points.mass, points.all());
}

// Eight equal corners stretched along their axes by s: sum m x r^T is 8 m diag(s_i a_i^2) then
// turned by Q, its singular values are the diagonal, and the corners miss by (s_i - 1) a_i.
TEST(RigidFit, OfAStretchedTurnedBoxIsWhatAHandFinds) {
  const Vec3 half(0.3, 0.2, 0.1), stretch(1.1, 0.9, 1.2);
  const Mat3 turn = Eigen::AngleAxisd(2.0, Vec3(1.0, 2.0, 2.0) / 3.0).toRotationMatrix();
  for (double mirror : {1.0, -1.0}) {
    std::vector<Vec3> reference;
    Points points;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      const Vec3 r = sign.cwiseProduct(half);
      const Vec3 scale(stretch.x(), stretch.y(), mirror * stretch.z());
      reference.push_back(r + Vec3(5.0, 0.0, -1.0));
      points.add(0.25, turn * r.cwiseProduct(scale) + Vec3(-3.0, 1.0, 7.0));
    }
    const RigidFit fit = fit_of(points, reference);
    const Vec3 moment = 2.0 * stretch.cwiseProduct(half).cwiseProduct(half);
    expect_near(fit.singular_values, {moment.x(), moment.y(), mirror * moment.z()}, 1e-15);
    EXPECT_LE((fit.rotation - turn).norm(), 1e-13);
    const Vec3 miss =
        (stretch.cwiseProduct(Vec3(1.0, 1.0, mirror)) - Vec3::Ones()).cwiseProduct(half);
    EXPECT_NEAR(fit.residual, miss.norm(), 1e-14);
  }
}

TEST(RigidFit, OfFlatPointsHasNoThirdSingularValue) {
  const std::vector<Vec3> reference = random_cloud({1.0, 1.0, 1.0}, 11);
  const Points flat = mapped(reference, [](const Vec3& r) { return Vec3(r.x(), r.y(), 4.0); });
  const RigidFit fit = fit_of(flat, reference);
  EXPECT_NEAR(fit.rotation.determinant(), 1.0, 1e-13);
  EXPECT_LE(std::abs(fit.singular_values[2]), 1e-15 * fit.singular_values[0]);
  EXPECT_NEAR(fit.residual,
              std::sqrt(squared_distance(flat, reference, fit.rotation) / flat.rigid().mass),
              1e-13);
}

TEST(RigidFit, OfNoPointsIsFinite) {
  const RigidFit fit = fit_of({}, {});
  EXPECT_EQ(fit.rotation, Mat3(Mat3::Identity()));
  EXPECT_EQ(fit.residual, 0.0);
}

}  // namespace
}  // namespace limber

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numeric>
#include <vector>

#include "bullet_bridge/rigid_proxy.h"

// The frame of a body whose points do not span space: Bullet needs a moment about every axis.

namespace limber::bullet::test {
namespace {

const Mat3 kTurn = Eigen::AngleAxisd(0.7, Vec3(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
const Vec3 kPlace(0.4, -0.3, 0.8);

// Points in motion, and their sums by definition.
struct Points {
  std::vector<PointMotion> motion;
  std::vector<double> mass;

  // Turned and placed somewhere.
  void add(double m, const Vec3& x, const Vec3& v) {
    motion.push_back({kPlace + kTurn * x, kTurn * v});
    mass.push_back(m);
  }
  double total() const { return std::accumulate(mass.begin(), mass.end(), 0.0); }
  Vec3 centre() const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < mass.size(); ++i) sum += mass[i] * motion[i].position;
    return sum / total();
  }
  Vec3 momentum() const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < mass.size(); ++i) sum += mass[i] * motion[i].velocity;
    return sum;
  }
  Vec3 spin() const {  // about the centre, kg m^2/s
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < mass.size(); ++i)
      sum += mass[i] * (motion[i].position - centre()).cross(motion[i].velocity);
    return sum;
  }
  ProxyFrame frame() const {
    std::vector<std::int32_t> all(mass.size());
    std::iota(all.begin(), all.end(), 0);
    return proxy_frame(rigid_motion(motion, mass, all));
  }
};

// P = M v and L = R I R^T omega, within rounding.
void expect_momenta_kept(const Points& points, const ProxyFrame& frame) {
  double momentum_scale = 0.0, spin_scale = 0.0;
  for (std::size_t i = 0; i < points.mass.size(); ++i) {
    const double p = points.mass[i] * points.motion[i].velocity.norm();
    momentum_scale += p;
    spin_scale += p * (points.motion[i].position - points.centre()).norm();
  }
  EXPECT_DOUBLE_EQ(frame.mass, points.total());
  EXPECT_LT((frame.centre - points.centre()).norm(), 1e-15);
  EXPECT_LT((frame.mass * frame.velocity - points.momentum()).norm(), 1e-14 * momentum_scale);
  const Mat3 axes = frame.orientation.toRotationMatrix();
  const Vec3 spin = axes * frame.moments.cwiseProduct(axes.transpose() * frame.angular_velocity);
  // Of a needle that spins: omega's rounding counts with the largest moment.
  const double turning = frame.moments[2] * frame.angular_velocity.norm();
  const double arms = 1e-15;  // m: rounding of the centre, a metre from the origin
  EXPECT_LT((spin - points.spin()).norm(), 1e-14 * (spin_scale + turning) + arms * momentum_scale);
}

// `moments` ascending, kg m^2.
void expect_moments(const ProxyFrame& frame, const Vec3& moments) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(frame.moments[i], moments[i], 1e-12 * moments[2]);
}

// Not moving with one another at all: what the sums have, the body has.
const Vec3 kVelocities[] = {{1.0, 2.0, -3.0}, {-2.0, 0.5, 1.0}, {0.3, -4.0, 2.0}, {3.0, 1.0, 1.5}};

TEST(ProxyFrame, OfTwoPointsHasAShareOfTheirMomentAboutTheirLine) {
  Points points;
  points.add(0.3, Vec3::Zero(), kVelocities[0]);
  points.add(0.7, {0.2, 0.0, 0.0}, kVelocities[1]);
  const ProxyFrame frame = points.frame();
  const double across = 0.3 * 0.7 / 1.0 * 0.2 * 0.2;  // reduced mass times distance squared
  expect_moments(frame, {1e-4 * across, across, across});
  EXPECT_TRUE(frame.regularised);
  const Vec3 line = frame.orientation.toRotationMatrix().col(0);
  EXPECT_NEAR(std::abs(line.dot(kTurn.col(0))), 1.0, 1e-12);
  EXPECT_NEAR(frame.angular_velocity.dot(line), 0.0, 1e-9);
  expect_momenta_kept(points, frame);
}

// 0.1, 0.2, 0.3 and 0.4 kg at 0, 1, 3 and 6 m, centre at 3.5: 0.1 12.25 + 0.2 6.25 + 0.3 0.25 +
// 0.4 6.25.
TEST(ProxyFrame, OfARopePulledStraightHasAShareOfItsMomentAboutItself) {
  Points points;
  const double at[] = {0.0, 1.0, 3.0, 6.0};
  for (int i = 0; i < 4; ++i) points.add(0.1 * (i + 1), {0.0, at[i], 0.0}, kVelocities[i]);
  const ProxyFrame frame = points.frame();
  EXPECT_LT((frame.centre - kPlace - 3.5 * kTurn.col(1)).norm(), 1e-14);
  expect_moments(frame, {1e-4 * 5.05, 5.05, 5.05});
  EXPECT_TRUE(frame.regularised);
  expect_momenta_kept(points, frame);
}

// Perpendicular axes: the moment across the plane is the sum of those in it; nothing is missing.
TEST(ProxyFrame, OfAFlatPieceIsItsOwn) {
  Points points;
  const Vec3 at[] = {{0.0, 0.0, 0.0}, {0.4, 0.0, 0.0}, {0.4, 0.2, 0.0}, {0.0, 0.2, 0.0}};
  for (int i = 0; i < 4; ++i) points.add(0.5, at[i], kVelocities[i]);
  const ProxyFrame frame = points.frame();
  expect_moments(frame, {2.0 * 0.01, 2.0 * 0.04, 2.0 * 0.05});
  EXPECT_FALSE(frame.regularised);
  expect_momenta_kept(points, frame);
}

// Nothing to turn: all of L is rounding. Finite moments about every axis all the same.
TEST(ProxyFrame, OfCoincidentPointsKeepsTheirMomentum) {
  Points points;
  for (int i = 0; i < 4; ++i) points.add(0.25, Vec3::Zero(), kVelocities[i]);
  const ProxyFrame frame = points.frame();
  EXPECT_GT(frame.moments.minCoeff(), 0.0);
  EXPECT_EQ(frame.moments.minCoeff(), frame.moments.maxCoeff());
  EXPECT_TRUE(frame.regularised);
  EXPECT_TRUE(frame.angular_velocity.allFinite());
  expect_momenta_kept(points, frame);
}

TEST(ProxyFrame, OfOnePointKeepsItsMomentum) {
  Points points;
  points.add(0.25, Vec3::Zero(), kVelocities[0]);
  const ProxyFrame frame = points.frame();
  EXPECT_GT(frame.moments.minCoeff(), 0.0);
  EXPECT_TRUE(frame.angular_velocity.allFinite());
  expect_momenta_kept(points, frame);
}

// A cross of 2 h on a line of 2 l, spinning about the line: its own moment 2 m h^2 there is a
// quarter of the floor, 1e-4 of 2 m (l^2 + h^2). The body keeps L and turns at a quarter.
TEST(ProxyFrame, OfANeedleKeepsItsSpinAsAngularMomentum) {
  const double m = 0.2, l = 0.5, h = 0.005 * l, spin = 40.0;
  Points points;
  for (double side : {-1.0, 1.0}) {
    points.add(m, {side * l, 0.0, 0.0}, Vec3::Zero());
    points.add(m, {0.0, side * h, 0.0}, {0.0, 0.0, side * h * spin});
  }
  const ProxyFrame frame = points.frame();
  const double own = 2.0 * m * h * h, largest = 2.0 * m * (l * l + h * h);
  EXPECT_NEAR(frame.moments[0], 1e-4 * largest, 1e-12 * largest);
  EXPECT_TRUE(frame.regularised);
  expect_momenta_kept(points, frame);
  EXPECT_NEAR(frame.angular_velocity.norm(), spin * own / (1e-4 * largest), 1e-9);
  EXPECT_NEAR(frame.angular_velocity.norm(), 0.25 * spin, 1e-3);
}

}  // namespace
}  // namespace limber::bullet::test

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/bridge/measure.h"
#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

// Thrown with a spin, a body and a lattice fly alike, and as a free rigid body does.

namespace limber::bullet::test {
namespace {

const Block kBar{.cells = {4, 2, 1}, .mass = 2.0, .modulus = 1e8};
const Vec3 kThrow(2.0, 3.0, -1.0);                          // m/s
const Vec3 kSpin = 8.0 * Vec3(1.0, 1.0, 1.0).normalized();  // rad/s, no principal axis

PhysicalModel thrown_bar() { return make_block(kBar, {0.0, 5.0, 0.0}, kThrow, kSpin); }

// Principal moments in the authored frame: the bar is symmetric about its axes.
Vec3 moments_of(const PhysicalModel& model) {
  const Vec3 centre = sums_of(model).centre();
  Vec3 moments = Vec3::Zero();
  for (PointId p : ids_of(model.points)) {
    const Vec3 squares = (model.geometry.points[p] - centre).cwiseAbs2();
    moments += model.points[p].mass * (Vec3::Constant(squares.sum()) - squares);
  }
  return moments;
}

Eigen::Vector4d derivative(const Eigen::Vector4d& q, const Vec3& momentum, const Vec3& moments) {
  const Eigen::Quaterniond orientation(q);
  const Eigen::Quaterniond unit = orientation.normalized();
  const Vec3 omega = unit * (unit.conjugate() * momentum).cwiseQuotient(moments);
  return 0.5 * (Eigen::Quaterniond(0.0, omega.x(), omega.y(), omega.z()) * orientation).coeffs();
}

// dq/dt = omega q / 2 with omega = R I^-1 R^T L and L constant, by classical Runge-Kutta.
Mat3 free_rotation(const Vec3& moments, const Vec3& omega, double seconds) {
  constexpr int kSteps = 20000;
  const double h = seconds / kSteps;
  const Vec3 momentum = moments.cwiseProduct(omega);
  Eigen::Vector4d q = Eigen::Quaterniond::Identity().coeffs();
  for (int i = 0; i < kSteps; ++i) {
    const Eigen::Vector4d a = derivative(q, momentum, moments);
    const Eigen::Vector4d b = derivative(q + 0.5 * h * a, momentum, moments);
    const Eigen::Vector4d c = derivative(q + 0.5 * h * b, momentum, moments);
    const Eigen::Vector4d d = derivative(q + h * c, momentum, moments);
    q += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  return Eigen::Quaterniond(q).normalized().toRotationMatrix();
}

double angle_between(const Mat3& a, const Mat3& b) {
  return Eigen::AngleAxisd(a * b.transpose()).angle();
}

Vec3 parabola(const Vec3& start, double t) {
  return start + kThrow * t - 0.5 * kGravity * t * t * Vec3::UnitY();
}

class Flight : public testing::TestWithParam<double> {};  // tick, s

TEST_P(Flight, OfAProxyIsTheParabola) {
  World world;
  CoSimulation simulation(*world, settings_for(Representation::kAlwaysRigid));
  const PhysicalModel bar = thrown_bar();
  simulation.add(bar);
  world.run(0.45, GetParam());
  EXPECT_LT((simulation.placement(0).second - parabola(sums_of(bar).centre(), 0.45)).norm(), 1e-5);
}

TEST_P(Flight, OfALatticeIsTheParabola) {
  World world;
  CoSimulation simulation(*world, settings_for(Representation::kAlwaysFlexible));
  const PhysicalModel bar = thrown_bar();
  simulation.add(bar);
  world.run(0.45, GetParam());
  EXPECT_LT((simulation.placement(0).second - parabola(sums_of(bar).centre(), 0.45)).norm(), 1e-5);
}

TEST_P(Flight, TurnsBothAsAFreeRigidBody) {
  const PhysicalModel bar = thrown_bar();
  const Mat3 exact = free_rotation(moments_of(bar), kSpin, 0.5);
  for (Representation as : {Representation::kAlwaysRigid, Representation::kAlwaysFlexible}) {
    World world;
    CoSimulation simulation(*world, settings_for(as));
    simulation.add(bar);
    world.run(0.5, GetParam());
    EXPECT_LT(angle_between(simulation.placement(0).first, exact), 1e-3);
  }
}

TEST_P(Flight, OfAProxyKeepsAngularMomentum) {
  World world(0.0);
  CoSimulation simulation(*world, settings_for(Representation::kAlwaysRigid));
  const PhysicalModel bar = make_block(kBar, Vec3::Zero(), Vec3::Zero(), kSpin);
  simulation.add(bar);
  world.run(5.0, GetParam());
  const Vec3 before = sums_of(bar).angular_momentum;
  const Vec3 after = simulation.pieces().at(0).motion.angular_momentum;
  EXPECT_NEAR(after.norm(), before.norm(), 1e-6 * before.norm());
  EXPECT_LT((after - before).norm(), by_precision(1e-5, 1e-9) * before.norm());
}

// A game pushes and turns a proxy as any body of its own: v = F t / m, omega = T t / I.
TEST_P(Flight, OfAProxyFollowsForcesAndTorquesOfTheGame) {
  for (bool in_air : {false, true}) {
    World world(0.0);
    CoSimulation simulation(*world, settings_for(Representation::kAlwaysRigid));
    PhysicalModel block = make_block({}, Vec3::Zero());
    if (in_air) {
      simulation.set_air(Air{});
      for (FaceAttributes& face : block.faces) face.normal_drag = 1e-12;
    }
    simulation.add(block);
    btRigidBody& body = *btRigidBody::upcast(world->getCollisionObjectArray()[0]);
    const Vec3 force(16.0, 0.0, 0.0), torque(0.0, 0.5, 0.0);
    const int ticks = static_cast<int>(std::lround(0.5 / GetParam()));
    for (int i = 0; i < ticks; ++i) {
      body.applyCentralForce(to_bullet(force));
      body.applyTorque(to_bullet(torque));
      world.step(GetParam());
    }
    const RigidMotion motion = simulation.pieces().at(0).motion;
    const double rounding = by_precision(1e-5, 1e-9);
    EXPECT_LT((motion.velocity - force * 0.5 / 8.0).norm(), rounding);
    EXPECT_LT((motion.centre - force * 0.125 / 8.0).norm(), rounding);
    EXPECT_LT((motion.angular_momentum - torque * 0.5).norm(), rounding);
    // A cube: about every axis the same moment.
    const double angle = 0.5 * torque.y() / motion.inertia(1, 1) * 0.25;
    const Mat3 turned = Eigen::AngleAxisd(angle, Vec3::UnitY()).toRotationMatrix();
    EXPECT_LT(angle_between(simulation.placement(0).first, turned), by_precision(1e-4, 1e-9));
  }
}

INSTANTIATE_TEST_SUITE_P(Ticks, Flight, testing::Values(kTick, kTick / 4.0));

}  // namespace
}  // namespace limber::bullet::test

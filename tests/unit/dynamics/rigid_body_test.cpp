#include "core/dynamics/rigid_body.h"

#include <gtest/gtest.h>

namespace limber {
namespace {

const Vec3 kMoments(0.13, 0.10, 0.05);  // kg m^2

// 3 kg, turned and moving in all directions.
RigidBody moving_body() {
  RigidBody body;
  body.inverse_mass = 1.0 / 3.0;
  body.inverse_inertia_local = kMoments.cwiseInverse().asDiagonal();
  body.position = {1.0, 2.0, 3.0};
  body.orientation = Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, 3.0).normalized());
  body.velocity = {1.0, -2.0, 3.0};
  body.angular_velocity = {0.5, 2.0, -1.0};
  refresh_rotation(body);
  return body;
}

Vec3 momentum(const RigidBody& body) { return body.velocity / body.inverse_mass; }

Vec3 angular_momentum_about_origin(const RigidBody& body) {
  return body.position.cross(momentum(body)) + angular_momentum(body);
}

// Of four mass points on two perpendicular arms that are carried along: a second way to the sums.
TEST(RigidBody, HasTheAngularMomentumAndEnergyOfItsMassPoints) {
  constexpr double kMass = 0.25, kLong = 0.4, kShort = 0.2;  // kg, m, m
  RigidBody body = moving_body();
  const double x = 2.0 * kMass * kLong * kLong, y = 2.0 * kMass * kShort * kShort;
  body.inverse_mass = 1.0 / (4.0 * kMass);
  body.inverse_inertia_local = Vec3(y, x, x + y).cwiseInverse().asDiagonal();
  refresh_rotation(body);
  Vec3 L = Vec3::Zero();
  double energy = 0.0;
  for (const Vec3& local :
       {Vec3(kLong, 0, 0), Vec3(-kLong, 0, 0), Vec3(0, kShort, 0), Vec3(0, -kShort, 0)}) {
    const Vec3 arm = body.rotation * local, velocity = body.velocity_at(body.position + arm);
    L += kMass * arm.cross(velocity);
    energy += 0.5 * kMass * velocity.squaredNorm();
  }
  EXPECT_LT((angular_momentum(body) - L).norm(), 1e-15);
  EXPECT_NEAR(kinetic_energy(body), energy, 1e-14);
}

// Against the motion of a point that is fixed in the body, by central differences.
TEST(RigidBody, VelocityAtAPointIsTheDerivativeOfItsPosition) {
  const RigidBody body = moving_body();
  const Vec3 local(0.05, -0.1, 0.2);
  constexpr double kStep = 1e-5;  // s
  const auto position_after = [&](double dt) -> Vec3 {
    RigidBody moved = body;
    advance_pose(moved, dt);
    return moved.position + moved.rotation * local;
  };
  const Vec3 numeric = (position_after(kStep) - position_after(-kStep)) / (2.0 * kStep);
  EXPECT_LT((body.velocity_at(position_after(0.0)) - numeric).norm(), 1e-8);
}

TEST(RigidBody, AnImpulseIsAllTheMomentumThatItGets) {
  RigidBody body = moving_body();
  const Vec3 impulse(0.3, -0.2, 0.5), at = body.position + Vec3(0.1, -0.2, 0.05);
  const Vec3 P = momentum(body) + impulse;
  const Vec3 L = angular_momentum_about_origin(body) + at.cross(impulse);
  body.apply_impulse(impulse, at);
  EXPECT_LT((momentum(body) - P).norm(), 1e-14);
  EXPECT_LT((angular_momentum_about_origin(body) - L).norm(), 1e-14);
}

// dE = J . (v before + v after) / 2 at the point.
TEST(RigidBody, AnImpulseDoesTheWorkOfItsMeanSpeed) {
  RigidBody body = moving_body();
  const Vec3 impulse(0.3, -0.2, 0.5), at = body.position + Vec3(0.1, -0.2, 0.05);
  const double before = kinetic_energy(body);
  Vec3 mean_velocity = 0.5 * body.velocity_at(at);
  body.apply_impulse(impulse, at);
  mean_velocity += 0.5 * body.velocity_at(at);
  EXPECT_NEAR(kinetic_energy(body) - before, impulse.dot(mean_velocity), 1e-14);
}

TEST(RigidBody, EffectiveMassIsTheAnswerToAnImpulse) {
  RigidBody body = moving_body();
  const Vec3 at = body.position + Vec3(0.1, -0.2, 0.05);
  const Vec3 normal = Vec3(1.0, 2.0, -2.0) / 3.0;
  const double before = normal.dot(body.velocity_at(at));
  body.apply_impulse(0.7 * normal, at);
  const double change = normal.dot(body.velocity_at(at)) - before;
  EXPECT_NEAR(change, 0.7 * body.inverse_effective_mass(at, normal), 1e-12);
}

// As in a game on a plane: along x and y, and about z.
TEST(RigidBody, MovesAlongAndTurnsAboutFreeAxesAlone) {
  RigidBody body = moving_body();
  body.linear_factor = {1.0, 1.0, 0.0};
  body.angular_factor = Vec3::UnitZ();
  body.velocity.z() = 0.0;
  body.angular_velocity = 3.0 * Vec3::UnitZ();
  refresh_rotation(body);
  const Vec3 at = body.position + Vec3(0.1, -0.2, 0.05);
  const Vec3 normal = Vec3(1.0, 2.0, -2.0) / 3.0;
  const double before = normal.dot(body.velocity_at(at));
  body.apply_impulse(0.7 * normal, at);
  EXPECT_NEAR(normal.dot(body.velocity_at(at)) - before,
              0.7 * body.inverse_effective_mass(at, normal), 1e-12);
  body.add_force({1.0, 2.0, 3.0}, at);
  apply_forces(body, 0.01);
  const double spin = body.angular_velocity.z();
  for (int n = 0; n < 100; ++n) advance_pose(body, 0.01);
  EXPECT_EQ(body.velocity.z(), 0.0);
  EXPECT_EQ(body.angular_velocity, spin * Vec3::UnitZ());
}

TEST(RigidBody, ForceOverTimeIsAnImpulse) {
  RigidBody pushed = moving_body(), kicked = pushed;
  const Vec3 force(30.0, -20.0, 10.0), at = pushed.position + Vec3(0.0, 0.1, 0.2);
  pushed.add_force(force, at);
  apply_forces(pushed, 0.002);
  kicked.apply_impulse(0.002 * force, at);
  EXPECT_LT((pushed.velocity - kicked.velocity).norm(), 1e-14);
  EXPECT_LT((pushed.angular_velocity - kicked.angular_velocity).norm(), 1e-13);
  EXPECT_TRUE(pushed.force.isZero(0.0) && pushed.torque.isZero(0.0));
}

// A symmetric top precesses about L at |L| / I_1 (Goldstein, Classical Mechanics, 5.6): its axis
// goes round a cone, and so does the angular velocity.
TEST(RigidBody, PrecessesFreelyInClosedForm) {
  RigidBody body;
  const Vec3 moments(2.0, 2.0, 1.0), start(1.5, 0.0, 6.0);
  body.inverse_mass = 1.0;
  body.inverse_inertia_local = moments.cwiseInverse().asDiagonal();
  body.angular_velocity = start;
  refresh_rotation(body);
  constexpr double kSeconds = 3.0, kStep = 1e-3;
  for (int n = 0; n < 3000; ++n) advance_pose(body, kStep);
  const Vec3 L = moments.cwiseProduct(start);
  const Eigen::AngleAxisd precession(L.norm() / moments.x() * kSeconds, L.normalized());
  EXPECT_LT((body.rotation.col(2) - precession * Vec3::UnitZ()).norm(), 1e-11);
  EXPECT_LT((body.angular_velocity - precession * start).norm(), 1e-10);
}

// About no axis of its own, for a hundred turns.
TEST(RigidBody, KeepsItsAngularMomentumToRounding) {
  RigidBody body = moving_body();
  const Vec3 L = angular_momentum(body);
  const double energy = kinetic_energy(body);
  for (int n = 0; n < 30000; ++n) advance_pose(body, 0.01);
  EXPECT_LT((angular_momentum(body) - L).norm(), 1e-11 * L.norm());
  EXPECT_NEAR(kinetic_energy(body), energy, 1e-6 * energy);
}

TEST(RigidBody, ThatIsImmovableKeepsItsVelocities) {
  RigidBody body;
  body.velocity = Vec3::UnitX();
  body.angular_velocity = Vec3::UnitZ();
  body.apply_impulse({1.0, 2.0, 3.0}, {0.3, 0.0, 0.0});
  body.add_force({1.0, 2.0, 3.0}, {0.3, 0.0, 0.0});
  apply_forces(body, 0.1);
  advance_pose(body, 0.1);
  EXPECT_FALSE(body.movable());
  EXPECT_EQ(body.velocity, Vec3(Vec3::UnitX()));
  EXPECT_EQ(body.angular_velocity, Vec3(Vec3::UnitZ()));
  EXPECT_EQ(body.position, Vec3(0.1, 0.0, 0.0));
}

// A body that cannot turn about an axis of its own has no free precession.
TEST(RigidBody, WithALockedAxisTurnsAtItsAngularVelocity) {
  RigidBody body = moving_body();
  body.inverse_inertia_local(0, 0) = 0.0;
  body.angular_velocity = Vec3(0.0, 2.0, 0.0);
  const Eigen::Quaterniond start = body.orientation;
  for (int n = 0; n < 10; ++n) advance_pose(body, 0.1);
  EXPECT_EQ(body.angular_velocity, Vec3(0.0, 2.0, 0.0));
  const Eigen::Quaterniond exact = Eigen::AngleAxisd(2.0, Vec3::UnitY()) * start;
  EXPECT_LT(body.orientation.angularDistance(exact), 1e-14);
}

}  // namespace
}  // namespace limber

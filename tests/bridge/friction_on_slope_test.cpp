#include <gtest/gtest.h>

#include <cmath>

#include "tests/bridge/measure.h"
#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

// A lattice on a slope of Bullet's: it stays as long as tan(slope) < mu, and slides with
// g (sin - mu cos) from there on.

namespace limber::bullet::test {
namespace {

constexpr double kFriction = 0.5;  // tan of 26.6 degrees
constexpr double kThick = 1.0;     // m, of the slope
constexpr Block kBlock = {.cells = {3, 1, 3},
                          .mass = 3.0,
                          .modulus = 1e6,
                          .damping_ratio = 0.2,
                          .internal_damping = 5.0,
                          .friction = kFriction};

// Down the slope, and out of it.
struct Slope {
  double angle;  // rad
  Vec3 down() const { return {std::cos(angle), -std::sin(angle), 0.0}; }
  Vec3 normal() const { return {std::sin(angle), std::cos(angle), 0.0}; }
};

// A block on a slope through the origin, a millimetre above it.
struct OnSlope {
  World world;
  Slope slope;
  CoSimulation simulation;

  explicit OnSlope(double angle, Representation representation)
      : slope{angle}, simulation(*world, settings_for(representation)) {
    btRigidBody& box = world.add_box({20.0, 0.5 * kThick, 5.0}, 0.0, Vec3::Zero());
    const btQuaternion tilt(btVector3(0, 0, 1), btScalar(-angle));
    const Vec3 centre = -0.5 * kThick * slope.normal();
    box.setWorldTransform(btTransform(tilt, to_bullet(centre)));
    world->updateSingleAabb(&box);
    box.setFriction(1);
    PhysicalModel block = make_block(kBlock, Vec3::Zero());
    const Mat3 turned = Eigen::AngleAxisd(-angle, Vec3::UnitZ()).toRotationMatrix();
    place(block, turned, (0.5 * kBlock.size().y() + 1e-3) * slope.normal());
    simulation.add(block);
  }
  Sums after(double seconds) {
    world.run(seconds, kTick);
    EXPECT_FALSE(simulation.failure());
    return sums_of(simulation.model(0));
  }
};

// m, down the slope in three seconds. The block lies 2 mm deep in its contact: a twentieth of that
// is no creeping.
double drift_after_settling(double share_of_friction, Representation representation) {
  OnSlope on(std::atan(share_of_friction * kFriction), representation);
  const Sums settled = on.after(2.0), later = on.after(3.0);
  return (later.centre() - settled.centre()).dot(on.slope.down());
}
constexpr double kNoDrift = 1e-4;

TEST(FrictionOnSlope, HoldsABody) {
  for (double share : {0.2, 0.5, 0.9}) {
    EXPECT_NEAR(drift_after_settling(share, Representation::kSwitching), 0.0, kNoDrift) << share;
  }
}

TEST(FrictionOnSlope, HoldsALattice) {
  for (double share : {0.2, 0.5, 0.9}) {
    EXPECT_NEAR(drift_after_settling(share, Representation::kAlwaysFlexible), 0.0, kNoDrift)
        << share;
  }
}

// Friction's impulse is mu times the normal's: what weight gives in this time, and what changes the
// speed across the slope. A point that trembles up the slope for a substep is pulled down: 0.5 %.
TEST(FrictionOnSlope, LetsSlideByTheCoulombLaw) {
  constexpr double kTime = 0.5;  // s
  for (double share : {1.2, 2.0}) {
    OnSlope on(std::atan(share * kFriction), Representation::kAlwaysFlexible);
    const Sums first = on.after(0.5), last = on.after(kTime);
    const Vec3 gained = last.velocity() - first.velocity();
    const double normal =
        kGravity * std::cos(on.slope.angle) * kTime + gained.dot(on.slope.normal());
    const double expected = kGravity * std::sin(on.slope.angle) * kTime - kFriction * normal;
    EXPECT_NEAR(gained.dot(on.slope.down()), expected, 0.005 * expected) << share;
  }
}

}  // namespace
}  // namespace limber::bullet::test

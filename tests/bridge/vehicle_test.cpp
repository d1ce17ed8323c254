#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>

#include "tests/bridge/measure.h"
#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

// A raycast vehicle of Bullet's on a lattice.

namespace limber::bullet::test {
namespace {

constexpr double kCarMass = 60.0;  // kg
constexpr double kSpan = 2.0;      // m
constexpr double kDeck = 0.2;      // m, its thickness

// A deck of 40 kg that pins hold at both ends; its top is at y = 0.
PhysicalModel deck() {
  PhysicalModel model = make_block(
      {.cells = {10, 1, 4}, .spacing = kDeck, .mass = 40.0, .modulus = 2.5e6, .damping_ratio = 0.3},
      {0.0, -0.5 * kDeck, 0.0});
  for (PointId p : ids_of(model.points)) {
    model.points[p].pinned = std::abs(model.geometry.points[p].x()) > 0.5 * kSpan - 0.01;
  }
  return model;
}

// Largest depth of the deck's upper middle line, m.
double sag_of(const CoSimulation& simulation) {
  double lowest = 0.0;
  const PhysicalModel model = simulation.model(0);
  for (PointId p : ids_of(model.points)) {
    const Vec3& authored_top = model.geometry.points[p];
    if (p.index() / 11 % 2 == 1) lowest = std::min(lowest, authored_top.y());
  }
  return -lowest;
}

class Car {
 public:
  explicit Car(World& world)
      : world_(world),
        chassis_(world.add_box({0.4, 0.1, 0.25}, kCarMass, {0.0, 0.35, 0.0})),
        raycaster_(&*world),
        vehicle_({}, &chassis_, &raycaster_) {
    // Springs (1/s^2) that its weight compresses by g / (4 k) = 5 cm, half of critical damping.
    btRaycastVehicle::btVehicleTuning tuning;
    tuning.m_suspensionStiffness = 50;
    tuning.m_suspensionDamping = tuning.m_suspensionCompression = 7;
    chassis_.setActivationState(DISABLE_DEACTIVATION);
    world->addVehicle(&vehicle_);
    vehicle_.setCoordinateSystem(2, 1, 0);
    for (int i = 0; i < 4; ++i) {
      const btVector3 place(btScalar(0.5 * (i % 2) - 0.25), 0, btScalar(0.4 * (i / 2) - 0.2));
      vehicle_.addWheel(place, {0, -1, 0}, {0, 0, -1}, btScalar(0.2), btScalar(0.1), tuning, false);
      vehicle_.setBrake(100, i);
    }
  }
  ~Car() { world_->removeVehicle(&vehicle_); }

  const btRigidBody& chassis() const { return chassis_; }
  double load() const {  // N
    double sum = 0.0;
    for (int i = 0; i < 4; ++i) sum += vehicle_.getWheelInfo(i).m_wheelsSuspensionForce;
    return sum;
  }
  void press(CoSimulation& simulation) const {
    for (int i = 0; i < 4; ++i) {
      const btWheelInfo& wheel = vehicle_.getWheelInfo(i);
      simulation.apply_impulse(0, {0.0, -kTick * wheel.m_wheelsSuspensionForce, 0.0},
                               from_bullet(wheel.m_raycastInfo.m_contactPointWS));
    }
  }

 private:
  World& world_;
  btRigidBody& chassis_;
  btDefaultVehicleRaycaster raycaster_;
  btRaycastVehicle vehicle_;
};

Vec3 place_of(const Car& car) { return from_bullet(car.chassis().getCenterOfMassPosition()); }

// m, after six seconds; `weight`: a box that lies where the car stands.
double sag_under_box(double weight) {
  World world;
  CoSimulation simulation(*world);
  simulation.add(deck(), Integration::kImplicit);  // does not vibrate
  if (weight > 0.0) world.add_box({0.3, 0.05, 0.25}, weight, {0.0, 0.06, 0.0});
  world.run(6.0, kTick);
  return sag_of(simulation);
}

TEST(Vehicle, StandsOnALatticeAndWeighsOnItAsABoxDoes) {
  World world;
  CoSimulation simulation(*world);
  simulation.add(deck(), Integration::kImplicit);  // does not vibrate
  Car car(world);
  Vec3 before = Vec3::Zero();
  for (int tick = 0; tick < 360; ++tick) {
    if (tick == 300) before = place_of(car);
    world.step(kTick);
    car.press(simulation);
  }
  ASSERT_FALSE(simulation.failure());
  EXPECT_LT((place_of(car) - before).norm(), 1e-3);
  EXPECT_NEAR(car.load(), kCarMass * kGravity, 0.05 * kCarMass * kGravity);
  const double bare = sag_under_box(0.0);
  const double under_car = sag_of(simulation) - bare;
  const double under_box = sag_under_box(kCarMass) - bare;
  EXPECT_GT(under_box, 0.002);
  // Wheels stand at the corners of the box: not quite the same load.
  EXPECT_NEAR(under_car, under_box, 0.2 * under_box);
}

}  // namespace
}  // namespace limber::bullet::test

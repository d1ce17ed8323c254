#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "tests/bridge/measure.h"
#include "tests/bridge/models.h"
#include "tests/bridge/substep_reference.h"
#include "tests/bridge/world.h"

// A lattice falls on a stack of three boxes. What Limber integrates at the substep rate inside of
// one tick is compared with a world whose tick is the substep, in which Bullet itself solves every
// contact that often.

namespace limber::bullet::test {
namespace {

constexpr int kSubsteps = 256;
constexpr double kImpactSpeed = 3.0;  // m/s, downwards
const Vec3 kBoxHalf(0.25, 0.15, 0.25);

struct Stack {
  std::string name;
  std::array<double, 3> masses;  // kg, from the bottom
  Vec3 offset;                   // of the lattice from the stack's axis, m
  Vec3 sideways;                 // its velocity beside the fall, m/s
  double tolerance;              // m/s
};

double lightest(const Stack& stack) {  // kg
  return *std::min_element(stack.masses.begin(), stack.masses.end());
}

void PrintTo(const Stack& stack, std::ostream* out) { *out << stack.name; }

struct Outcome {
  std::array<Sums, 4> bodies;  // three boxes and the lattice
  std::array<Vec3, 3> spins;
  double energy = 0.0;         // J, of all
  double most_energy = 0.0;    // J, highest of any 1/60 s
  double start_energy = 0.0;   // J
  double lattice_depth = 0.0;  // m, deepest lattice point in a box, of any 1/60 s
  double box_depth = 0.0;  // m, how far the stack's boxes sank into one another, by their height
};

double deepest_point(const PhysicalModel& model, const btRigidBody& box) {
  double depth = 0.0;
  for (const Vec3& x : model.geometry.points) {
    const btTransform& pose = box.getWorldTransform();
    const Vec3 local =
        from_bullet(pose.getRotation()).conjugate() * (x - from_bullet(pose.getOrigin()));
    const double inside = (kBoxHalf - local.cwiseAbs()).minCoeff();
    depth = std::max(depth, inside);
  }
  return depth;
}

double deepest_support(btDiscreteDynamicsWorld& world) {
  double depth = 0.0;
  btDispatcher& dispatcher = *world.getDispatcher();
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    for (int c = 0; c < manifold.getNumContacts(); ++c) {
      depth = std::max(depth, -double(manifold.getContactPoint(c).getDistance()));
    }
  }
  return depth;
}

// The stack at rest, and the lattice just above it.
struct Scene {
  World world;
  std::vector<btRigidBody*> boxes;
  PhysicalModel model;
};

std::unique_ptr<Scene> make_scene(const Stack& stack) {
  auto scene = std::make_unique<Scene>();
  World& world = scene->world;
  world.add_ground();
  for (int i = 0; i < 3; ++i) {
    const Vec3 centre(0.0, (2 * i + 1) * kBoxHalf.y(), 0.0);
    scene->boxes.push_back(&world.add_box(kBoxHalf, stack.masses[i], centre));
    scene->boxes.back()->setActivationState(DISABLE_DEACTIVATION);
  }
  // With its usual 10 iterations Bullet's own stack of 100 : 1 sinks together before anything hits
  // it.
  world->getSolverInfo().m_numIterations = 500;
  world.run(0.5, kTick);
  const double height = scene->boxes[2]->getWorldTransform().getOrigin().y();
  EXPECT_NEAR(height, 5.0 * kBoxHalf.y(), 0.005) << "the stack does not stand by itself";
  const Vec3 start = stack.offset + Vec3(0.0, 6.0 * kBoxHalf.y() + 0.15 + 0.01, 0.0);
  scene->model = make_block({}, start, stack.sideways - kImpactSpeed * Vec3::UnitY());
  return scene;
}

void note(Outcome& outcome, Scene& scene, const PhysicalModel& model) {
  outcome.bodies[3] = sums_of(model);
  outcome.energy = outcome.bodies[3].energy(kGravity);
  for (int i = 0; i < 3; ++i) {
    const btRigidBody& box = *scene.boxes[i];
    outcome.bodies[i] = sums_of(box);
    outcome.spins[i] = from_bullet(box.getAngularVelocity());
    outcome.energy += outcome.bodies[i].energy(kGravity);
    outcome.lattice_depth = std::max(outcome.lattice_depth, deepest_point(model, box));
  }
  outcome.most_energy = std::max(outcome.most_energy, outcome.energy);
  outcome.box_depth = std::max(outcome.box_depth, deepest_support(*scene.world));
}

Outcome limbers(const Stack& stack, double seconds, double tick) {
  const auto scene = make_scene(stack);
  const double scale = step_scale_for(scene->model, kTick / kSubsteps);
  // As precise as the reference: rounding alone makes a sideways hit differ by 0.3 m/s.
  CoSimulationSettings settings = settings_for(Representation::kAlwaysFlexible, scale);
  settings.springs = SpringPrecision::kDouble;
  CoSimulation simulation(*scene->world, settings);
  simulation.add(scene->model);
  Outcome outcome;
  note(outcome, *scene, scene->model);
  outcome.start_energy = outcome.energy;
  for (double t = 0.5 * kTick; t < seconds; t += kTick) {
    scene->world.run(kTick, tick);
    EXPECT_FALSE(simulation.failure());
    note(outcome, *scene, simulation.model(0));
  }
  return outcome;
}

Outcome at_the_substep_rate(const Stack& stack, double seconds) {
  const auto scene = make_scene(stack);
  SubstepReference reference(scene->world, scene->model);
  Outcome outcome;
  note(outcome, *scene, scene->model);
  outcome.start_energy = outcome.energy;
  for (double t = 0.5 * kTick; t < seconds; t += kTick) {
    for (int n = 0; n < kSubsteps; ++n) reference.step(kTick / kSubsteps);
    note(outcome, *scene, reference.model());
  }
  return outcome;
}

struct Deviation {
  double velocity = 0.0;       // m/s, worst of three boxes and the lattice
  double spin = 0.0;           // m/s, of the boxes' rims
  double position = 0.0;       // m
  double box_depth = 0.0;      // m, overlap of boxes beyond the other's
  double lattice_depth = 0.0;  // m, of points in boxes beyond the other's
  double energy = 0.0;         // J
};

Deviation between(const Outcome& a, const Outcome& b) {
  Deviation worst;
  for (int i = 0; i < 4; ++i) {
    worst.velocity =
        std::max(worst.velocity, (a.bodies[i].velocity() - b.bodies[i].velocity()).norm());
    worst.position = std::max(worst.position, (a.bodies[i].centre() - b.bodies[i].centre()).norm());
  }
  for (int i = 0; i < 3; ++i) {
    worst.spin = std::max(worst.spin, (a.spins[i] - b.spins[i]).norm() * kBoxHalf.norm());
  }
  worst.box_depth = a.box_depth - b.box_depth;
  worst.lattice_depth = a.lattice_depth - b.lattice_depth;
  worst.energy = std::abs(a.energy - b.energy);
  return worst;
}

class StackImpact : public testing::TestWithParam<Stack> {};

constexpr double kSeconds = 0.2;

// Boxes follow to 8 % of the impact speed, one and a half ticks of gravity: Bullet's own contacts
// between them are no sharper (measured up to 0.11 m/s).
constexpr double kTypical = 0.08 * kImpactSpeed;
// Here Bullet's manifold between the two lower boxes has lost a corner when the tick begins, and
// has the middle of an edge instead: the boxes tip over there for a whole tick of 1/60 s, while a
// tick of a substep finds the corner again (0.40 m/s in float64, 0.26 in float32).
constexpr double kLostCorner = 0.15 * kImpactSpeed;

// Where light boxes tip is chaotic: moved by a nanometre, the same run has rims that deviate by
// 0.09 to 1.04 m/s. What is typical of such starts is not.
bool is_chaotic(const Stack& stack) {
  return lightest(stack) < 1.0 && stack.offset != Vec3::Zero();
}

std::vector<Stack> starts_of(const Stack& stack) {
  std::vector<Stack> starts;
  for (int k = 0; k < (is_chaotic(stack) ? 5 : 1); ++k) {
    starts.push_back(stack);
    starts.back().offset.x() += k * 1e-9;
  }
  return starts;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

Deviation median(const std::vector<Deviation>& all) {
  const auto of = [&](double Deviation::*number) {
    std::vector<double> values;
    for (const Deviation& deviation : all) values.push_back(deviation.*number);
    return median(std::move(values));
  };
  return {of(&Deviation::velocity),  of(&Deviation::spin),          of(&Deviation::position),
          of(&Deviation::box_depth), of(&Deviation::lattice_depth), of(&Deviation::energy)};
}

void expect_small(const Deviation& deviation, const Stack& stack) {
  const double velocity_tolerance = stack.tolerance;
  // Overlap of boxes 300 mm high beyond the reference's: 5 mm for solid ones. A box of 0.2 kg that
  // 8 kg press on within one tick sinks farther before Bullet mends it (measured up to 10.9 mm,
  // float32; one start in five of a nanometre's difference 45 mm, float64).
  EXPECT_LT(deviation.box_depth, lightest(stack) < 1.0 ? 0.012 : 0.005);
  EXPECT_LT(deviation.velocity, velocity_tolerance);
  EXPECT_LT(deviation.spin, 2.0 * velocity_tolerance);
  EXPECT_LT(deviation.position, velocity_tolerance * kSeconds);
  EXPECT_LT(deviation.lattice_depth, 0.002);
  // A few per cent of what the impact brought (36 J). Most for boxes of a fortieth of the lattice's
  // mass: 1.84 J in float64 (1.12 J if contact stopped light things at twice its soft depth).
  EXPECT_LT(deviation.energy, 0.055 * 0.5 * 8.0 * kImpactSpeed * kImpactSpeed);
}

TEST_P(StackImpact, IsThatOfATickAsShortAsTheSubstep) {
  std::vector<Deviation> deviations;
  for (const Stack& stack : starts_of(GetParam())) {
    const Outcome fine = limbers(stack, kSeconds, kTick / kSubsteps);
    deviations.push_back(between(limbers(stack, kSeconds, kTick), fine));
  }
  expect_small(median(deviations), GetParam());
}

TEST_P(StackImpact, IsThatOfAnIndependentReference) {
  std::vector<Deviation> deviations;
  for (const Stack& stack : starts_of(GetParam())) {
    const Outcome reference = at_the_substep_rate(stack, kSeconds);
    deviations.push_back(between(limbers(stack, kSeconds, kTick), reference));
  }
  expect_small(median(deviations), GetParam());
}

// Boxes and ground are inelastic: nothing may bring energy in. 1 % for Bullet's rounding.
TEST_P(StackImpact, GainsNoEnergy) {
  const Outcome got = limbers(GetParam(), kSeconds, kTick);
  EXPECT_LT(got.most_energy, got.start_energy * 1.01);
}

const Vec3 kAtRest = Vec3::Zero();
const Vec3 kOff(0.12, 0.0, 0.07);
const Vec3 kDrift(1.0, 0.0, 0.5);

INSTANTIATE_TEST_SUITE_P(
    Masses, StackImpact,
    testing::Values(
        Stack{"Equal", {2, 2, 2}, Vec3::Zero(), kAtRest, kTypical},
        Stack{"LightOnHeavy", {20, 2, 0.2}, Vec3::Zero(), kAtRest, kTypical},
        Stack{"HeavyOnLight", {0.2, 2, 20}, Vec3::Zero(), kAtRest, kTypical},
        Stack{"AllLight", {0.2, 0.2, 0.2}, Vec3::Zero(), kAtRest, kTypical},
        Stack{"AllHeavy", {20, 20, 20}, Vec3::Zero(), kAtRest, kTypical},
        Stack{"EqualOffCentre", {2, 2, 2}, kOff, kDrift, kTypical},
        Stack{"LightOnHeavyOffCentre", {20, 2, 0.2}, kOff, kDrift, kTypical},
        Stack{"HeavyOnLightOffCentre", {0.2, 2, 20}, kOff, kDrift, kTypical},
        Stack{"AllLightOffCentre", {0.2, 0.2, 0.2}, kOff, kDrift, kTypical},
        // A millimetre higher: a box of 0.2 kg under 8 kg must not slip out for that.
        Stack{"AllLightHigher", {0.2, 0.2, 0.2}, kOff + 0.001 * Vec3::UnitY(), kDrift, kTypical},
        Stack{"AllHeavyOffCentre", {20, 20, 20}, kOff, kDrift, kTypical},
        Stack{"AllHeavyOnTheEdge", {20, 20, 20}, {0.3, 0, 0}, kAtRest, kTypical},
        Stack{"EqualSideways", {2, 2, 2}, Vec3::Zero(), {2.0, 0, 0}, kLostCorner}),
    [](const auto& stack) { return stack.param.name; });

// Struck on the edge by a lattice of 8 kg, boxes of 0.2 kg topple, and how is chaotic (the worst
// box's velocity differs by 1.2 m/s between the runs); those of 2 kg have the lattice hang on the
// edge by its faces, and differ by 0.39 m/s (docs/limits.md). What must hold is that nothing is
// gained.
TEST(StackStruckOnTheEdge, GainsNoEnergy) {
  for (double mass : {0.2, 2.0}) {
    const Stack stack{"", {mass, mass, mass}, {0.3, 0, 0}, kAtRest, 0.0};
    const Outcome got = limbers(stack, kSeconds, kTick);
    EXPECT_LT(got.most_energy, got.start_energy * 1.01) << mass << " kg";
  }
}

}  // namespace
}  // namespace limber::bullet::test

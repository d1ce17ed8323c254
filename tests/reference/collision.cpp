#include "tests/reference/collision.h"

#include <algorithm>
#include <stdexcept>

#include "core/analysis/vibration.h"
#include "tests/reference/build.h"
#include "tests/reference/hermite.h"

namespace limber::reference {
namespace {

constexpr double kStepShare = 0.001;  // of the largest stable step
// Where only what is left in the end counts: with shorter steps the last changes of a velocity
// would be lost in rounding.
constexpr double kStickingStepShare = 0.05;
constexpr double kGivesUp = 60.0;  // times 1 / omega0

PhysicalModel joined(const Colliders& two, const LinearContact& contact, double distance) {
  const bool wall = two.m2 == 0.0;
  return network({{Vec3::Zero(), two.m1, two.v1 * Vec3::UnitX()},
                  {distance * Vec3::UnitX(), wall ? 1.0 : two.m2, two.v2 * Vec3::UnitX(), wall}},
                 {{0, 1, contact.stiffness, distance, contact.damping}});
}

double force(const Run& run, const LinearContact& contact) {
  return contact.stiffness * stretch(run.lattice(), 0) +
         contact.damping * stretch_rate(run.lattice(), 0);
}

bool has_ended(const Run& run, const LinearContact& contact, EndOfContact end) {
  if (end == EndOfContact::kNever || stretch_rate(run.lattice(), 0) <= 0.0) return false;
  return end == EndOfContact::kOverlap ? stretch(run.lattice(), 0) >= 0.0
                                       : force(run, contact) >= 0.0;
}

Reading overlap(const Run& run) {
  return {run.time(), -stretch(run.lattice(), 0), -stretch_rate(run.lattice(), 0)};
}

}  // namespace

PhysicalModel touching(const Colliders& colliders, const LinearContact& contact) {
  const double closing = colliders.v1 - colliders.v2;
  if (!(closing > 0.0)) throw std::runtime_error("the two do not approach");
  // Without damping they overlap by closing / omega0.
  const double omega = exact_highest_frequency(joined(colliders, contact, 1.0));
  return joined(colliders, contact, 2.0 * closing / omega);
}

Collision collide(const Colliders& colliders, const LinearContact& contact, EndOfContact end) {
  PhysicalModel model = touching(colliders, contact);
  const double gives_up = kGivesUp / exact_highest_frequency(model);
  Run run(std::move(model));
  Collision result;
  result.energy_before = kinetic_energy(run.lattice());
  const double share = end == EndOfContact::kNever ? kStickingStepShare : kStepShare;
  PeakRecorder depth;
  depth.read(overlap(run));
  for (bool ended = false; !ended && run.time() < gives_up;) {
    const double dt = std::min(share * run.stable_step(), gives_up - run.time());
    ended = run.step_until([&] { return has_ended(run, contact, end); }, dt);
    depth.read(overlap(run));
  }
  result.contact_time = run.time();
  result.deepest = depth.highest().value;
  result.stored_energy = 0.5 * contact.stiffness * result.deepest * result.deepest;
  result.v1 = run.lattice().motion[0].velocity.x();
  result.v2 = run.lattice().motion[1].velocity.x();
  result.energy_after = kinetic_energy(run.lattice());
  return result;
}

// How stiff the contact is does not matter.
Collision elastic_collision(const Colliders& colliders) {
  return collide(colliders, {.stiffness = 1.0}, EndOfContact::kOverlap);
}

// Critically damped, so that they stick without vibration.
Collision plastic_collision(const Colliders& colliders) {
  const LinearContact spring{.stiffness = 1.0};
  const double omega = exact_highest_frequency(touching(colliders, spring));
  return collide(colliders, {spring.stiffness, 2.0 * spring.stiffness / omega},
                 EndOfContact::kNever);
}

}  // namespace limber::reference

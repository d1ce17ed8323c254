// Group 8: two points collide, and the limits of what any collision may do.

#include "tests/reference/collision.h"
#include "tests/reference/json_values.h"
#include "tests/reference/kinds.h"
#include "tests/reference/oscillation.h"

namespace limber::reference {
namespace {

Colliders colliders_of(const Json& p) { return {p.at("m1"), p.at("m2"), p.at("v1"), p.at("v2")}; }

// The damping ratio of the contact, from how the two swing on when they stick.
double damping_ratio(const Colliders& colliders, const LinearContact& contact) {
  constexpr int kSamples = 60, kStepsBetween = 200;
  constexpr double kStepShare = 0.001;  // of the largest stable step
  Run run(touching(colliders, contact));
  const double interval = kStepsBetween * kStepShare * run.stable_step();
  std::vector<double> samples;
  for (int i = 0; i < kSamples; ++i) {
    samples.push_back(stretch(run.lattice(), 0));
    run.advance_to((i + 1) * interval, kStepShare * run.stable_step());
  }
  return fit_oscillation(samples, interval).zeta;
}

void add_law(const Colliders& colliders, const Collision& collision, const std::string& law,
             Json& found) {
  const bool wall = colliders.m2 == 0.0;
  found["contact_time_" + law] = collision.contact_time;
  found["restitution_" + law] = (collision.v2 - collision.v1) / (colliders.v1 - colliders.v2);
  found["v_after_" + law] = wall ? Json{collision.v1} : Json{collision.v1, collision.v2};
  found["energy_loss_" + law] = collision.energy_before - collision.energy_after;
}

Json point_penalty(const Case& c) {
  const Colliders colliders = colliders_of(c.params);
  const LinearContact contact{c.params.at("k"), c.params.at("c")};
  const Collision overlap = collide(colliders, contact, EndOfContact::kOverlap);
  Json found;
  found["zeta"] = damping_ratio(colliders, contact);
  found["max_overlap"] = overlap.deepest;
  add_law(colliders, overlap, "overlap_law", found);
  add_law(colliders, collide(colliders, contact, EndOfContact::kForce), "force_law", found);
  return found;
}

// A flexible body of one point, which cannot vibrate, and a box that cannot turn.
Json energy_bounds(const Case& c) {
  const Colliders bodies{c.params.at("m"), c.params.at("M"), c.params.at("v"), c.params.at("V")};
  const Collision elastic = elastic_collision(bodies), plastic = plastic_collision(bodies);
  return {{"momentum", bodies.m1 * elastic.v1 + bodies.m2 * elastic.v2},
          {"v_common_plastic", plastic.v2},
          {"v_after_elastic", {elastic.v1, elastic.v2}},
          {"E_before", elastic.energy_before},
          {"E_min_translational", plastic.energy_after},
          {"E_max_internal", elastic.stored_energy}};
}

}  // namespace

Kinds point_collision_kinds() {
  return {{"point_penalty", point_penalty}, {"energy_bounds", energy_bounds}};
}

}  // namespace limber::reference

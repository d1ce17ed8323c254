#pragma once

#include "tests/reference/run.h"

namespace limber::reference {

// Two points on a line, the first on the left. A mass of 0 stands for a wall that keeps its speed
// of 0.
struct Colliders {
  double m1 = 1.0, m2 = 1.0;  // kg
  double v1 = 0.0, v2 = 0.0;  // m/s, to the right
};

// A penalty contact: stiffness k times the overlap and damping c times its rate.
struct LinearContact {
  double stiffness = 0.0;  // N/m
  double damping = 0.0;    // N s/m
};

// The two when they begin to overlap. The contact is a spring with a damper; its rest length is
// longer than they can overlap, so that they do not change places. Edge 0, points 0 and 1.
PhysicalModel touching(const Colliders& colliders, const LinearContact& contact);

// When a contact ends. The case files ask for both laws.
enum class EndOfContact {
  kOverlap,  // when nothing overlaps any more; the damper may hold them back before
  kForce,    // when the force would pull
  kNever,    // they stick
};

// What came of a collision.
struct Collision {
  double contact_time = 0.0;   // s
  double deepest = 0.0;        // m, the largest overlap
  double stored_energy = 0.0;  // J, in the contact's spring then, when both move as one
  double v1 = 0.0, v2 = 0.0;   // m/s
  double energy_before = 0.0;  // J, kinetic
  double energy_after = 0.0;   // J, kinetic
};

// Contacts that do not end within 60 / omega0 are given up there, omega0 being the frequency of the
// contact without damping.
Collision collide(const Colliders& colliders, const LinearContact& contact, EndOfContact end);

// The two limits of what a collision may do: nothing is lost, and they stick together.
Collision elastic_collision(const Colliders& colliders);
Collision plastic_collision(const Colliders& colliders);

}  // namespace limber::reference

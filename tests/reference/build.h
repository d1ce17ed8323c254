#pragma once

#include <vector>

#include "core/model/physical_model.h"

namespace limber::reference {

struct MassPoint {
  Vec3 position;                 // m
  double mass = 1.0;             // kg
  Vec3 velocity = Vec3::Zero();  // m/s
  bool pinned = false;
};

struct Bond {
  int a = 0, b = 0;          // indices of points
  double stiffness = 0.0;    // N/m
  double rest_length = 0.0;  // m
  double damping = 0.0;      // N s/m
};

// Points and edges alone, without contact between the points.
PhysicalModel network(const std::vector<MassPoint>& points, const std::vector<Bond>& bonds);

// Neighbours in the given order joined by equal edges.
std::vector<Bond> chain_bonds(std::size_t points, double stiffness, double rest_length,
                              double damping = 0.0);

// Moves the model so that its centre of mass is at the origin.
void centre(PhysicalModel& model);

// Every edge breaks on this difference in length, longer or shorter (m).
void break_either_way(PhysicalModel& model, double threshold);

// To the equilibrium near where the model is. Throws std::runtime_error where none is found.
void settle_or_throw(PhysicalModel& model, const Vec3& gravity);

}  // namespace limber::reference

#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "core/model/physical_model.h"

namespace limber::reference {

using Json = nlohmann::json;

Vec3 vec3(const Json& numbers);  // [x, y, z]
Json to_json(const Vec3& vector);
Json to_json(const Mat3& matrix);  // rows

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

// The cubic lattice of "points", "a", "k1", "k2", "k3", "m", "variant" and "beta" = c / k, where
// given, with its lowest corner at the origin and without contact between the points.
PhysicalModel lattice_model(const Json& params);

// Moves the model so that its centre of mass is at the origin.
void centre(PhysicalModel& model);

// Every edge breaks on this difference in length, longer or shorter (m).
void break_either_way(PhysicalModel& model, double threshold);

}  // namespace limber::reference

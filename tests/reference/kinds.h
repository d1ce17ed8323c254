#pragma once

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace limber::reference {

using Json = nlohmann::json;

// What a kind sees of a case: neither its id nor what it expects. A kind builds models, steps them
// or asks core/analysis about them, and reads numbers off; it holds no closed form of an answer.
// Quotients that only define a quantity (a share, a ratio to the continuum) are not answers.
struct Case {
  Json params;
  Json inputs;  // name -> value of what is marked as input (sample times and the like); "rows": the
                // columns nx, ny, nz of a table of sizes
};

// Computes the quantities of a case; throws std::exception when it cannot be run.
using Kind = std::function<Json(const Case&)>;

// By name: the second field of a case's id, which alone decides how a case is run.
using Kinds = std::map<std::string, Kind>;

// One function a file, kinds_*.cpp. A new file's function goes here and into all_kinds().
Kinds oscillator_kinds();       // group 1: two points on one spring
Kinds chain_kinds();            // group 1: chains and strings that vibrate
Kinds rope_kinds();             // group 2: hanging chains, catenaries, pendulums
Kinds elasticity_kinds();       // group 3: elastic constants, prisms, modes of a bar
Kinds statics_kinds();          // group 3: lattices at rest under a load
Kinds stability_kinds();        // group 4: highest frequencies, limits of the step
Kinds rotation_kinds();         // group 5: inertia, free rotation
Kinds flow_kinds();             // group 6: flow fields alone
Kinds wind_kinds();             // group 6: what the air does to faces
Kinds impact_kinds();           // group 7: impact and breaking
Kinds wall_impact_kinds();      // group 7: chains that fly into a wall
Kinds point_collision_kinds();  // group 8: two points
Kinds chain_collision_kinds();  // group 8: a chain and a free mass
Kinds box_collision_kinds();    // group 8: a lattice and a free box
Kinds switching_kinds();        // group 9: between lattice and rigid body
Kinds topology_kinds();         // group 10: what breaking leaves
Kinds gluing_kinds();           // group 11: pairs of points
Kinds friction_kinds();         // group 12: blocks on the ground
Kinds drop_kinds();             // group 12: a point and a soft ground
Kinds isolated_kinds();         // group 12: lattices and boxes in Bullet's world
Kinds equipartition_kinds();    // group 12: energies of a vibrating lattice

// All of them.
const Kinds& all_kinds();

}  // namespace limber::reference

#pragma once

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace limber::reference {

// One case as the file gives it: parameters, and those "expected" entries that are marked as input
// (sample times and the like). Expected results are not in here: nobody can peek.
struct Case {
  std::string id;
  nlohmann::json params;
  nlohmann::json inputs;  // name -> value; "rows": the columns nx, ny, nz of a table of sizes
};

// Computes the quantities of a case through the library's public interface; throws
// std::exception when the case cannot be run.
using Kind = std::function<nlohmann::json(const Case&)>;

// The kinds of each group by name: the second field of a case's id.
using Kinds = std::map<std::string, Kind>;
Kinds oscillator_kinds();  // group 1
Kinds rope_kinds();        // group 2
Kinds elasticity_kinds();  // group 3
Kinds stability_kinds();   // group 4
Kinds rotation_kinds();    // group 5
Kinds wind_kinds();        // group 6
Kinds impact_kinds();      // group 7
Kinds switching_kinds();   // group 9
Kinds topology_kinds();    // group 10
Kinds gluing_kinds();      // group 11
Kinds friction_kinds();    // group 12

// All of them.
const Kinds& all_kinds();

// The kinds of the reference cases that are not among them, each with the reason.
const std::map<std::string, std::string>& kinds_left_out();

}  // namespace limber::reference

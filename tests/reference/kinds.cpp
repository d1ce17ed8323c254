#include "tests/reference/kinds.h"

namespace limber::reference {

const Kinds& all_kinds() {
  static const Kinds kinds = [] {
    Kinds all;
    for (auto* some : {oscillator_kinds, chain_kinds, rope_kinds, elasticity_kinds, statics_kinds,
                       stability_kinds, rotation_kinds, flow_kinds, wind_kinds, impact_kinds,
                       wall_impact_kinds, switching_kinds, topology_kinds, gluing_kinds,
                       friction_kinds, drop_kinds, equipartition_kinds}) {
      all.merge(some());
    }
    return all;
  }();
  return kinds;
}

const std::map<std::string, std::string>& kinds_left_out() {
  static const std::map<std::string, std::string> kinds = {
      {"point_penalty", "collides with a rigid body: needs a rigid-body engine"},
      {"chain_vs_free_mass", "collides with a rigid body: needs a rigid-body engine"},
      {"energy_bounds", "collides with a rigid body: needs a rigid-body engine"},
      {"lattice_vs_box", "collides with a rigid body: needs a rigid-body engine"},
      {"isolated_system", "has rigid bodies in it: needs a rigid-body engine"},
  };
  return kinds;
}

}  // namespace limber::reference

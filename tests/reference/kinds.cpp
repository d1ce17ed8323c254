#include "tests/reference/kinds.h"

namespace limber::reference {

const Kinds& all_kinds() {
  static const Kinds kinds = [] {
    Kinds all;
    for (auto* some : {oscillator_kinds,
                       chain_kinds,
                       rope_kinds,
                       elasticity_kinds,
                       statics_kinds,
                       stability_kinds,
                       rotation_kinds,
                       flow_kinds,
                       wind_kinds,
                       impact_kinds,
                       wall_impact_kinds,
                       point_collision_kinds,
                       chain_collision_kinds,
                       box_collision_kinds,
                       switching_kinds,
                       topology_kinds,
                       gluing_kinds,
                       friction_kinds,
                       drop_kinds,
                       isolated_kinds,
                       equipartition_kinds}) {
      all.merge(some());
    }
    return all;
  }();
  return kinds;
}

}  // namespace limber::reference

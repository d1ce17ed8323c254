#pragma once

#include "core/model/physical_model.h"
#include "demos/scenes/simulation.h"

namespace limber::demos {

enum class ModelLook {
  kSkin,     // what is seen of it: its skins, or its faces where it has none, its ropes and grains
  kLattice,  // the faces of its cells with their sides drawn on them, its ropes and grains
};

// One model alone, as it is, for pov_scene(): it stands on the floor in the middle of the picture,
// scaled to a longest extent of 1 m, seen from the front, a little from the right and above. Throws
// InputError for a model of which nothing is seen.
Snapshot model_snapshot(const PhysicalModel& model, ModelLook look);

}  // namespace limber::demos

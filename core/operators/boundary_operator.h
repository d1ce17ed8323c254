#pragma once

#include "core/model/surface_model.h"

namespace limber {

// The boundary operator (paper, section 5.4): the faces of valid cells that no valid cell reverses,
// and the faces that belong to no cell and have not lost an edge. The result is closed and consistently oriented
// for 3-D objects, whatever broke.
SurfaceModel boundary(const PhysicalModel& model);

}  // namespace limber

#pragma once

#include <cstdint>
#include <span>

#include "core/model/surface_model.h"
#include "core/operators/breaking_operator.h"

namespace limber {

// The boundary operator (paper, section 5.4): the faces of valid cells that no valid cell reverses,
// and the faces that belong to no cell and have not lost an edge. The result is closed and
// consistently oriented for 3-D objects, whatever broke.
SurfaceModel boundary(const PhysicalModel& model);

// The same for those who keep breaking_topology(model.geometry), which is most of the work.
SurfaceModel boundary(const PhysicalModel& model, const BreakingTopology& topology);

// The surface made of these faces of the model, ascending. Costs what the surface costs, not the
// model. `face_twin`: face -> its reverse face, as in BreakingTopology.
SurfaceModel surface_of(const PhysicalModel& model, std::span<const FaceId> faces,
                        std::span<const TwinFace> face_twin);

}  // namespace limber

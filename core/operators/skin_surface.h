#pragma once

#include "core/model/surface_model.h"

namespace limber {

// What is seen of the model: its boundary(), in which skins take the place of the faces of the
// cells they cover. Faces that breaking exposed stay. A triangle of a skin is seen as long as its
// owner is valid. Each corner is where its host carries it, by trilinear interpolation between
// today's corners of that cell; if the host broke, or no unbroken edges lead from the owner to it
// any more, then where the owner would carry it. So a skin tears with its lattice, and is closed
// while nothing is broken if it was closed at first.
SurfaceModel skin_surface(const PhysicalModel& model);

// The same for those who have the boundary of the model already.
SurfaceModel skin_surface(const PhysicalModel& model, SurfaceModel boundary);

// Where a cell carries what is at `place` in it, m.
Vec3 carried_place(const PhysicalModel& model, const SkinCell& cell, const Vec3& place);

}  // namespace limber

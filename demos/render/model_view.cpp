#include "demos/render/model_view.h"

#include <algorithm>

#include "core/model/errors.h"
#include "core/operators/boundary_operator.h"
#include "core/operators/skin_surface.h"

namespace limber::demos {
namespace {

// From the middle of the model to the camera, in its longest extents.
const Vec3 kToCamera = {1.0, 0.8, 2.2};
constexpr double kField_deg = 32.0;

// Onto the floor around the y axis; returns how tall it is then, m.
double set_up(SurfaceModel& surface) {
  Vec3 low = surface.points.front(), high = low;
  for (const Vec3& p : surface.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double size = (high - low).maxCoeff();
  const double scale = size > 0.0 ? 1.0 / size : 1.0;
  const Vec3 foot(0.5 * (low.x() + high.x()), low.y(), 0.5 * (low.z() + high.z()));
  for (Vec3& p : surface.points) p = scale * (p - foot);
  return scale * (high.y() - low.y());
}

}  // namespace

Snapshot model_snapshot(const PhysicalModel& model, ModelLook look) {
  const bool lattice = look == ModelLook::kLattice;
  Snapshot::Body body;
  body.name = model.name;
  body.surface = lattice ? boundary(model) : skin_surface(model);
  if (body.surface.triangles.empty())
    throw InputError({model.name, "nothing of it can be seen: no cell or face is whole",
                      "give a model with faces"});
  body.flexible.assign(body.surface.triangles.size(), lattice);
  const Vec3 middle(0.0, 0.5 * set_up(body.surface), 0.0);
  Snapshot snapshot;
  snapshot.camera = {middle + kToCamera, middle, kField_deg};
  snapshot.bodies.push_back(std::move(body));
  return snapshot;
}

}  // namespace limber::demos

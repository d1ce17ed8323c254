#include "demos/render/model_view.h"

#include "core/model/bounds.h"
#include "core/model/errors.h"
#include "core/operators/boundary_operator.h"
#include "core/operators/skin_surface.h"
#include "core/operators/strands.h"

namespace limber::demos {
namespace {

// From the middle of the model to the camera, in its longest extents.
const Vec3 kToCamera = {1.0, 0.8, 2.2};
constexpr double kField_deg = 32.0;

void add_strands(const PhysicalModel& model, bool flexible, Snapshot::Body& body) {
  for (const Strand& s : strands(model)) {
    body.strands.push_back({model.geometry.points[s.a], model.geometry.points[s.b], s.radius,
                            model.parts[s.subobject].surface, flexible});
  }
}

Box3 box_of(const Snapshot::Body& body) {
  Box3 box;
  for (const SurfaceTriangle& triangle : body.surface.triangles)
    for (std::int32_t corner : triangle.corners) box.extend(body.surface.points[corner]);
  for (const Snapshot::RopeLength& s : body.strands) {
    const Vec3 around = Vec3::Constant(s.radius);
    for (const Vec3& end : {s.a, s.b}) box.extend(Box3(end - around, end + around));
  }
  return box;
}

// Onto the floor around the y axis, a metre large; returns how tall it is then, m.
double set_up(Snapshot::Body& body) {
  const Box3 box = box_of(body);
  const double size = box.sizes().maxCoeff();
  const double scale = size > 0.0 ? 1.0 / size : 1.0;
  const Vec3 foot(box.center().x(), box.min().y(), box.center().z());
  for (Vec3& p : body.surface.points) p = scale * (p - foot);
  for (Snapshot::RopeLength& s : body.strands) {
    s.a = scale * (s.a - foot);
    s.b = scale * (s.b - foot);
    s.radius *= scale;
  }
  return scale * box.sizes().y();
}

}  // namespace

Snapshot model_snapshot(const PhysicalModel& model, ModelLook look) {
  const bool lattice = look == ModelLook::kLattice;
  Snapshot::Body body;
  body.name = model.name;
  body.surface = lattice ? boundary(model) : skin_surface(model);
  add_strands(model, lattice, body);
  if (body.surface.triangles.empty() && body.strands.empty())
    throw InputError(
        {model.name,
         "nothing of it can be seen: no cell or face is whole, and no rope or grain has "
         "a strand radius",
         "give a model with faces, or parts with surface.strand_radius"});
  body.flexible.assign(body.surface.triangles.size(), lattice);
  const Vec3 middle(0.0, 0.5 * set_up(body), 0.0);
  Snapshot snapshot;
  snapshot.camera = {middle + kToCamera, middle, kField_deg};
  snapshot.bodies.push_back(std::move(body));
  return snapshot;
}

}  // namespace limber::demos

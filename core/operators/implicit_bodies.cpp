#include "core/operators/implicit_bodies.h"

namespace limber {

void ImplicitBodies::set(std::size_t object, bool implicit) {
  if (object >= implicit_.size()) implicit_.resize(object + 1, false);
  implicit_[object] = implicit;
  any_ = any_ || implicit;
  stale_ = true;
}

void ImplicitBodies::rebuild(const Lattice& lattice) {
  stale_ = false;
  bodies_.resize(lattice.objects.size());
  for (Body& body : bodies_) {
    body.points.clear();
    body.method.topology_changed();
  }
  explicit_points_.clear();
  for (std::int32_t p : lattice.dynamic_points) {
    const auto object = static_cast<std::size_t>(lattice.point_object[p]);
    (contains(object) ? bodies_[object].points : explicit_points_).push_back(p);
  }
}

std::span<const std::int32_t> ImplicitBodies::explicit_points(const Lattice& lattice) {
  if (!any_) return lattice.dynamic_points;
  if (stale_) rebuild(lattice);
  return explicit_points_;
}

void ImplicitBodies::step(Lattice& lattice, double dt) {
  if (!any_) return;
  if (stale_) rebuild(lattice);
  for (Body& body : bodies_) {
    if (!body.points.empty()) body.method.step(lattice, body.points, dt);
  }
}

}  // namespace limber

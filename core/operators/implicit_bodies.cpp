#include "core/operators/implicit_bodies.h"

#include <algorithm>

namespace limber {
namespace {

// Of the points from the first to the last.
std::span<const PointSupport> supports_of(std::span<const PointSupport> supports,
                                          std::span<const std::int32_t> points) {
  const auto from = std::ranges::lower_bound(supports, points.front(), {}, &PointSupport::point);
  const auto to = std::ranges::upper_bound(supports, points.back(), {}, &PointSupport::point);
  return {from, to};
}

}  // namespace

void ImplicitBodies::add(std::size_t object) {
  if (object >= implicit_.size()) implicit_.resize(object + 1, false);
  implicit_[object] = true;
  any_ = stale_ = true;
}

void ImplicitBodies::edges_broken(const Lattice& lattice, std::span<const std::int32_t> edges) {
  if (!any_ || stale_) return;
  for (std::int32_t e : edges) {
    bodies_[lattice.point_object[lattice.springs[e].a]].method.topology_changed();
  }
}

// The points of an object follow each other.
void ImplicitBodies::refresh(const Lattice& lattice) {
  if (!stale_) return;
  stale_ = false;
  implicit_points_.clear();
  explicit_points_.clear();
  bodies_.resize(lattice.objects.size());
  for (Body& body : bodies_) {
    body.count = 0;
    body.method.topology_changed();
  }
  for (std::int32_t p : lattice.dynamic_points) {
    const auto object = static_cast<std::size_t>(lattice.point_object[p]);
    if (!contains(object)) {
      explicit_points_.push_back(p);
      continue;
    }
    if (bodies_[object].count++ == 0) bodies_[object].first = implicit_points_.size();
    implicit_points_.push_back(p);
  }
}

std::span<const std::int32_t> ImplicitBodies::implicit_points(const Lattice& lattice) {
  if (!any_) return {};
  refresh(lattice);
  return implicit_points_;
}

std::span<const std::int32_t> ImplicitBodies::explicit_points(const Lattice& lattice) {
  if (!any_) return lattice.dynamic_points;
  refresh(lattice);
  return explicit_points_;
}

void ImplicitBodies::step(Lattice& lattice, double dt, std::span<const PointSupport> supports) {
  if (!any_) return;
  refresh(lattice);
  for (Body& body : bodies_) {
    if (body.count == 0) continue;
    const auto points = std::span(implicit_points_).subspan(body.first, body.count);
    body.method.step(lattice, points, dt, supports_of(supports, points));
  }
}

}  // namespace limber

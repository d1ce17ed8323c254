#include "core/modeller/ring_shell.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/model/errors.h"
#include "core/modeller/arc_length.h"
#include "core/modeller/prismatic_cell.h"

namespace limber {
namespace {

constexpr int kSamplesAround = 256;  // of a ring, for arc lengths
constexpr int kSamplesAlong = 512;   // of the range of v
constexpr int kMeridians = 32;       // over which arc lengths along v are averaged

// Rows of equilateral triangles are this part of their sides apart.
constexpr double kRowHeight = std::numbers::sqrt3 / 2.0;

// An end ring of a smaller radius becomes a pole, as part of the spacing.
constexpr double kPoleRadius = 0.6;

// Neighbours on an inner ring stay this part of the spacing apart: shorter edges would set the
// highest frequency of the whole lattice.
constexpr double kLeastInnerSpacing = 0.5;

// Along v, averaged over the meridians.
ArcLength length_along(const RingSurface& surface, double v_begin, double v_end) {
  const std::vector<double> v = evenly(v_begin, v_end, kSamplesAlong);
  ArcLength arc(v);
  for (std::size_t i = 1; i < v.size(); ++i) {
    double sum = 0.0;
    for (int m = 0; m < kMeridians; ++m) {
      const double u = double(m) / kMeridians;
      sum += (surface.position(u, v[i]) - surface.position(u, v[i - 1])).norm();
    }
    arc.append(sum / kMeridians);
  }
  return arc;
}

// Around the ring at v, `depth` below the surface.
ArcLength length_around(const RingSurface& surface, double v, double depth) {
  const auto point = [&](double u) -> Vec3 {
    return surface.position(u, v) - depth * surface.normal(u, v);
  };
  const std::vector<double> u = evenly(0.0, 1.0, kSamplesAround);
  ArcLength arc(u);
  const Vec3 first = point(0.0);
  Vec3 previous = first;
  for (int i = 1; i <= kSamplesAround; ++i) {
    const Vec3 next = i == kSamplesAround ? first : point(u[i]);
    arc.append((next - previous).norm());
    previous = next;
  }
  return arc;
}

// Outer and inner points of one ring; a pole has one of each.
struct Ring {
  std::vector<PointId> outer, inner;
  std::vector<Vec3> position, normal;  // of the outer points

  std::size_t size() const { return outer.size(); }
};

void add_ring_point(GeometricModelBuilder& builder, Ring& ring, const Vec3& position,
                    const Vec3& normal, double thickness) {
  ring.outer.push_back(builder.add_point(position));
  ring.inner.push_back(builder.add_point(position - thickness * normal));
  ring.position.push_back(position);
  ring.normal.push_back(normal);
}

// The mean over the ring: exactly on the axis of a surface of revolution.
Ring add_pole(GeometricModelBuilder& builder, const RingSurface& surface, double v,
              double thickness) {
  Vec3 position = Vec3::Zero();
  Vec3 normal = Vec3::Zero();
  for (int i = 0; i < kSamplesAround; ++i) {
    const double u = double(i) / kSamplesAround;
    position += surface.position(u, v) / kSamplesAround;
    normal += surface.normal(u, v);
  }
  Ring ring;
  add_ring_point(builder, ring, position, normal.normalized(), thickness);
  return ring;
}

int points_around(double outer_length, double inner_length, double spacing) {
  const int wanted = static_cast<int>(std::lround(outer_length / spacing));
  const int most = static_cast<int>(inner_length / (kLeastInnerSpacing * spacing));
  return std::max(3, std::min(wanted, most));
}

// `shift` in steps between points: neighbouring rings are offset by half a step.
Ring add_ring(GeometricModelBuilder& builder, const RingSurface& surface, double v, double shift,
              const RingShellOptions& options) {
  const ArcLength arc = length_around(surface, v, 0.0);
  const double inner_length = length_around(surface, v, options.wall_thickness).total();
  const int n = points_around(arc.total(), inner_length, options.spacing);
  Ring ring;
  for (int i = 0; i < n; ++i) {
    const double u = arc.parameter_at(arc.total() * (i + shift) / n);
    add_ring_point(builder, ring, surface.position(u, v), surface.normal(u, v),
                   options.wall_thickness);
  }
  return ring;
}

std::vector<Ring> add_rings(GeometricModelBuilder& builder, const RingSurface& surface,
                            const RingShellOptions& options) {
  const ArcLength along = length_along(surface, options.v_begin, options.v_end);
  const int rows = std::max(1, int(std::lround(along.total() / (kRowHeight * options.spacing))));
  std::vector<Ring> rings;
  for (int row = 0; row <= rows; ++row) {
    const double v = along.parameter_at(along.total() * row / rows);
    const double radius = length_around(surface, v, 0.0).total() / (2.0 * std::numbers::pi);
    const bool at_end = row == 0 || row == rows;
    if (at_end && radius < kPoleRadius * options.spacing) {
      rings.push_back(add_pole(builder, surface, v, options.wall_thickness));
    } else {
      rings.push_back(add_ring(builder, surface, v, row % 2 == 0 ? 0.0 : 0.5, options));
    }
  }
  return rings;
}

// A corner of a triangle: a place on one of two neighbouring rings.
struct Corner {
  const Ring* ring;
  std::size_t place;

  const Vec3& position() const { return ring->position[place]; }
  const Vec3& normal() const { return ring->normal[place]; }
  PointId outer() const { return ring->outer[place]; }
  PointId inner() const { return ring->inner[place]; }
};

using CornerTriangle = std::array<Corner, 3>;

std::size_t nearest_place(const Ring& ring, const Vec3& position) {
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < ring.size(); ++i) {
    if ((ring.position[i] - position).norm() < (ring.position[nearest] - position).norm()) {
      nearest = i;
    }
  }
  return nearest;
}

// Walks around both rings at once and always steps along the one that gives the shorter diagonal.
// Both are walked in the direction of u; a pole has no steps.
std::vector<CornerTriangle> zip(const Ring& a, const Ring& b) {
  const std::size_t steps_a = a.size() > 1 ? a.size() : 0;
  const std::size_t steps_b = b.size() > 1 ? b.size() : 0;
  const std::size_t start_b = nearest_place(b, a.position[0]);
  const auto on_a = [&](std::size_t i) { return Corner{&a, i % a.size()}; };
  const auto on_b = [&](std::size_t j) { return Corner{&b, (start_b + j) % b.size()}; };
  std::vector<CornerTriangle> triangles;
  std::size_t i = 0, j = 0;
  while (i < steps_a || j < steps_b) {
    const double along_a = (on_a(i + 1).position() - on_b(j).position()).norm();
    const double along_b = (on_a(i).position() - on_b(j + 1).position()).norm();
    const bool step_a = j == steps_b || (i < steps_a && along_a <= along_b);
    const Corner apex = step_a ? on_a(i + 1) : on_b(j + 1);
    triangles.push_back({on_a(i), on_b(j), apex});
    (step_a ? i : j) += 1;
  }
  return triangles;
}

std::vector<CornerTriangle> zip_all(const std::vector<Ring>& rings) {
  std::vector<CornerTriangle> triangles;
  for (std::size_t r = 0; r + 1 < rings.size(); ++r) {
    const std::vector<CornerTriangle> band = zip(rings[r], rings[r + 1]);
    triangles.insert(triangles.end(), band.begin(), band.end());
  }
  return triangles;
}

// All triangles run the same way; whether that is outward depends on the surface's parameters.
void orient_outward(std::vector<CornerTriangle>& triangles) {
  double outward = 0.0;
  for (const auto& [a, b, c] : triangles) {
    const Vec3 area = (b.position() - a.position()).cross(c.position() - a.position());
    outward += area.dot(a.normal() + b.normal() + c.normal());
  }
  if (outward > 0.0) return;
  for (CornerTriangle& t : triangles) std::swap(t[1], t[2]);
}

void check(const RingShellOptions& options) {
  const auto positive = [](double x) { return x > 0.0 && std::isfinite(x); };
  if (!positive(options.spacing)) {
    throw InputError({"ring shell", "spacing is " + std::to_string(options.spacing) + " m",
                      "give a positive spacing"});
  }
  if (!positive(options.wall_thickness)) {
    throw InputError({"ring shell",
                      "wall thickness is " + std::to_string(options.wall_thickness) + " m",
                      "give a positive thickness"});
  }
  if (!(options.v_begin < options.v_end)) {
    throw InputError({"ring shell", "the range of v is empty", "give v_begin < v_end"});
  }
}

}  // namespace

void add_ring_shell(GeometricModelBuilder& builder, const RingSurface& surface,
                    const RingShellOptions& options) {
  check(options);
  const std::vector<Ring> rings = add_rings(builder, surface, options);  // triangles point into it
  std::vector<CornerTriangle> triangles = zip_all(rings);
  orient_outward(triangles);
  for (const auto& [a, b, c] : triangles) {
    add_prism(builder, {a.outer(), b.outer(), c.outer()}, {a.inner(), b.inner(), c.inner()});
  }
}

}  // namespace limber

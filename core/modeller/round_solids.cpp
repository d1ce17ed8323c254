#include "core/modeller/round_solids.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/model/diagnostic_list.h"
#include "core/model/errors.h"
#include "core/modeller/arc_length.h"
#include "core/modeller/o_grid.h"
#include "core/modeller/shape_checks.h"

namespace limber {
namespace {

// In a standard form cells are between 0.8 / n wide, in the middle of n cells and half width 0.4,
// and pi/2 / n on the surface; the layers are 0.5 thick: n : layers = 1.2 : 0.5.
constexpr double kLayersPerCellAcross = 0.5 / (1.2 + 2.0 * 0.5);

constexpr double kPi = std::numbers::pi;

// As many layers on either side of the middle as make cells about as thick as wide.
OGrid grid_across(int cells_across) {
  const int layers =
      std::max(1, static_cast<int>(std::lround(kLayersPerCellAcross * cells_across)));
  return {cells_across - 2 * layers, 1, layers, false, false};
}

// Rows of cells of about this height, at least one.
int rows_of(double length, double height) {
  return std::max(1, static_cast<int>(std::lround(std::min(length / height, kMostShapePoints))));
}

void require_usable(int cells_across, int cells_along, const std::string& name) {
  require_at_least(name, "cells across", cells_across, 4);
  require_at_least(name, "cells along", cells_along, 0);
}

GeometricModel built(const OGrid& grid, const std::function<Vec3(const OGridPlace&)>& position,
                     const CellEdges& edges, const std::string& name) {
  require_affordable(name, point_count(grid), "give fewer cells");
  GeometricModelBuilder builder;
  builder.begin_subobject(name);
  add_o_grid(builder, grid, position, edges);
  return builder.finish();
}

// The profile of a solid of revolution by its length, from the lower end to the upper one.
class Meridian {
 public:
  Meridian(const SolidOfRevolution& solid, const std::string& name)
      : radius_(solid.radius), arc_(sample_places(solid)) {
    const std::vector<double> y = sample_places(solid);
    std::vector<double> r;
    for (double at : y) r.push_back(checked_radius(at, r.empty() || at == y.back(), name));
    for (std::size_t i = 1; i < y.size(); ++i)
      arc_.append(std::hypot(y[i] - y[i - 1], r[i] - r[i - 1]));
    widest_ = *std::max_element(r.begin(), r.end());
    require_positive(name, "largest radius", widest_, "m");
    low_closed_ = r.front() <= kClosed * widest_;
    high_closed_ = r.back() <= kClosed * widest_;
  }

  double length() const { return arc_.total(); }
  double widest() const { return widest_; }
  bool low_closed() const { return low_closed_; }
  bool high_closed() const { return high_closed_; }
  double height_at(double length) const { return arc_.parameter_at(length); }
  double radius(double y) const { return std::max(0.0, radius_(y)); }

  // The radius a length away from an end.
  double radius_near(bool high_end, double length) const {
    return radius(height_at(high_end ? arc_.total() - length : length));
  }

 private:
  static constexpr double kClosed = 1e-6;  // of the widest, radius of an end that counts as 0
  static constexpr int kSamples = 8192;

  // Close together at the ends, where a round profile is steep.
  static std::vector<double> sample_places(const SolidOfRevolution& solid) {
    std::vector<double> y = evenly(0.0, kPi, kSamples);
    for (double& a : y) a = std::lerp(solid.y_low, solid.y_high, 0.5 - 0.5 * std::cos(a));
    y.back() = solid.y_high;
    return y;
  }

  // Rounding may make that of an end a little negative.
  double checked_radius(double y, bool at_end, const std::string& name) const {
    const double r = radius_(y);
    if (std::isfinite(r) && (at_end || r > 0.0)) return std::max(r, 0.0);
    throw InputError({name, say("its radius at y = ", y, " m is ", r, " m"),
                      "give a finite radius, above 0 between the ends"});
  }

  std::function<double(double)> radius_;
  ArcLength arc_;  // y -> length
  double widest_ = 0.0;
  bool low_closed_ = false, high_closed_ = false;
};

// A solid of revolution is modelled as a capsule (cylinder between half balls), cut flat where an
// end is not closed: these are the shares of its parts in the profile and in the rows of cells.
struct Capsule {
  double low_cap = 0.0, high_cap = 0.0;           // m along the profile; 0: flat
  int low_rows = 0, straight = 0, high_rows = 0;  // rows of the middle's cells

  int rows() const { return low_rows + straight + high_rows; }
};

// The length from a closed end that becomes half a ball. On a ball, half of it leads to where it is
// pi/4 / sin(pi/4) of the radius; a tip is followed at least to half of the largest radius.
double cap_length(const Meridian& meridian, bool high_end) {
  constexpr int kSlices = 1024;
  const bool both = meridian.low_closed() && meridian.high_closed();
  const double most = meridian.length() / (both ? 2.0 : 1.0);
  for (int i = 1; i < kSlices; ++i) {
    const double half = 0.5 * most * i / kSlices;
    const double r = meridian.radius_near(high_end, half);
    if (half >= kPi / 4.0 * std::numbers::sqrt2 * r && r >= 0.5 * meridian.widest()) {
      return 2.0 * half;
    }
  }
  return most;
}

// Caps that leave less than half a row between them meet.
void let_caps_meet(Capsule& capsule, double length) {
  const double scale = length / (capsule.low_cap + capsule.high_cap);
  capsule.low_cap *= scale;
  capsule.high_cap *= scale;
}

Capsule capsule_for(const Meridian& meridian, const OGrid& grid, const SolidOfRevolution& solid) {
  Capsule capsule;
  const int half_rows = (grid.across + 1) / 2;
  if (meridian.low_closed()) capsule.low_cap = cap_length(meridian, false);
  if (meridian.high_closed()) capsule.high_cap = cap_length(meridian, true);
  if (meridian.low_closed()) capsule.low_rows = half_rows;
  if (meridian.high_closed()) capsule.high_rows = half_rows;
  const double straight = meridian.length() - capsule.low_cap - capsule.high_cap;
  const double width = 2.0 * meridian.widest() / solid.cells_across;
  const bool no_caps = capsule.rows() == 0;
  capsule.straight = solid.cells_along > 0                ? solid.cells_along
                     : straight < 0.5 * width && !no_caps ? 0
                                                          : rows_of(straight, width);
  if (capsule.straight == 0) let_caps_meet(capsule, meridian.length());
  return capsule;
}

// Where a place goes: as far out, in proportion, at its length of the profile as it is in the
// capsule.
Vec3 revolved(const Meridian& meridian, const Capsule& capsule, OGridPlace at) {
  const double row = 0.5 * (at.middle.y() + 1.0) * capsule.rows();
  const double above = row - capsule.low_rows - capsule.straight;
  const double below = capsule.low_rows - row;
  // The height in the half ball, -1 to 1; 0 in the cylinder.
  at.middle.y() = below > 0.0   ? -below / capsule.low_rows
                  : above > 0.0 ? above / capsule.high_rows
                                : 0.0;
  const Vec3 ball = in_ball(at);
  const double from_pole = std::acos(std::min(1.0, std::abs(ball.y()))) / (kPi / 2.0);
  const double straight = meridian.length() - capsule.low_cap - capsule.high_cap;
  const double length = below > 0.0   ? capsule.low_cap * from_pole
                        : above > 0.0 ? meridian.length() - capsule.high_cap * from_pole
                        : capsule.straight > 0
                            ? capsule.low_cap - straight * below / capsule.straight
                            : capsule.low_cap;
  const double y = meridian.height_at(length);
  const double width = std::sqrt(std::max(0.0, 1.0 - ball.y() * ball.y()));
  const double scale = width > 0.0 ? meridian.radius(y) / width : 0.0;
  return {scale * ball.x(), y, scale * ball.z()};
}

void require_usable(const SolidOfRevolution& solid, const std::string& name) {
  require_usable(solid.cells_across, solid.cells_along, name);
  require_finite(name, "the origin", solid.origin);
  require_positive(name, "height (y_high - y_low)", solid.y_high - solid.y_low, "m");
  if (!solid.radius) throw InputError({name, "it has no profile", "give a function radius(y)"});
}

}  // namespace

GeometricModel solid_sphere(const SolidSphere& sphere, const std::string& name) {
  require_usable(sphere.cells_across, 0, name);
  require_finite(name, "the centre", sphere.centre);
  require_positive(name, "radius", sphere.radius, "m");
  OGrid grid = grid_across(sphere.cells_across);
  grid.along = grid.across;
  grid.low_cap = grid.high_cap = true;
  const auto position = [&](const OGridPlace& at) -> Vec3 {
    return sphere.centre + sphere.radius * in_ball(at);
  };
  return built(grid, position, sphere.edges, name);
}

GeometricModel solid_cylinder(const SolidCylinder& cylinder, const std::string& name) {
  require_usable(cylinder.cells_across, cylinder.cells_along, name);
  require_finite(name, "the base", cylinder.base);
  require_positive(name, "radius", cylinder.radius, "m");
  require_positive(name, "height", cylinder.height, "m");
  OGrid grid = grid_across(cylinder.cells_across);
  const double width = 2.0 * cylinder.radius / cylinder.cells_across;
  grid.along = cylinder.cells_along > 0 ? cylinder.cells_along : rows_of(cylinder.height, width);
  const Vec3 half(cylinder.radius, 0.5 * cylinder.height, cylinder.radius);
  const auto position = [&](const OGridPlace& at) -> Vec3 {
    return cylinder.base + (in_cylinder(at) + Vec3::UnitY()).cwiseProduct(half);
  };
  return built(grid, position, cylinder.edges, name);
}

GeometricModel solid_of_revolution(const SolidOfRevolution& solid, const std::string& name) {
  require_usable(solid, name);
  const Meridian meridian(solid, name);
  OGrid grid = grid_across(solid.cells_across);
  const Capsule capsule = capsule_for(meridian, grid, solid);
  grid.along = capsule.rows();
  grid.low_cap = meridian.low_closed();
  grid.high_cap = meridian.high_closed();
  const auto position = [&](const OGridPlace& at) -> Vec3 {
    return solid.origin + revolved(meridian, capsule, at);
  };
  return built(grid, position, solid.edges, name);
}

}  // namespace limber

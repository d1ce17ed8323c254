#include "demos/scenes/teapot_model.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>

#include "core/modeller/bezier_patch.h"
#include "core/modeller/flaws.h"
#include "core/modeller/material.h"
#include "core/modeller/ring_shell.h"
#include "core/operators/gluing_operator.h"
#include "teapot_patches.h"

namespace limber::demos {
namespace {

// Newell's teapot is 6.43 units from handle to spout.
constexpr double kMetresPerUnit = 0.25 / 6.43;

// Stoneware; its strain at break comes to 0.03 once softened by 2000.
constexpr double kModulus = 6e10;  // Pa
constexpr double kStrainAtBreak = 6.708203932499369e-4;
constexpr double kDampingRatio = 0.2;
constexpr double kInternalDamping = 30.0;  // 1/s
constexpr double kFriction = 0.5;

// Newell's surfaces have no thickness. His lid's knob, spout and handle are about 10 mm across at
// this size, too narrow for two walls: the wall of these parts grows outward as well, by this part
// of its thickness.
constexpr double kLidOutward = 0.4;
constexpr double kSpoutOutward = 0.4;
constexpr double kHandleOutward = 0.6;

// The used part of v. Rim and lid fold back at their edges within less than a wall thickness, the
// spout folds into itself beyond its tip.
constexpr double kBodyBegin = 0.2;
constexpr double kLidEnd = 0.94;
constexpr double kSpoutEnd = 0.5;

// Parts are glued across a gap, both in spacings: nearly every point at the end of a part finds
// one to six points of the body within the distance, three on average, and hardly one of the second
// row does.
constexpr double kGap = 0.7;
constexpr double kGlueDistance = 1.1;

// Brittle: 15 % scatter and 30 seams at 0.3 of the strength.
constexpr double kScatter = 0.15;
constexpr int kSeams = 30;
constexpr double kSeamStrength = 0.3;

Material stoneware(const TeapotOptions& options) {
  Material m;
  m.density = options.density;
  m.youngs_modulus = kModulus;
  m.strain_at_break = kStrainAtBreak;
  m.damping_ratio = kDampingRatio;
  m.internal_damping = kInternalDamping;
  m.friction = kFriction;
  m.softening = options.softening;
  return m;
}

// Rows of patches; each row closes around the part.
using PatchGrid = std::vector<std::vector<BezierPatch>>;

std::vector<BezierPatch> patches_of(const std::string& part) {
  static const std::vector<PatchPart> parts =
      parse_bezier_patches(assets::kTeapotPatches, "teapot_patches.txt");
  const auto found =
      std::find_if(parts.begin(), parts.end(), [&](const auto& p) { return p.name == part; });
  assert(found != parts.end());
  std::vector<BezierPatch> patches = found->patches;
  for (BezierPatch& patch : patches) {
    for (Vec3& control : patch.control) control *= kMetresPerUnit;
  }
  return patches;
}

PatchGrid grid_of(const std::string& part, std::size_t columns) {
  const std::vector<BezierPatch> patches = patches_of(part);
  PatchGrid grid;
  for (std::size_t i = 0; i < patches.size(); i += columns) {
    grid.emplace_back(patches.begin() + i, patches.begin() + i + columns);
  }
  return grid;
}

// The same surface with both parameters running backwards.
PatchGrid turned(PatchGrid grid) {
  std::reverse(grid.begin(), grid.end());
  for (auto& row : grid) {
    std::reverse(row.begin(), row.end());
    for (BezierPatch& patch : row) std::reverse(patch.control.begin(), patch.control.end());
  }
  return grid;
}

// One surface of revolution from the rim to the centre of the bottom, which is stored from its
// centre outward.
PatchGrid body_grid() {
  PatchGrid grid = grid_of("rim", 4);
  for (const PatchGrid& more : {grid_of("body", 4), turned(grid_of("bottom", 4))}) {
    grid.insert(grid.end(), more.begin(), more.end());
  }
  return grid;
}

// Calls a member of the patch under (u, v) with the parameters within that patch.
template <class Member>
Vec3 on_grid(const PatchGrid& grid, double u, double v, Member member) {
  const auto split = [](double t, std::size_t n) {
    const double scaled = std::clamp(t, 0.0, 1.0) * static_cast<double>(n);
    const std::size_t i = std::min(static_cast<std::size_t>(scaled), n - 1);
    return std::pair{i, scaled - static_cast<double>(i)};
  };
  const auto [row, patch_v] = split(v, grid.size());
  const auto [column, patch_u] = split(u, grid[row].size());
  return (grid[row][column].*member)(patch_u, patch_v);
}

// Where on each meridian u a part ends.
using End = std::function<double(double u)>;

End everywhere(double v) {
  return [v](double) { return v; };
}

// A part's surface between two ends, moved outward.
RingSurface trimmed(const PatchGrid& grid, const End& v_first, const End& v_last,
                    double outward_m) {
  const auto v_on_grid = [=](double u, double v) { return std::lerp(v_first(u), v_last(u), v); };
  const auto normal = [=](double u, double v) {
    return on_grid(grid, u, v_on_grid(u, v), &BezierPatch::normal);
  };
  const auto position = [=](double u, double v) -> Vec3 {
    return on_grid(grid, u, v_on_grid(u, v), &BezierPatch::position) + outward_m * normal(u, v);
  };
  return {position, normal};
}

// Distance from a surface of revolution around the y axis, by its meridian; negative inside.
class Revolution {
 public:
  Revolution(const PatchGrid& grid, double v_begin) {
    constexpr int kSamples = 400;
    for (int i = 0; i <= kSamples; ++i) {
      const double v = std::lerp(v_begin, 1.0, double(i) / kSamples);
      meridian_.push_back(in_half_plane(on_grid(grid, 0.0, v, &BezierPatch::position)));
    }
  }

  double distance(const Vec3& point) const {
    const Eigen::Vector2d p = in_half_plane(point);
    double nearest = std::numeric_limits<double>::infinity();
    bool inside = false;
    for (std::size_t i = 1; i < meridian_.size(); ++i) {
      const Eigen::Vector2d& a = meridian_[i - 1];
      const Eigen::Vector2d& b = meridian_[i];
      nearest = std::min(nearest, distance_to_segment(p, a, b));
      if ((a.y() > p.y()) == (b.y() > p.y())) continue;
      const double radius = std::lerp(a.x(), b.x(), (p.y() - a.y()) / (b.y() - a.y()));
      if (radius > p.x()) inside = !inside;
    }
    return inside ? -nearest : nearest;
  }

 private:
  static Eigen::Vector2d in_half_plane(const Vec3& p) { return {std::hypot(p.x(), p.z()), p.y()}; }

  static double distance_to_segment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                                    const Eigen::Vector2d& b) {
    const Eigen::Vector2d along = b - a;
    const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (p - a - t * along).norm();
  }

  std::vector<Eigen::Vector2d> meridian_;  // (radius, height), m
};

// The first value for which `outside` holds between one for which it does not and one for which it
// does.
template <class Condition>
double bisect(double inside, double outside, Condition is_outside) {
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (inside + outside);
    (is_outside(middle) ? outside : inside) = middle;
  }
  return outside;
}

// The end of a part that grows out of the body, between v_inside and v_outside: on every meridian
// as far from the body as the gap, so that the end follows the body's curvature. Tabulated, since
// it is asked for at every evaluation of the surface.
End end_at_body(const PatchGrid& grid, double outward_m, const Revolution& body, double gap_m,
                double v_inside, double v_outside) {
  constexpr int kSamples = 64;
  const RingSurface whole = trimmed(grid, everywhere(0.0), everywhere(1.0), outward_m);
  std::vector<double> table;
  for (int i = 0; i < kSamples; ++i) {
    const double u = double(i) / kSamples;
    table.push_back(bisect(v_inside, v_outside,
                           [&](double v) { return body.distance(whole.position(u, v)) >= gap_m; }));
  }
  return [table](double u) {
    const double place = (u - std::floor(u)) * kSamples;
    const int i = static_cast<int>(place) % kSamples;
    return std::lerp(table[i], table[(i + 1) % kSamples], place - std::floor(place));
  };
}

PhysicalModel part(const std::string& name, const RingSurface& surface, const Vec3& colour,
                   const TeapotOptions& options) {
  GeometricModelBuilder builder;
  builder.begin_subobject(name);
  add_ring_shell(builder, surface, {options.spacing, options.wall_thickness});
  PhysicalModel model = with_material(builder.finish(), name, stoneware(options));
  model.parts[0].surface.colour = colour;
  return model;
}

// Raised until its edge is a gap away from the rim.
PhysicalModel lid_on(const Revolution& body, const TeapotOptions& options) {
  const RingSurface on_table = trimmed(grid_of("lid", 4), everywhere(0.0), everywhere(kLidEnd),
                                       kLidOutward * options.wall_thickness);
  const Vec3 edge = on_table.position(0.0, 1.0);
  constexpr double kMostLift = 0.05;  // m
  const double lift = bisect(0.0, kMostLift, [&](double y) {
    return body.distance(edge + Vec3(0.0, y, 0.0)) >= kGap * options.spacing;
  });
  PhysicalModel lid = part("lid", on_table, {0.45, 0.62, 0.78}, options);
  place(lid, Mat3::Identity(), {0.0, lift, 0.0});
  return lid;
}

PhysicalModel spout_on(const Revolution& body, const TeapotOptions& options) {
  const PatchGrid grid = grid_of("spout", 2);
  const double outward = kSpoutOutward * options.wall_thickness;
  const End root = end_at_body(grid, outward, body, kGap * options.spacing, 0.0, kSpoutEnd);
  return part("spout", trimmed(grid, root, everywhere(kSpoutEnd), outward), {0.68, 0.30, 0.18},
              options);
}

PhysicalModel handle_on(const Revolution& body, const TeapotOptions& options) {
  const PatchGrid grid = grid_of("handle", 2);
  const double outward = kHandleOutward * options.wall_thickness;
  const double gap = kGap * options.spacing;
  const End upper = end_at_body(grid, outward, body, gap, 0.0, 0.5);
  const End lower = end_at_body(grid, outward, body, gap, 1.0, 0.5);
  return part("handle", trimmed(grid, upper, lower, outward), {0.16, 0.27, 0.48}, options);
}

// A bond is a bar of the wall's material: each end point stands for half of the wall times one
// spacing of the joint, shared by about three bonds, so k = E (w s / 2) / (3 s) = E w / 6 at a
// length of one spacing. Lattice edges have about as much.
GlueBond bond_of(const TeapotOptions& options) {
  const Material material = stoneware(options);
  GlueBond bond;
  bond.distance = kGlueDistance * options.spacing;
  bond.stiffness = material.effective_modulus() * options.wall_thickness / 6.0;
  bond.break_strain = material.effective_strain_at_break();
  return bond;
}

}  // namespace

PhysicalModel teapot_model(const TeapotOptions& options) {
  const PatchGrid grid = body_grid();
  const RingSurface surface = trimmed(grid, everywhere(kBodyBegin), everywhere(1.0), 0.0);
  const Revolution body(grid, kBodyBegin);

  PhysicalModel teapot = part("body", surface, {0.85, 0.80, 0.68}, options);
  for (const PhysicalModel& more :
       {lid_on(body, options), spout_on(body, options), handle_on(body, options)}) {
    teapot = glue(teapot, more, bond_of(options)).model;
    teapot.name = "teapot";
  }
  set_stiffness_proportional_damping(teapot, kDampingRatio);
  add_flaws(teapot, {kScatter, kSeams, kSeamStrength, options.seed});
  return teapot;
}

}  // namespace limber::demos

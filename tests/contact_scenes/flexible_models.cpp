#include "tests/contact_scenes/flexible_models.h"

#include <cmath>

#include "core/modeller/rope.h"
#include "core/modeller/sheet.h"
#include "core/modeller/thin_material.h"
#include "tests/bridge/world.h"

namespace limber::bullet::test {
namespace {

constexpr double kDampingRatio = 0.05;
constexpr double kInternalDamping = 5.0;  // 1/s

// Young's modulus of a column of this height that is `sag` (share) lower under its own weight:
// rho g H^2 / (2 E) = sag H.
double modulus_for_sag(double density, double height, double sag) {
  return density * kGravity * height / (2.0 * sag);
}

void pin_border(PhysicalModel& sheet, const Vec3& centre, double half_side) {
  for (PointId p : ids_of(sheet.points)) {
    const Vec3 offset = (sheet.geometry.points[p] - centre).cwiseAbs();
    sheet.points[p].pinned = std::max(offset.x(), offset.z()) > half_side - 1e-9;
  }
}

Material thin_material(double density, double modulus) {
  Material material;
  material.density = density;
  material.youngs_modulus = modulus;
  material.damping_ratio = kDampingRatio;
  material.internal_damping = kInternalDamping;
  return material;
}

}  // namespace

Block toy_block(double side, int cells, double modulus) {
  return {.cells = {cells, cells, cells},
          .spacing = side / cells,
          .mass = 1.0,
          .modulus = modulus,
          .damping_ratio = kDampingRatio,
          .internal_damping = kInternalDamping};
}

PhysicalModel cushion(const Vec3& centre) {
  const double density = kCushionMass / std::pow(kCushionSide, 3);
  Block block = toy_block(kCushionSide, 5, modulus_for_sag(density, kCushionSide, 0.01));
  block.mass = kCushionMass;
  return make_block(block, centre);
}

PhysicalModel make_sheet(const SquareSheet& sheet, const Vec3& centre) {
  constexpr double kThickness = 0.005;  // m
  Material material = thin_material(sheet.mass / (sheet.side * sheet.side * kThickness),
                                    sheet.stretch_stiffness / kThickness);
  material.strain_at_break = sheet.strain_at_break;
  const auto surface = [&](double u, double v) -> Vec3 {
    return centre + sheet.side * Vec3(u - 0.5, 0.0, 0.5 - v);
  };
  const SheetGrid grid{sheet.cells, sheet.cells, SheetCells::kSquares};
  PhysicalModel model = with_sheet_material(limber::sheet(surface, grid, "sheet"), "sheet",
                                            material, {.thickness = kThickness});
  if (sheet.pinned_border) pin_border(model, centre, 0.5 * sheet.side);
  return model;
}

PhysicalModel make_rope(const Vec3& centre, double length) {
  constexpr double kMassPerLength = 0.25;      // kg/m
  const double section = round_section(0.02);  // m^2
  constexpr double kStretchStiffness = 1e4;    // N
  const Vec3 half(0.5 * length, 0.0, 0.0);
  const Curve line = polyline({centre - half, centre + half});
  const auto points = points_along(line, segments_of(line, 0.05));
  return with_rope_material(rope(points, "rope"), "rope",
                            thin_material(kMassPerLength / section, kStretchStiffness / section),
                            section);
}

PhysicalModel make_needle(const Vec3& lower_end, double tilt) {
  Block needle = toy_block(0.02, 1, 1e7);
  needle.cells = {1, 20, 1};
  needle.mass = 0.1;
  PhysicalModel model = make_block(needle, {0.0, 0.5 * needle.size().y(), 0.0});
  place(model, Eigen::AngleAxisd(tilt, Vec3::UnitZ()).toRotationMatrix(), lower_end);
  return model;
}

}  // namespace limber::bullet::test

#pragma once

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <utility>

#include "core/modeller/sheet.h"
#include "core/modeller/thin_material.h"
#include "tests/bridge/models.h"

namespace limber::bullet::test {

// Square, 1 kg/m^2, 100 kN/m, horizontal at y = 0 about the origin; free, and unbreakable.
inline PhysicalModel level_sheet(int cells, double side) {
  constexpr double kThickness = 0.005;  // m
  Material material;
  material.density = 1.0 / kThickness;
  material.youngs_modulus = 1e5 / kThickness;
  material.strain_at_break = kUnbreakable;
  const auto flat = [&](double u, double v) -> Vec3 { return side * Vec3(u - 0.5, 0.0, 0.5 - v); };
  return with_sheet_material(sheet(flat, {cells, cells, SheetCells::kSquares}, "sheet"), "sheet",
                             material, {.thickness = kThickness});
}

// m, of the sheet at x and z: of the face that is there, none of which stands upright.
inline double height_at(const PhysicalModel& sheet, double x, double z) {
  for (const Face& face : sheet.geometry.faces) {
    Mat3 corners;  // (x, 1, z) of each, as columns
    Vec3 heights;
    for (int i = 0; i < 3; ++i) {
      corners.col(i) = sheet.geometry.points[face.corners[i]];
      heights[i] = std::exchange(corners(1, i), 1.0);
    }
    const Vec3 weights = corners.inverse() * Vec3(x, 1.0, z);
    if (weights.minCoeff() >= -1e-9) return weights.dot(heights);
  }
  ADD_FAILURE() << "beside the sheet";
  return 0.0;
}

}  // namespace limber::bullet::test

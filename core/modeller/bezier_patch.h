#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/vec3.h"

namespace limber {

// A bicubic Bezier patch: S(u, v) = sum over i, j of B_i(v) B_j(u) control[4 i + j], with the
// Bernstein polynomials B of degree three; u runs along a row of control points, v down the rows.
struct BezierPatch {
  std::array<Vec3, 16> control;

  Vec3 position(double u, double v) const;
  Vec3 derivative_u(double u, double v) const;
  Vec3 derivative_v(double u, double v) const;

  // Unit vector along dS/du x dS/dv. Where that vanishes, as at a pole, the limit from within the
  // patch.
  Vec3 normal(double u, double v) const;
};

// B_0 .. B_3 at t, which sum to one, and their derivatives.
std::array<double, 4> bernstein(double t);
std::array<double, 4> bernstein_derivative(double t);

// Patches that form one part of an object, in the order of the file.
struct PatchPart {
  std::string name;
  std::vector<BezierPatch> patches;
};

// Reads the text format of assets/teapot/teapot_patches.txt (described there). Throws InputError
// that names `source` and the line.
std::vector<PatchPart> parse_bezier_patches(std::string_view text, const std::string& source);

}  // namespace limber

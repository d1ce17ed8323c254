#pragma once

#include <array>

#include "core/model/vec3.h"

namespace limber::test {

// Two grids of points and the pairs of one of each that are at most and less than `distance` apart,
// the points of a and b with a partner, and the pairs one to one, nearest first. Counted in exact
// integer arithmetic (group "gluing" of the project's reference cases).
struct GluingCase {
  std::array<int, 3> points_a;
  double spacing_a;  // m
  std::array<int, 3> points_b;
  double spacing_b;  // m
  Vec3 origin_b;     // m; that of a is 0
  double distance;   // m
  std::size_t at_most, less, with_partner_a, with_partner_b, one_to_one;
};

// No two points coincide, and there are pairs.
inline const GluingCase kGluingCases[] = {
    {{3, 3, 3}, 0.1, {3, 3, 3}, 0.1, {0.3, 0, 0}, 0.1, 9, 0, 9, 9, 9},  // the gap itself
    {{3, 3, 3}, 0.1, {3, 3, 3}, 0.1, {0.3, 0, 0}, 0.1733, 49, 49, 9, 9, 9},
    {{3, 3, 3}, 0.1, {3, 3, 3}, 0.1, {0.3, 0, 0}, 0.21, 67, 67, 18, 18, 9},
    {{4, 5, 4}, 0.1, {4, 5, 4}, 0.1, {0.32, 0, 0}, 0.103, 82, 82, 20, 20, 20},
    {{4, 5, 4}, 0.1, {4, 5, 4}, 0.1, {0.32, 0, 0}, 0.145, 170, 170, 40, 40, 20},
    {{4, 4, 4}, 0.1, {7, 7, 7}, 0.05, {0.35, 0, 0}, 0.05, 16, 0, 16, 16, 16},
    {{4, 4, 4}, 0.1, {7, 7, 7}, 0.05, {0.35, 0, 0}, 0.09, 100, 100, 16, 49, 16},
    {{4, 4, 4}, 0.1, {7, 7, 7}, 0.05, {0.35, 0, 0}, 0.12, 212, 212, 16, 89, 16},
    {{5, 5, 2}, 0.09, {4, 4, 2}, 0.13, {0.01, -0.017, 0.12}, 0.06, 17, 17, 17, 16, 16},
    {{5, 5, 2}, 0.09, {4, 4, 2}, 0.13, {0.01, -0.017, 0.12}, 0.1, 42, 42, 25, 16, 16},
    {{2, 2, 2}, 1.0, {2, 2, 2}, 1.0, {1.1, 0.05, -0.03}, 1.05, 10, 10, 4, 4, 4},
};

}  // namespace limber::test

#include "core/modeller/hexahedral_cell.h"

#include <bit>

namespace limber {
namespace {

// The six sides, anticlockwise from outside.
constexpr std::array<std::array<int, 4>, 6> kSquares = {{
    {0, 4, 6, 2},  // -x
    {1, 3, 7, 5},  // +x
    {0, 1, 5, 4},  // -y
    {2, 6, 7, 3},  // +y
    {0, 2, 3, 1},  // -z
    {4, 5, 7, 6},  // +z
}};

}  // namespace

// Corners that differ in one bit lie along an axis, in two across a square, in three through the
// body.
std::vector<std::array<int, 2>> corner_pairs(const CellEdges& edges) {
  std::vector<std::array<int, 2>> pairs;
  for (int a = 0; a < kHexahedronCorners; ++a) {
    for (int b = a + 1; b < kHexahedronCorners; ++b) {
      const int differing = std::popcount(static_cast<unsigned>(a ^ b));
      const bool is_from_lowest = (a & b) == a;
      const bool across = edges.face_diagonals || (edges.one_face_diagonal && is_from_lowest);
      const bool wanted = (differing == 1 && edges.axial) || (differing == 2 && across) ||
                          (differing == 3 && edges.body_diagonals);
      if (wanted) pairs.push_back({a, b});
    }
  }
  return pairs;
}

CellId add_hexahedron(GeometricModelBuilder& builder, const HexahedronCorners& corners,
                      const std::vector<std::array<int, 2>>& pairs) {
  std::vector<std::array<PointId, 2>> edges;
  for (const auto& [a, b] : pairs) edges.push_back({corners[a], corners[b]});
  std::vector<std::array<PointId, 3>> faces;
  for (const auto& s : kSquares) {
    for (const auto& triangle :
         split_square({corners[s[0]], corners[s[1]], corners[s[2]], corners[s[3]]})) {
      faces.push_back(triangle);
    }
  }
  return builder.add_cell(edges, faces);
}

}  // namespace limber

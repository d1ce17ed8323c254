#pragma once

#include <cstddef>
#include <vector>

#include "core/model/errors.h"
#include "core/modeller/triangle_mesh.h"

namespace limber {

// What is wrong with a mesh, counted. Self-intersections are not looked for.
struct MeshDefects {
  std::size_t missing_corners = 0;       // triangles with a corner that does not exist
  std::size_t non_finite_positions = 0;  // NaN or infinite
  std::size_t degenerate_triangles = 0;  // without area
  std::size_t doubled_triangles = 0;     // the same corners in the same sense as an earlier one
  std::size_t open_edges = 0;            // of one triangle only
  std::size_t inconsistent_edges = 0;    // of two triangles that run the same way along it
  std::size_t non_manifold_edges = 0;    // of more than two triangles
  std::size_t parts = 0;                 // of triangles joined along edges

  // Every side is matched by its reverse: the mesh bounds a volume, some of it perhaps twice.
  bool closed() const { return unmatched_sides == 0; }
  std::size_t unmatched_sides = 0;  // sides of triangles that lack a reverse

  // m^2, of flat caps over the holes: for each connected set of unmatched sides the size of its
  // vector area, sum of (a - c) x (b - c) / 2, which no choice of c changes when the sides form
  // loops. 0 where a vertex lies in an edge instead of splitting it; too much where a gap has two
  // rims, each of which counts as a hole.
  double missing_area = 0.0;
};

// Vertices in one place count as two: see join_positions() in mesh_repair.h. No other defect hides
// one: with missing corners or positions that are not finite, only these are counted.
MeshDefects mesh_defects(const TriangleMesh& mesh);

// The same triangle from its lowest corner on: triangles with the same corners in the same sense
// become equal.
MeshTriangle lowest_first(MeshTriangle t);

// A side of a triangle and where it is from.
struct MeshSide {
  std::int32_t from = 0;
  std::int32_t to = 0;
  std::int32_t triangle = 0;

  std::int32_t low() const { return from < to ? from : to; }
  std::int32_t high() const { return from < to ? to : from; }
};

// All sides, those of one edge side by side, ordered by low(), high(), triangle.
std::vector<MeshSide> sorted_sides(const TriangleMesh& mesh);

// The number of sides from `first` on that belong to one edge.
std::size_t sides_of_edge(const std::vector<MeshSide>& sides, std::size_t first);

}  // namespace limber

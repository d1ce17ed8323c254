#pragma once

#include <cstddef>

#include "core/modeller/triangle_mesh.h"

namespace limber {

struct RefinedMesh {
  TriangleMesh mesh;
  double longest_edge = 0.0;  // m; above what was asked for where it stopped early
};

// Splits long edges in the middle until none is longer than `longest_m`, in both triangles of an
// edge alike, so that no vertex comes to lie inside an edge. Every round splits all edges that are
// too long; the first that would make more than `most_triangles` is left out, and all after it.
RefinedMesh refined(TriangleMesh mesh, double longest_m, std::size_t most_triangles);

}  // namespace limber

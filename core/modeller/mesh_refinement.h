#pragma once

#include <cstddef>

#include "core/modeller/triangle_mesh.h"

namespace limber {

// Splits long edges in the middle until none is longer than `longest_m`, in both triangles of an
// edge alike, so that no vertex comes to lie inside an edge. Stops early rather than to make more
// than `most_triangles`.
TriangleMesh refined(TriangleMesh mesh, double longest_m, std::size_t most_triangles);

}  // namespace limber

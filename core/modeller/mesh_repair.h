#pragma once

#include <cstddef>

#include "core/modeller/triangle_mesh.h"

namespace limber {

// A mesh put in order without moving anything, and what was done to it.
struct RepairedMesh {
  TriangleMesh mesh;
  std::size_t joined_positions = 0;     // that coincided exactly with an earlier one
  std::size_t collapsed_triangles = 0;  // dropped: two corners in one place
  std::size_t doubled_triangles = 0;    // dropped: there already, collapsed or not
  std::size_t most_copied = 0;          // how many of those are copies of one triangle
  std::size_t turned_triangles = 0;     // ran against their neighbours
  bool turned_whole = false;            // the mesh was inside out
  std::size_t turned_parts = 0;         // parts beside others that were inside out
};

// Joins equal positions, but not those of shells that are closed as they are to others', drops
// triangles that add nothing and turns those that face inwards:
//   - neighbours across an edge of two triangles run opposite ways along it; where they do not, the
//     smaller area of the connected patch is turned;
//   - a mesh of negative volume is turned as a whole;
//   - then a patch of negative volume is, unless all of it lies within others: it bounds a cavity.
// Needs finite positions and existing corners.
RepairedMesh repaired(TriangleMesh mesh);

}  // namespace limber

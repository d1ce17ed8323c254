#pragma once

#include <array>
#include <string>

#include "core/model/physical_model.h"

namespace limber::test {

// The edges of a cubic cell beside its 12 axial ones, named as in tests/data/README.md.
struct EdgeSet {
  bool one_diagonal = false;    // D
  bool both_diagonals = false;  // F
  bool body_diagonals = false;  // B
};

inline constexpr EdgeSet kAxial{};
inline constexpr EdgeSet kAllEdges{.both_diagonals = true, .body_diagonals = true};

struct BlockShape {
  std::array<int, 3> cells = {1, 1, 1};
  double spacing = 1.0;  // m
  Vec3 origin = Vec3::Zero();
  EdgeSet edges = kAllEdges;
  std::string name = "block";
};

// A block of cubic cells, points numbered x fastest. Independent of the library's own modeller.
GeometricModel block_geometry(const BlockShape& shape);

// The same with plausible attributes: 1 kg a point, 100 N/m, 1 N s/m, breaking at 0.1 m.
PhysicalModel block(const BlockShape& shape);

// The same with masses and stiffnesses that differ from point to point and edge to edge.
PhysicalModel uneven_block(std::array<int, 3> cells);

PointId block_point(const BlockShape& shape, std::array<int, 3> at);

// The edge between two points of the block; fails the test when there is none.
EdgeId block_edge(const PhysicalModel& model, const BlockShape& shape, std::array<int, 3> from,
                  std::array<int, 3> to);

// A flat sheet of 2 n^2 triangles in the plane z = 0 with all their sides as edges: faces that
// belong to no cell, or (polygons) one square 2-D cell for every pair of them.
PhysicalModel sheet(int n, bool polygons);

// Default attributes replaced by values that make any sound geometry a valid model.
PhysicalModel with_plausible_attributes(GeometricModel geometry, std::string name);

}  // namespace limber::test

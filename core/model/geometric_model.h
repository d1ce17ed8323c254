#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/model/ids.h"
#include "core/model/index_rows.h"
#include "core/model/vec3.h"

namespace limber {

// The paper's topological hierarchy: points < edges < faces < cells < subobjects.
// Invariants are numbered in docs/invariants.md and checked by validate().

struct Edge {
  PointId a, b;
};

// A triangle. Corners run anticlockwise seen from outside its cell and start with the smallest id,
// so that the face of the neighbouring cell is the exact reverse (paper, section 5.4).
// `cell` names nothing for a face that belongs to no cell.
struct Face {
  std::array<PointId, 3> corners;
  CellId cell;
};

// The unit of breaking: all edges and faces of a closed volume (3-D) or of a polygon (2-D).
struct Cell {
  std::vector<EdgeId> edges;
  std::vector<FaceId> faces;
};

// A named part of an object: a range of each level of the hierarchy. The gluing operator keeps the
// ranges of both operands and adds one for the new edges.
struct Subobject {
  std::string name;
  IdRange<PointId> points;
  IdRange<EdgeId> edges;
  IdRange<FaceId> faces;
  IdRange<CellId> cells;
};

struct GeometricModel {
  IdVector<PointId, Vec3> points;  // position, m
  IdVector<EdgeId, Edge> edges;
  IdVector<FaceId, Face> faces;
  IdVector<CellId, Cell> cells;
  std::vector<Subobject> subobjects;  // they partition every level, in order
};

// Rotates the corners so that the smallest id comes first; keeps the orientation.
std::array<PointId, 3> starting_with_smallest(std::array<PointId, 3> corners);

// The same triangle seen from the other side, starting with the same point.
std::array<PointId, 3> reversed(std::array<PointId, 3> corners);

// Closed surface of the cell: sum over faces of a . (b x c) / 6. m^3, positive when faces point
// out.
double cell_volume(const GeometricModel& model, CellId cell);

// The way back from edges to cells, the paper's two-way pointer: row e lists the cells of edge e,
// ascending. Ids that name nothing are left out.
IndexRows edge_cells(const GeometricModel& model);

// Builds a model bottom-up; every point belongs to the subobject that was begun last.
class GeometricModelBuilder {
 public:
  // Every element added from now on belongs to this subobject. Call it at least once.
  void begin_subobject(std::string name);

  PointId add_point(const Vec3& position_m);

  // The edge between two points, made on first use (adjacent cells share edges).
  EdgeId edge(PointId a, PointId b);

  // A face without a cell (sheets).
  FaceId add_face(std::array<PointId, 3> corners);

  // A cell from its edges (pairs of points) and its outward faces. Edges are shared with earlier
  // cells, faces are its own (paper, section 4).
  CellId add_cell(std::span<const std::array<PointId, 2>> edges,
                  std::span<const std::array<PointId, 3>> outward_faces);

  // Closes the last subobject and hands the model over; the builder is empty afterwards.
  GeometricModel finish();

 private:
  void close_subobject();
  EdgeId find_edge(PointId a, PointId b) const;
  EdgeId append_edge(PointId a, PointId b);

  // The edges around a point form a list, which begins at `first`. Points have a few dozen edges at
  // most in all but strange models: walking a list takes less time than a hash map would, and a
  // fifth of its memory.
  struct PointEdges {
    EdgeId first;
    std::int32_t count = 0;
  };

  GeometricModel model_;
  IdVector<PointId, PointEdges> around_;
  IdVector<EdgeId, std::array<EdgeId, 2>> next_;  // around the edge's a and b
};

// Two triangles for the square p0 p1 p2 p3 (anticlockwise from outside), split along the diagonal
// through its smallest id: both cells that share the square choose the same diagonal.
std::array<std::array<PointId, 3>, 2> split_square(const std::array<PointId, 4>& square);

}  // namespace limber

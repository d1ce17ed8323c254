#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/model/physical_model.h"

namespace limber {

struct SurfaceTriangle {
  std::array<int, 3> corners;        // into SurfaceModel::points, anticlockwise from outside
  FaceId source;                     // the face of the physical model; none: part of a skin
  int subobject = -1;                // into SurfaceModel::subobject_names
  bool exposed_by_breaking = false;  // an inner face until a cell broke
};

// The external surface of an object: only the points and faces that are seen. No physics.
struct SurfaceModel {
  std::vector<Vec3> points;  // m
  // The point of the physical model behind each of them; for one of a skin, a corner of the cell it
  // moves with.
  std::vector<PointId> source_point;
  std::vector<SurfaceTriangle> triangles;
  std::vector<std::string> subobject_names;
  std::vector<SurfaceProperties> subobject_surfaces;
};

}  // namespace limber

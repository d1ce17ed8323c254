#pragma once

#include <vector>

#include "core/model/physical_model.h"

namespace limber {

// What is seen of an object where it has no faces: a length of rope, or, with both ends the same, a
// grain.
struct Strand {
  PointId a, b;
  int subobject = -1;   // into GeometricModel::subobjects, of the edge or the grain
  double radius = 0.0;  // m
};

// The unbroken edges that belong to no cell, then the points that have no edge, of the parts with a
// strand radius; each in the order of their ids. What a boundary() leaves out.
std::vector<Strand> strands(const PhysicalModel& model);

}  // namespace limber

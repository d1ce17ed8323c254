#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/model/physical_model.h"

namespace limber::demos {

// How many elements each level of the hierarchy has.
struct LevelCounts {
  std::size_t points = 0, edges = 0, faces = 0, cells = 0;
};

struct SubobjectFacts {
  std::string name;
  LevelCounts count;
};

struct SkinCounts {
  std::size_t skins = 0, cells = 0, vertices = 0, triangles = 0;
};

// Of a property of edges, over those that are whole; least > most if there is none.
struct Range {
  double least = kUnbreakable;
  double most = -kUnbreakable;

  void take(double x);
  bool empty() const { return least > most; }
};

// What `limber info` says about a model.
struct ModelFacts {
  std::string name;
  LevelCounts count;
  std::vector<SubobjectFacts> subobjects;
  SkinCounts skin;

  Vec3 lowest = Vec3::Zero();   // m, corners of the axis-parallel box around all points
  Vec3 highest = Vec3::Zero();  // m
  double mass_kg = 0.0;
  Vec3 centre_of_mass = Vec3::Zero();  // m
  std::size_t pinned_points = 0;

  std::size_t broken_edges = 0;
  std::size_t invalid_cells = 0;
  Range stiffness;                    // N/m
  Range rest_length;                  // m
  Range break_threshold;              // m of stretch, of the edges that can break by it
  Range crush_threshold;              // m of shortening, likewise
  std::size_t unbreakable_edges = 0;  // neither stretch nor shortening breaks them

  ObjectAttributes object;
  double damping_ratio = 0.0;  // of the springs at the highest frequency
  double stable_step_s = 0.0;  // longest substep, infinite where nothing limits it
};

// The model has to be valid.
ModelFacts model_facts(PhysicalModel model);

}  // namespace limber::demos

#pragma once

#include <string>
#include <vector>

#include "core/model/errors.h"
#include "core/modeller/material_report.h"
#include "core/modeller/mesh_lattice.h"
#include "demos/cli/model_facts.h"

namespace limber::demos {

// What `limber model` says about the lattice it made of a mesh.
struct MadeModel {
  std::string mesh;          // the file
  std::string material;      // its name
  Vec3 size = Vec3::Zero();  // m, of the mesh
  double spacing = 0.0;      // m
  MeshLatticeReport fit;
  LevelCounts count;
  double mass_kg = 0.0;
  MaterialReport cost;
  std::vector<Diagnostic> early;  // notes that were said before the work began
  std::vector<Diagnostic> notes;
  std::string output;  // the model file, empty for none
};

// A note on a mesh that is larger or smaller than what people drop on floors, m: its unit is
// probably another.
std::vector<Diagnostic> size_notes(const std::string& mesh, const Vec3& size_m);

// A note on so many cells that they take minutes.
std::vector<Diagnostic> count_notes(const std::string& mesh, double volume_m3, double spacing_m);

std::string model_report(const MadeModel& made);  // for people
std::string model_json(const MadeModel& made);    // the same for programs

}  // namespace limber::demos

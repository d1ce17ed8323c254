#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/modeller/mesh_lattice.h"
#include "core/modeller/mesh_refinement.h"
#include "core/modeller/mesh_repair.h"
#include "core/modeller/voxel_pieces.h"
#include "core/modeller/voxels.h"

namespace limber {

// Internal to mesh_lattice(): what makes it refuse a mesh or say something about it. All that begin
// with "require" throw InputError with the defect, its numbers and a remedy.

// What the steps hand on to each other.
struct MeshLatticeWork {
  const MeshLatticeOptions& options;
  TriangleMesh mesh;  // repaired
  double area = 0.0;  // m^2
  MeshLattice out;

  [[noreturn]] void refuse(std::string what, std::string remedy) const {
    throw InputError({mesh.name, std::move(what), std::move(remedy)});
  }
  void note(std::string what, std::string remedy) {
    out.notes.push_back({mesh.name, std::move(what), std::move(remedy)});
  }
};

// A spacing, triangles, corners that exist and finite positions.
void require_sound(const TriangleMesh& mesh, double spacing_m);

// What the grid may need at once, before any of it is made.
void require_grid_that_fits(const TriangleMesh& mesh, double spacing_m);

void note_repairs(const RepairedMesh& repaired, MeshLatticeWork& work);

// Triangles that are there twice are an export's slip; one that is there a hundred times is what a
// reader makes of the rest of a file that breaks off. `triangles`: before the repair.
void require_few_copies(const RepairedMesh& repaired, std::size_t triangles,
                        const MeshLatticeWork& work);

// Closed, but perhaps for vertices that lie in an edge instead of splitting it.
bool encloses(const MeshLatticeWork& work);

void require_thickness(const MeshLatticeWork& work);

// A glance at few cells: what is open and plainly a sheet would take long to find out in many, or
// be told to take fewer.
void refuse_open_sheet(const MeshLatticeWork& work);

void note_refinement(const RefinedMesh& fine, MeshLatticeWork& work);

// What a sheet lacks: an inside that the surface is around.
void require_inside(const VoxelShares& shares, MeshLatticeWork& work);

void require_clear(const VoxelShares& shares, const MeshLatticeWork& work);
void require_count(const std::vector<std::int32_t>& kept, const MeshLatticeWork& work);

// Says how the cells, so many in all, hang together; refuses what hardly does.
void judge_pieces(const VoxelPieces& pieces, std::size_t cells, MeshLatticeWork& work);

// Of the cells with the mesh, in volume and inertia.
void require_agreement(MeshLatticeWork& work);

}  // namespace limber

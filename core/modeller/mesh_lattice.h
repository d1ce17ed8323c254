#pragma once

#include <string>
#include <vector>

#include "core/model/errors.h"
#include "core/model/skin.h"
#include "core/modeller/hexahedral_cell.h"
#include "core/modeller/mesh_defects.h"
#include "core/modeller/triangle_mesh.h"

namespace limber {

struct MeshLatticeOptions {
  double spacing = 0.0;  // m, side of a cell
  std::string name;      // of the subobject; the mesh's without it
  CellEdges edges;
  // Largest error of volume and inertia, as a share, that is taken rather than refused.
  double most_error = 0.25;
  std::size_t most_cells = 2'000'000;
  std::size_t most_skin_triangles = 2'000'000;
};

// How well the lattice stands for the mesh. A layer one cell thick under the surface is
// `layer_share` of the volume: errors of cells that are kept or left out are well below it.
struct MeshLatticeReport {
  SolidMoments mesh;  // exact for a closed mesh without overlaps, else by the samples
  bool mesh_is_exact = false;
  SolidMoments cells;   // of the lattice as full cubes
  SolidMoments points;  // as simulated: every cell an eighth at each corner; inertia larger by
                        // a third of volume x spacing^2 about every axis
  double volume_error = 0.0;   // (cells - mesh) / mesh
  double centre_error = 0.0;   // distance / spacing
  double inertia_error = 0.0;  // |cells - mesh| / |mesh| (Frobenius)
  double layer_share = 0.0;    // spacing x area / volume
  MeshDefects defects;         // of the repaired mesh
  double openness = 0.0;  // share of all directions that lead out through holes, seen from inside
  std::size_t surface_cells = 0;    // of the grid, that the surface passes through
  std::size_t ambiguous_cells = 0;  // whose winding number is within 0.05 of 1/2
  std::size_t pieces = 0;           // of cells joined by faces
  std::size_t separate_pieces = 0;  // of cells joined by points at least
  double loose_share = 0.0;         // of the cells, outside the largest piece of each separate one
  std::size_t dropped_cells = 0;    // in specks
  double skin_reach = 0.0;          // m, how far the skin is outside the lattice at most
};

struct MeshLattice {
  GeometricModel geometry;
  Skin skin;
  MeshLatticeReport report;
  std::vector<Diagnostic> notes;  // what was put right or is worth knowing
};

// A lattice of equal cubes in the shape of the mesh, which becomes its skin. A cell is kept when
// half of it or more is inside, by 3 x 3 x 3 winding numbers; the grid is parallel to the axes and
// in the middle of the mesh's box. Small defects are put right or closed by the winding number and
// reported in `notes`: inverted and doubled triangles, holes, overlaps. Specks are dropped: pieces
// of less than eight cells and 1 % of all, without a point in common with the rest. Larger parts
// that lie apart stay one object, in pieces; the notes count them.
//
// Throws InputError with the defect and its numbers for a spacing that is not positive; a mesh
// without triangles, with corners that do not exist or positions that are not finite; more than 8 %
// of the triangles copies of one, as in a file that breaks off; a surface that bounds no volume
// (a sheet, or so open that from inside more than a quarter of all directions lead out through
// holes); winding numbers that do not tell inside from outside (ambiguous cells more than 30 % of
// the surface cells); a mesh too thin for the spacing (no cell kept; volume or inertia off by more
// than most_error; more than 10 % of the cells joined by edges and points alone; parts farther from
// any cell than kMostSkinReach); more cells than most_cells.
MeshLattice mesh_lattice(const TriangleMesh& mesh, const MeshLatticeOptions& options);

// Moments of what is inside by winding numbers at cubes of `spacing_m`, fine enough to judge the
// lattice of a mesh that has no exact ones. Throws InputError, as mesh_lattice() does, for a
// senseless spacing or mesh and where the mesh's box takes more than 3.2e7 cubes.
SolidMoments sampled_moments(const TriangleMesh& mesh, double spacing_m);

}  // namespace limber

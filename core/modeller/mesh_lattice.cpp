#include "core/modeller/mesh_lattice.h"

#include <cmath>

#include "core/modeller/embedded_skin.h"
#include "core/modeller/mesh_lattice_checks.h"
#include "core/modeller/three_digits.h"
#include "core/modeller/voxel_lattice.h"

namespace limber {
namespace {

constexpr double kOverlap = 1.5;  // winding number where parts surely overlap

using Work = MeshLatticeWork;

std::vector<std::int32_t> cells_to_keep(const VoxelShares& shares) {
  std::vector<std::int32_t> kept;
  for (std::size_t i = 0; i < shares.share.size(); ++i)
    if (shares.share[i] >= 0.5f) kept.push_back(static_cast<std::int32_t>(i));
  return kept;
}

// Drops specks and says how the rest hangs together.
std::vector<std::int32_t> in_pieces(const VoxelGrid& grid, const std::vector<std::int32_t>& cells,
                                    Work& work) {
  std::vector<std::int32_t> kept = without_specks(grid, cells);
  const std::size_t dropped = cells.size() - kept.size();
  work.out.report.dropped_cells = dropped;
  if (dropped > 0)
    work.note(say_briefly(dropped, " of ", cells.size(), " cells ",
                          dropped == 1 ? "is a speck" : "are specks",
                          " without a point in common with the rest"),
              "dropped; give a smaller spacing if they matter");
  judge_pieces(voxel_pieces(grid, kept), kept.size(), work);
  return kept;
}

void measure_mesh(const VoxelShares& shares, Work& work) {
  MeshLatticeReport& report = work.out.report;
  report.mesh_is_exact = encloses(work) && shares.highest < kOverlap;
  report.mesh = report.mesh_is_exact ? solid_moments(work.mesh) : shares.moments;
  report.layer_share = work.options.spacing * work.area / report.mesh.volume;
  report.openness = shares.openness;
  report.surface_cells = shares.surface.size();
  report.ambiguous_cells = shares.ambiguous;
  if (shares.highest >= kOverlap)
    work.note("parts of it overlap or cut each other", "what is inside either is inside");
}

void measure_cells(const VoxelGrid& grid, const std::vector<std::int32_t>& kept, Work& work) {
  const VoxelMoments moments = voxel_moments(grid, kept);
  work.out.report.cells = moments.full;
  work.out.report.points = moments.lumped;
}

std::vector<LatticeCell> add_cells(const VoxelGrid& grid, const std::vector<std::int32_t>& kept,
                                   Work& work) {
  const std::string& name = work.options.name;
  VoxelLattice made =
      voxel_lattice(grid, kept, work.options.edges, name.empty() ? work.mesh.name : name);
  work.out.geometry = std::move(made.geometry);
  return std::move(made.cells);
}

void add_skin(const TriangleMesh& fine, const VoxelGrid& grid,
              const std::vector<LatticeCell>& cells, Work& work) {
  EmbeddedSkin embedded = embedded_skin(fine, grid, cells);
  work.out.skin = std::move(embedded.skin);
  work.out.report.skin_reach = embedded.reach;
  if (embedded.reach > work.options.spacing)
    work.note(say_briefly("sticks out of its lattice by up to ", embedded.reach, " m, ",
                          embedded.reach / work.options.spacing, " cells"),
              "such thin parts are seen but weigh nothing; give a smaller spacing if they matter");
}

// The mesh put in order, refused where it bounds nothing or would take too large a grid.
Work prepared(const TriangleMesh& mesh, const MeshLatticeOptions& options) {
  require_sound(mesh, options.spacing);
  RepairedMesh repair = repaired(mesh);
  Work work{options, std::move(repair.mesh), 0.0, {}};
  require_few_copies(repair, mesh.triangles.size(), work);
  note_repairs(repair, work);
  work.area = surface_area(work.mesh);
  work.out.report.defects = mesh_defects(work.mesh);
  require_thickness(work);
  refuse_open_sheet(work);
  require_grid_that_fits(work.mesh, options.spacing);
  return work;
}

}  // namespace

MeshLattice mesh_lattice(const TriangleMesh& mesh, const MeshLatticeOptions& options) {
  Work work = prepared(mesh, options);
  const VoxelGrid grid = grid_around(work.mesh, options.spacing);
  const RefinedMesh fine = refined(work.mesh, options.spacing, options.most_skin_triangles);
  note_refinement(fine, work);
  const VoxelShares shares =
      voxel_shares(grid, fine.mesh, FastWindingNumber(fine.mesh), encloses(work));
  require_inside(shares, work);
  require_clear(shares, work);
  measure_mesh(shares, work);
  const std::vector<std::int32_t> half_full = cells_to_keep(shares);
  require_count(half_full, work);
  const std::vector<std::int32_t> kept = in_pieces(grid, half_full, work);
  measure_cells(grid, kept, work);
  require_agreement(work);
  add_skin(fine.mesh, grid, add_cells(grid, kept, work), work);
  return std::move(work.out);
}

SolidMoments sampled_moments(const TriangleMesh& mesh, double spacing_m) {
  require_sound(mesh, spacing_m);
  require_grid_that_fits(mesh, spacing_m);
  const TriangleMesh fine = refined(mesh, spacing_m, 20 * mesh.triangles.size() + 1'000'000).mesh;
  return voxel_shares(grid_around(mesh, spacing_m), fine, FastWindingNumber(fine),
                      mesh_defects(mesh).closed())
      .moments;
}

}  // namespace limber

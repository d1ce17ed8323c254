#include "core/modeller/mesh_lattice.h"

#include <algorithm>
#include <cmath>

#include "core/model/diagnostic_list.h"
#include "core/model/disjoint_sets.h"
#include "core/modeller/embedded_skin.h"
#include "core/modeller/mesh_refinement.h"
#include "core/modeller/mesh_repair.h"
#include "core/modeller/voxel_pieces.h"
#include "core/modeller/voxels.h"

namespace limber {
namespace {

constexpr double kMostOpenness = 0.25;    // of all directions, seen from inside
constexpr double kSheetOpenness = 0.45;   // right behind a sheet it is a half
constexpr double kMostAmbiguous = 0.3;    // ambiguous cells / surface cells
constexpr double kFlat = 1e-6;            // mean thickness 2 V / A over the box's diagonal
constexpr double kMostGridCells = 3.2e7;  // 9 bytes each
constexpr double kSeam = 1e-6;            // missing share below which holes are but seams
constexpr double kMostCopies = 0.08;  // share of the triangles; a plate of Bullet's data has 0.054
constexpr double kMostLoose = 0.1;        // share of cells that only edges or points hold
constexpr double kOverlap = 1.5;          // winding number where parts surely overlap

std::string percent(double share) { return say(std::round(1000.0 * share) / 10.0, " %"); }

// What the steps hand on to each other.
struct Work {
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

void require_sound(const TriangleMesh& mesh, double spacing) {
  const auto refuse = [&](std::string what, std::string remedy) {
    throw InputError({mesh.name, std::move(what), std::move(remedy)});
  };
  if (!(spacing > 0.0 && std::isfinite(spacing)))
    refuse(say("the spacing of its lattice is ", spacing, " m"), "give a positive spacing");
  if (mesh.triangles.empty()) refuse("has no triangles", "give a mesh that bounds a volume");
  const MeshDefects defects = mesh_defects(mesh);
  if (defects.missing_corners > 0)
    refuse(say(defects.missing_corners, " of ", mesh.triangles.size(),
               " triangles have corners that do not exist"),
           "write the mesh anew");
  if (defects.non_finite_positions > 0)
    refuse(say(defects.non_finite_positions, " of ", mesh.positions.size(),
               " positions are not finite"),
           "remove or mend these vertices");
}

void note_repairs(const RepairedMesh& repaired, Work& work) {
  const auto triangles = [](std::size_t n) { return say(n, n == 1 ? " triangle" : " triangles"); };
  if (repaired.turned_whole)
    work.note("was inside out", "turned round as a whole; no need to do anything");
  if (repaired.turned_triangles > 0)
    work.note(triangles(repaired.turned_triangles) + " ran against their neighbours",
              "turned; look at them if the shape surprises you");
  if (repaired.turned_parts > 0)
    work.note(say(repaired.turned_parts, " of its parts were inside out"),
              "turned; look at them if the shape surprises you");
  if (repaired.doubled_triangles > 0)
    work.note(triangles(repaired.doubled_triangles) + " too many: there already",
              "dropped; no need to do anything");
}

// Triangles that are there twice are an export's slip; one that is there a hundred times is what a
// reader makes of the rest of a file that breaks off.
void require_few_copies(const RepairedMesh& repaired, std::size_t triangles, const Work& work) {
  const std::size_t copies = repaired.most_copied;
  if (double(copies) <= kMostCopies * double(triangles)) return;
  work.refuse(say(copies, " of ", triangles, " triangles are copies of one; more than ",
                  percent(kMostCopies), " looks like a file that breaks off"),
              "write the mesh anew, or remove the copies");
}

double missing_share(const Work& work) {
  const double missing = work.out.report.defects.missing_area;
  return missing > 0.0 ? missing / (missing + work.area) : 0.0;
}

// Closed, but perhaps for vertices that lie in an edge instead of splitting it.
bool encloses(const Work& work) { return missing_share(work) < kSeam; }

// m^3, sum over the parts that share vertices, whatever their sense; from one of their own
// vertices, so that an open part in one plane has none.
double enclosed_volume(const TriangleMesh& mesh) {
  DisjointSets parts(mesh.positions.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    parts.join(a, b);
    parts.join(b, c);
  }
  std::vector<double> volumes(mesh.positions.size(), 0.0);  // by the part's first vertex
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::int32_t root = parts.root(a);
    const Vec3& o = mesh.positions[root];
    const Vec3 p = mesh.positions[a] - o, q = mesh.positions[b] - o, r = mesh.positions[c] - o;
    volumes[root] += p.dot(q.cross(r)) / 6.0;
  }
  double sum = 0.0;
  for (double volume : volumes) sum += std::abs(volume);
  return sum;
}

[[noreturn]] void refuse_sheet(double volume, const Work& work) {
  work.refuse(say("is a sheet: encloses nothing, a volume of ", volume, " m^3 at an area of ",
                  work.area, " m^2"),
              "give it a thickness");
}

void require_thickness(const Work& work) {
  const auto [low, high] = bounding_box(work.mesh);
  const double volume = enclosed_volume(work.mesh);
  if (2.0 * volume <= kFlat * (high - low).norm() * work.area) refuse_sheet(volume, work);
}

// What a sheet lacks: an inside that the surface is around.
void require_inside(const VoxelShares& shares, Work& work) {
  if (encloses(work)) return;
  const std::string holes =
      say(work.out.report.defects.unmatched_sides, " sides of its triangles have no neighbour");
  const double volume = shares.moments.volume;
  if (volume == 0.0 || shares.openness > kSheetOpenness) refuse_sheet(volume, work);
  if (shares.openness > kMostOpenness)
    work.refuse(
        say("is open: ", holes, ", and seen from inside, ", percent(shares.openness),
            " of all directions lead out; more than ", percent(kMostOpenness), " is a sheet"),
        "close it, or model it as a shell");
  work.note(say("has holes: ", holes, "; seen from inside, ", percent(shares.openness),
                " of all directions lead out"),
            "closed by its winding number; close them yourself if the shape surprises you");
}

// What the grid may need at once, before any of it is made.
void require_grid_that_fits(const Work& work) {
  const auto [low, high] = bounding_box(work.mesh);
  const double spacing = work.options.spacing;
  const double cells = ((high - low) / spacing).array().round().max(1.0).prod();
  if (cells <= kMostGridCells) return;
  const double fits = spacing * std::cbrt(cells / kMostGridCells) * 1.01;
  work.refuse(say("its box takes ", cells, " cells of ", spacing, " m, more than ", kMostGridCells),
              say("give a spacing of ", fits, " m or more"));
}

void require_clear(const VoxelShares& shares, const Work& work) {
  const double limit = kMostAmbiguous * static_cast<double>(shares.surface.size());
  if (static_cast<double>(shares.ambiguous) <= limit) return;
  work.refuse(say("nobody can tell its inside from its outside: in ", shares.ambiguous,
                  " cells the winding number is 0.45 to 0.55, and only ", shares.surface.size(),
                  " have its surface in them; ", work.out.report.defects.unmatched_sides,
                  " sides of its triangles have no neighbour"),
              "mend its holes and the sense of its triangles");
}

std::vector<std::int32_t> cells_to_keep(const VoxelShares& shares) {
  std::vector<std::int32_t> kept;
  for (std::size_t i = 0; i < shares.share.size(); ++i)
    if (shares.share[i] >= 0.5f) kept.push_back(static_cast<std::int32_t>(i));
  return kept;
}

// Down to two digits.
double two_digits(double x) {
  const double digit = std::pow(10.0, std::floor(std::log10(x)) - 1.0);
  return std::floor(x / digit) * digit;
}

// Two cells through the mean thickness 2 V / A. Where the samples missed the volume, as many cells
// as one layer of them over one side takes.
std::string finer_spacing(const Work& work) {
  const double volume = work.out.report.mesh.volume;
  const double half = 0.5 * work.options.spacing;
  const double fits = two_digits(volume > 0.0 ? std::min(half, volume / work.area) : half);
  const double cells = volume > 0.0 ? volume / std::pow(fits, 3) : 0.5 * work.area / (fits * fits);
  const std::string all = say("give a spacing of ", fits, " m or less, which makes about ",
                              two_digits(std::max(cells, 1.0)), " cells");
  const auto most = double(work.options.most_cells);
  return cells > most ? all + say(", more than ", most, ": make it thicker") : all;
}

void require_count(const std::vector<std::int32_t>& kept, const Work& work) {
  const MeshLatticeOptions& options = work.options;
  if (kept.empty())
    work.refuse(say("is thinner than a cell of ", options.spacing, " m: none is half full"),
                finer_spacing(work));
  if (kept.size() <= options.most_cells) return;
  const double share = double(kept.size()) / double(options.most_cells);
  work.refuse(say("takes ", kept.size(), " cells of ", options.spacing, " m, more than ",
                  options.most_cells),
              say("give a spacing of ", 1.01 * options.spacing * std::cbrt(share), " m or more"));
}

// Drops specks and says how the rest hangs together.
std::vector<std::int32_t> in_pieces(const VoxelGrid& grid, const std::vector<std::int32_t>& cells,
                                    Work& work) {
  MeshLatticeReport& report = work.out.report;
  std::vector<std::int32_t> kept = without_specks(grid, cells);
  report.dropped_cells = cells.size() - kept.size();
  if (report.dropped_cells > 0)
    work.note(say(report.dropped_cells, " of ", cells.size(),
                  " cells are specks without a point in common with the rest"),
              "dropped; give a smaller spacing if they matter");
  const VoxelPieces pieces = voxel_pieces(grid, kept);
  report.pieces = pieces.by_faces;
  report.separate_pieces = pieces.by_points;
  report.loose_share = double(pieces.loose) / double(kept.size());
  if (report.loose_share > kMostLoose)
    work.refuse(
        say("is too thin for cells of ", work.options.spacing, " m: ", percent(report.loose_share),
            " of them hang on the rest by edges or points only"),
        finer_spacing(work));
  if (pieces.loose > 0)
    work.note(say(pieces.loose, " cells hang on the rest by edges or points only"),
              "kept, hinged; give a smaller spacing to hold them better");
  if (pieces.by_points > 1)
    work.note(say("its cells lie in ", pieces.by_points, " parts without a common point"),
              "kept as one object in pieces; glue them, or give a smaller spacing to join them");
  return kept;
}

// Points at the corners of kept cells, numbered x fastest like the grid's.
class CornerPoints {
 public:
  CornerPoints(const VoxelGrid& grid, const std::vector<std::int32_t>& kept,
               GeometricModelBuilder& builder)
      : corners_{grid.origin,
                 grid.spacing,
                 {grid.cells[0] + 1, grid.cells[1] + 1, grid.cells[2] + 1}},
        point_(corners_.size()) {
    std::vector<std::uint8_t> used(corners_.size(), 0);
    for (std::int32_t cell : kept)
      for (int c = 0; c < kHexahedronCorners; ++c)
        used[index(grid.place(std::size_t(cell)), c)] = 1;
    for (std::size_t i = 0; i < used.size(); ++i)
      if (used[i]) point_[i] = builder.add_point(corners_.lowest_corner(corners_.place(i)));
  }

  HexahedronCorners of(const VoxelIndex& place) const {
    HexahedronCorners corners;
    for (int c = 0; c < kHexahedronCorners; ++c) corners[c] = point_[index(place, c)];
    return corners;
  }

 private:
  std::size_t index(const VoxelIndex& p, int c) const {
    return corners_.index({p[0] + (c & 1), p[1] + (c >> 1 & 1), p[2] + (c >> 2 & 1)});
  }

  VoxelGrid corners_;  // one "cell" for every corner
  std::vector<PointId> point_;
};

std::vector<LatticeCell> add_cells(const VoxelGrid& grid, const std::vector<std::int32_t>& kept,
                                   Work& work) {
  GeometricModelBuilder builder;
  builder.begin_subobject(work.options.name.empty() ? work.mesh.name : work.options.name);
  const CornerPoints points(grid, kept, builder);
  const auto pairs = corner_pairs(work.options.edges);
  std::vector<LatticeCell> cells;
  cells.reserve(kept.size());
  for (std::int32_t i : kept) {
    const VoxelIndex place = grid.place(std::size_t(i));
    const HexahedronCorners corners = points.of(place);
    cells.push_back({place, add_hexahedron(builder, corners, pairs), corners});
  }
  work.out.geometry = builder.finish();
  return cells;
}

// Full cubes, and the same mass at their corners.
void measure_cells(const VoxelGrid& grid, const std::vector<std::int32_t>& kept, Work& work) {
  const double a = grid.spacing, volume = a * a * a;
  MomentSums full, lumped;
  full.origin = lumped.origin = grid.origin;
  for (std::int32_t cell : kept) {
    const Vec3 middle = grid.lowest_corner(grid.place(std::size_t(cell))) + Vec3::Constant(0.5 * a);
    full.add(volume, middle, volume * a * a / 12.0 * Mat3::Identity());
    lumped.add(volume, middle, volume * a * a / 4.0 * Mat3::Identity());
  }
  work.out.report.cells = full.moments();
  work.out.report.points = lumped.moments();
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

void require_agreement(Work& work) {
  MeshLatticeReport& report = work.out.report;
  const SolidMoments &mesh = report.mesh, &cells = report.cells;
  report.volume_error = cells.volume / mesh.volume - 1.0;
  report.centre_error = (cells.centre - mesh.centre).norm() / work.options.spacing;
  report.inertia_error = (cells.inertia - mesh.inertia).norm() / mesh.inertia.norm();
  const double most = work.options.most_error;
  if (std::abs(report.volume_error) <= most && report.inertia_error <= most) return;
  work.refuse(
      say("is too thin for cells of ", work.options.spacing, " m: their volume of ", cells.volume,
          " m^3 is off by ", percent(report.volume_error), ", their inertia by ",
          percent(report.inertia_error), "; more than ", percent(most), " is another body"),
      finer_spacing(work));
}

void add_skin(const TriangleMesh& fine, const VoxelGrid& grid,
              const std::vector<LatticeCell>& cells, Work& work) {
  EmbeddedSkin embedded = embedded_skin(fine, grid, cells);
  work.out.skin = std::move(embedded.skin);
  work.out.report.skin_reach = embedded.reach;
  if (embedded.reach > work.options.spacing)
    work.note(say("sticks out of its lattice by up to ", embedded.reach, " m, ",
                  embedded.reach / work.options.spacing, " cells"),
              "such thin parts are seen but weigh nothing; give a smaller spacing if they matter");
}

}  // namespace

MeshLattice mesh_lattice(const TriangleMesh& mesh, const MeshLatticeOptions& options) {
  require_sound(mesh, options.spacing);
  RepairedMesh repair = repaired(mesh);
  Work work{options, std::move(repair.mesh), 0.0, {}};
  require_few_copies(repair, mesh.triangles.size(), work);
  note_repairs(repair, work);
  work.area = surface_area(work.mesh);
  work.out.report.defects = mesh_defects(work.mesh);
  require_thickness(work);
  require_grid_that_fits(work);

  const VoxelGrid grid = grid_around(work.mesh, options.spacing);
  const TriangleMesh fine = refined(work.mesh, options.spacing, options.most_skin_triangles);
  const VoxelShares shares = voxel_shares(grid, fine, FastWindingNumber(fine), encloses(work));
  require_inside(shares, work);
  require_clear(shares, work);
  measure_mesh(shares, work);
  const std::vector<std::int32_t> half_full = cells_to_keep(shares);
  require_count(half_full, work);
  const std::vector<std::int32_t> kept = in_pieces(grid, half_full, work);
  measure_cells(grid, kept, work);
  require_agreement(work);
  add_skin(fine, grid, add_cells(grid, kept, work), work);
  return std::move(work.out);
}

SolidMoments sampled_moments(const TriangleMesh& mesh, double spacing_m) {
  const TriangleMesh fine = refined(mesh, spacing_m, 20 * mesh.triangles.size() + 1'000'000);
  return voxel_shares(grid_around(mesh, spacing_m), fine, FastWindingNumber(fine),
                      mesh_defects(mesh).closed())
      .moments;
}

}  // namespace limber

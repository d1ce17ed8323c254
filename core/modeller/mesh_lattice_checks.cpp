#include "core/modeller/mesh_lattice_checks.h"

#include <algorithm>
#include <cmath>

#include "core/model/disjoint_sets.h"
#include "core/modeller/three_digits.h"

namespace limber {
namespace {

constexpr double kMostOpenness = 0.25;    // of all directions, seen from inside
constexpr double kSheetOpenness = 0.45;   // right behind a sheet it is a half
constexpr double kMostAmbiguous = 0.3;    // ambiguous cells / surface cells
constexpr double kFlat = 1e-6;            // mean thickness 2 V / A over the box's diagonal
constexpr double kMostGridCells = 3.2e7;  // 9 bytes each
constexpr double kSeam = 1e-6;            // missing share below which holes are but seams
constexpr double kMostCopies = 0.08;      // of the triangles; a plate of Bullet's data has 0.054
constexpr double kMostLoose = 0.1;        // share of cells that only edges or points hold
constexpr double kGlance = 24.0;          // cells along the longest side that show a sheet
constexpr double kManyCells = 2e5;        // which take minutes to make and long to simulate

std::string percent(double share) { return say_briefly(std::round(1000.0 * share) / 10.0, " %"); }

double missing_share(const MeshLatticeWork& work) {
  const double missing = work.out.report.defects.missing_area;
  return missing > 0.0 ? missing / (missing + work.area) : 0.0;
}

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

[[noreturn]] void refuse_sheet(double volume, const MeshLatticeWork& work) {
  work.refuse(say_briefly("is a sheet: encloses nothing, a volume of ", volume,
                          " m^3 at an area of ", work.area, " m^2"),
              "give it a thickness; a sheet() or shell_patch() over its surface needs no inside");
}

// Down to two digits.
double two_digits(double x) {
  const double digit = std::pow(10.0, std::floor(std::log10(x)) - 1.0);
  return std::floor(x / digit) * digit;
}

// Two cells through the mean thickness 2 V / A. Where the samples missed the volume, as many cells
// as one layer of them over one side takes.
std::string finer_spacing(const MeshLatticeWork& work) {
  const double volume = work.out.report.mesh.volume;
  const double half = 0.5 * work.options.spacing;
  const double fits = two_digits(volume > 0.0 ? std::min(half, volume / work.area) : half);
  const double cells = volume > 0.0 ? volume / std::pow(fits, 3) : 0.5 * work.area / (fits * fits);
  const auto count = static_cast<std::size_t>(two_digits(std::max(cells, 1.0)));
  const std::string all =
      say_briefly("give a spacing of ", fits, " m or less, which makes about ", count, " cells");
  if (cells > double(work.options.most_cells)) return all + ", too many: make it thicker";
  return cells > kManyCells ? all + ": they take minutes; rather make it thicker" : all;
}

}  // namespace

void require_sound(const TriangleMesh& mesh, double spacing) {
  const auto refuse = [&](std::string what, std::string remedy) {
    throw InputError({mesh.name, std::move(what), std::move(remedy)});
  };
  if (!(spacing > 0.0 && std::isfinite(spacing)))
    refuse(say_briefly("the spacing of its lattice is ", spacing, " m"), "give a positive spacing");
  if (mesh.triangles.empty()) refuse("has no triangles", "give a mesh that bounds a volume");
  const MeshDefects defects = mesh_defects(mesh);
  if (defects.missing_corners > 0)
    refuse(say_briefly(defects.missing_corners, " of ", mesh.triangles.size(),
                       " triangles have corners that do not exist"),
           "write the mesh anew");
  if (defects.non_finite_positions > 0)
    refuse(say_briefly(defects.non_finite_positions, " of ", mesh.positions.size(),
                       " positions are not finite"),
           "remove or mend these vertices");
}

void note_repairs(const RepairedMesh& repaired, MeshLatticeWork& work) {
  const auto triangles = [](std::size_t n) {
    return say_briefly(n, n == 1 ? " triangle" : " triangles");
  };
  if (repaired.turned_whole)
    work.note("was inside out", "turned round as a whole; no need to do anything");
  if (repaired.turned_triangles > 0)
    work.note(triangles(repaired.turned_triangles) + " ran against their neighbours",
              "turned; look at them if the shape surprises you");
  if (repaired.turned_parts > 0)
    work.note(say_briefly(repaired.turned_parts, " of its parts ",
                          repaired.turned_parts == 1 ? "was" : "were", " inside out"),
              "turned; look at them if the shape surprises you");
  if (repaired.doubled_triangles > 0)
    work.note(triangles(repaired.doubled_triangles) + " too many: there already",
              "dropped; no need to do anything");
}

void require_few_copies(const RepairedMesh& repaired, std::size_t triangles,
                        const MeshLatticeWork& work) {
  const std::size_t copies = repaired.most_copied;
  if (double(copies) <= kMostCopies * double(triangles)) return;
  work.refuse(say_briefly(copies, " of ", triangles, " triangles are copies of one; more than ",
                          percent(kMostCopies), " looks like a file that breaks off"),
              "write the mesh anew, or remove the copies");
}

bool encloses(const MeshLatticeWork& work) { return missing_share(work) < kSeam; }

void require_thickness(const MeshLatticeWork& work) {
  const auto [low, high] = bounding_box(work.mesh);
  const double volume = enclosed_volume(work.mesh);
  if (2.0 * volume <= kFlat * (high - low).norm() * work.area) refuse_sheet(volume, work);
}

void refuse_open_sheet(const MeshLatticeWork& work) {
  if (encloses(work)) return;
  const auto [low, high] = bounding_box(work.mesh);
  const double spacing = (high - low).maxCoeff() / kGlance;
  if (spacing <= work.options.spacing) return;
  const TriangleMesh fine = refined(work.mesh, spacing, work.options.most_skin_triangles).mesh;
  const VoxelShares shares =
      voxel_shares(grid_around(work.mesh, spacing), fine, FastWindingNumber(fine), false);
  const double volume = shares.moments.volume;
  if (volume > 0.0 && shares.openness > kSheetOpenness) refuse_sheet(volume, work);
}

void note_refinement(const RefinedMesh& fine, MeshLatticeWork& work) {
  const MeshLatticeOptions& options = work.options;
  if (fine.longest_edge <= options.spacing) return;
  work.note(say_briefly("its skin would take more than ", options.most_skin_triangles,
                        " triangles to have no edge longer than a cell of ", options.spacing,
                        " m; the longest is ", fine.longest_edge, " m"),
            "left so long, it tears and bends in larger pieces than the cells; give a larger "
            "spacing or a mesh of more even triangles");
}

void require_inside(const VoxelShares& shares, MeshLatticeWork& work) {
  if (encloses(work)) return;
  const std::string holes = say_briefly(work.out.report.defects.unmatched_sides,
                                        " sides of its triangles have no neighbour");
  const double volume = shares.moments.volume;
  if (volume == 0.0 || shares.openness > kSheetOpenness) refuse_sheet(volume, work);
  if (shares.openness > kMostOpenness)
    work.refuse(say_briefly("is open: ", holes, ", and seen from inside, ",
                            percent(shares.openness), " of all directions lead out; more than ",
                            percent(kMostOpenness), " is a sheet"),
                "close it, or model it as a shell");
  work.note(say_briefly("has holes: ", holes, "; seen from inside, ", percent(shares.openness),
                        " of all directions lead out"),
            "closed by its winding number; close them yourself if the shape surprises you");
}

void require_grid_that_fits(const TriangleMesh& mesh, double spacing) {
  const auto [low, high] = bounding_box(mesh);
  const double cells = ((high - low) / spacing).array().round().max(1.0).prod();
  if (cells <= kMostGridCells) return;
  const double fits = spacing * std::cbrt(cells / kMostGridCells) * 1.01;
  throw InputError({mesh.name,
                    say_briefly("its box takes ", cells, " cells of ", spacing, " m, more than ",
                                kMostGridCells),
                    say_briefly("give a spacing of ", fits, " m or more")});
}

void require_clear(const VoxelShares& shares, const MeshLatticeWork& work) {
  const double limit = kMostAmbiguous * static_cast<double>(shares.surface.size());
  if (static_cast<double>(shares.ambiguous) <= limit) return;
  work.refuse(
      say_briefly("nobody can tell its inside from its outside: in ", shares.ambiguous,
                  " cells the winding number is 0.45 to 0.55, and only ", shares.surface.size(),
                  " have its surface in them; ", work.out.report.defects.unmatched_sides,
                  " sides of its triangles have no neighbour"),
      "mend its holes and the sense of its triangles");
}

void require_count(const std::vector<std::int32_t>& kept, const MeshLatticeWork& work) {
  const MeshLatticeOptions& options = work.options;
  if (kept.empty())
    work.refuse(say_briefly("is thinner than a cell of ", options.spacing, " m: none is half full"),
                finer_spacing(work));
  if (kept.size() <= options.most_cells) return;
  const double share = double(kept.size()) / double(options.most_cells);
  work.refuse(
      say_briefly("takes ", kept.size(), " cells of ", options.spacing, " m, more than ",
                  options.most_cells),
      say_briefly("give a spacing of ", 1.01 * options.spacing * std::cbrt(share), " m or more"));
}

void judge_pieces(const VoxelPieces& pieces, std::size_t cells, MeshLatticeWork& work) {
  MeshLatticeReport& report = work.out.report;
  report.pieces = pieces.by_faces;
  report.separate_pieces = pieces.by_points;
  report.loose_share = double(pieces.loose) / double(cells);
  if (report.loose_share > kMostLoose)
    work.refuse(say_briefly("is too thin for cells of ", work.options.spacing,
                            " m: ", percent(report.loose_share),
                            " of them hang on the rest by edges or points only"),
                finer_spacing(work));
  if (pieces.loose > 0)
    work.note(say_briefly(pieces.loose, pieces.loose == 1 ? " cell hangs" : " cells hang",
                          " on the rest by edges or points only"),
              "kept, hinged; give a smaller spacing to hold them better");
  if (pieces.by_points > 1)
    work.note(say_briefly("its cells lie in ", pieces.by_points, " parts without a common point"),
              "kept as one object in pieces; glue them, or give a smaller spacing to join them");
}

void require_agreement(MeshLatticeWork& work) {
  MeshLatticeReport& report = work.out.report;
  const SolidMoments &mesh = report.mesh, &cells = report.cells;
  report.volume_error = cells.volume / mesh.volume - 1.0;
  report.centre_error = (cells.centre - mesh.centre).norm() / work.options.spacing;
  report.inertia_error = (cells.inertia - mesh.inertia).norm() / mesh.inertia.norm();
  const double most = work.options.most_error;
  if (std::abs(report.volume_error) <= most && report.inertia_error <= most) return;
  work.refuse(say_briefly("is too thin for cells of ", work.options.spacing, " m: their volume of ",
                          cells.volume, " m^3 is off by ", percent(report.volume_error),
                          ", their inertia by ", percent(report.inertia_error), "; more than ",
                          percent(most), " is another body"),
              finer_spacing(work));
}

}  // namespace limber

#include "core/modeller/material_report.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "core/dynamics/stable_step.h"
#include "core/model/diagnostic_list.h"
#include "core/model/median.h"
#include "core/modeller/cell_kind.h"
#include "core/modeller/cell_shape.h"
#include "core/modeller/cell_stiffness.h"

namespace limber {
namespace {

constexpr double kPoissonOfSolid = 0.25;
constexpr double kPoissonOfSheet = 1.0 / 3.0;
constexpr double kPoissonWorthANote = 0.02;
constexpr double kAnisotropyOfACell = 0.15;
constexpr double kAnisotropyOfHalfTheCells = 0.05;
constexpr double kSlackShare = 0.01;

struct ShapeQuality {
  double anisotropy = 0.0;
  double elongation = 1.0;
};

ShapeQuality quality_of(const GeometricModel& geometry, const CellShape& shape) {
  // Neither modulus nor volume has a say: stiffness is proportional to both.
  const std::vector<double> k = isotropic_cell_stiffness(shape.edges, 1.0, 1.0);
  std::vector<Vec3> corners;
  for (PointId p : shape.points) corners.push_back(geometry.points[p]);
  return {anisotropy(shape.edges, k, 1.0, 1.0), elongation(corners)};
}

void judge_cells(const GeometricModel& geometry, MaterialReport& report) {
  // Sides of boxes are known to rounding: what is as long as the limit is not beyond it.
  constexpr double kLong = kLongestIsotropicBox * (1.0 + 1e-9);
  CellShape shape;
  RoundedKey key;
  RoundedCache<ShapeQuality> known;
  std::vector<double> anisotropies;
  for (std::size_t c = 0; c < geometry.cells.size(); ++c) {
    const Cell& cell = geometry.cells[CellId(c)];
    const bool is_sheet = is_sheet_cell(geometry, cell);
    report.sheet_cells += is_sheet;
    if (is_sheet || !(cell_volume(geometry, CellId(c)) > 0.0)) continue;
    shape.read(geometry, cell);
    set_shape_key(shape.edges, key);
    const ShapeQuality quality = known.get(key, [&] { return quality_of(geometry, shape); });
    anisotropies.push_back(quality.anisotropy);
    report.worst_anisotropy = std::max(report.worst_anisotropy, quality.anisotropy);
    report.worst_elongation = std::max(report.worst_elongation, quality.elongation);
    report.long_cells += quality.elongation > kLong;
  }
  report.solid_cells = anisotropies.size();
  report.median_anisotropy = upper_median(std::move(anisotropies));
}

void judge_edges(const PhysicalModel& model, MaterialReport& report) {
  report.edges = model.edges.size();
  for (const EdgeAttributes& edge : model.edges) report.slack_edges += edge.stiffness == 0.0;
}

// Largest c / k of the springs, s.
double longest_damping_time(const PhysicalModel& model) {
  double longest = 0.0;
  for (const EdgeAttributes& edge : model.edges)
    if (!edge.broken && edge.stiffness > 0.0)
      longest = std::max(longest, edge.damping / edge.stiffness);
  return longest;
}

void judge_cost(const PhysicalModel& model, MaterialReport& report) {
  const FrequencyBound bound = highest_frequency(model);
  report.softening = model.object.softening;
  report.frequency_verified = bound.verified;
  if (bound.omega_max == 0.0) return;
  const double damping_ratio = longest_damping_time(model) * bound.omega_max / 2.0;
  const double seconds = stable_step(bound.omega_max, damping_ratio);
  report.substeps_per_tick = std::ceil(kReportTick / seconds);
  report.substeps_per_tick_unsoftened =
      std::ceil(kReportTick / seconds * std::sqrt(model.object.softening));
}

// "20 % too low"
std::string how_far_off(double ratio) {
  const double percent = 100.0 * std::abs(ratio - 1.0);
  return say(std::round(10.0 * percent) / 10.0, " % too ", ratio < 1.0 ? "low" : "high");
}

// For people: three decimals, from a thousand on whole numbers, never an exponent.
std::string rounded(double value) {
  std::ostringstream out;
  if (std::abs(value) >= 1000.0) {
    out << std::fixed << std::setprecision(0) << value;
  } else {
    out << std::setprecision(4) << std::round(1000.0 * value) / 1000.0;
  }
  return out.str();
}

using Notes = std::vector<Diagnostic>;

// What a lattice of this dimension can do, in words.
struct Elasticity {
  double poisson_ratio;
  PoissonMiss (*miss)(double);
  const char* of;
  const char* ratio;
  const char* bulk;
  const char* effect;
};

constexpr Elasticity kSolid = {
    kPoissonOfSolid, poisson_miss,
    "springs",       "0.25",
    "bulk modulus",  "stretching and bending are right, shear, twist and pressure are off by this"};
constexpr Elasticity kSheet = {
    kPoissonOfSheet,
    sheet_poisson_miss,
    "springs in a sheet",
    "1/3",
    "modulus against a change of area",
    "stretching is right, shear and stretching in all directions at once are off by this"};

void note_poisson(const std::string& where, double nu, const Elasticity& lattice, Notes& notes) {
  if (std::abs(nu - lattice.poisson_ratio) <= kPoissonWorthANote) return;
  const PoissonMiss miss = lattice.miss(nu);
  notes.push_back({where,
                   say("its Poisson ratio is ", rounded(nu), ", that of ", lattice.of, " is ",
                       lattice.ratio, ": the shear modulus is ", how_far_off(miss.shear_ratio),
                       ", the ", lattice.bulk, " ", how_far_off(miss.bulk_ratio)),
                   lattice.effect});
}

void note_materials(const std::string& name, const MaterialReport& report,
                    std::span<const Material> materials, Notes& notes) {
  for (std::size_t m = 0; m < materials.size(); ++m) {
    const double nu = materials[m].poisson_ratio;
    const std::string where =
        materials.size() == 1 ? name + ": material" : say(name, ": material ", m);
    if (report.solid_cells > 0) note_poisson(where, nu, kSolid, notes);
    if (report.sheet_cells > 0) note_poisson(where, nu, kSheet, notes);
  }
}

void note_cells(const std::string& name, const MaterialReport& report, Notes& notes) {
  if (report.long_cells > 0) {
    notes.push_back({name + ": cells",
                     say(report.long_cells, " of ", report.solid_cells, " are longer than ",
                         rounded(kLongestIsotropicBox), " times their width (the longest ",
                         rounded(report.worst_elongation),
                         " times): isotropy would take negative spring constants"),
                     "make the cells more nearly cubes"});
  }
  if (report.worst_anisotropy > kAnisotropyOfACell ||
      report.median_anisotropy > kAnisotropyOfHalfTheCells) {
    notes.push_back({name + ": cells",
                     say("their stiffness depends on direction: off by ",
                         rounded(report.worst_anisotropy), " of C_1111 in the worst cell, by ",
                         rounded(report.median_anisotropy), " in the median"),
                     "make the cells more nearly cubes, or give them all their diagonals"});
  }
}

void note_slack(const std::string& name, const MaterialReport& report, Notes& notes) {
  const auto edges = static_cast<double>(report.edges);
  if (!(static_cast<double>(report.slack_edges) > kSlackShare * edges)) return;
  notes.push_back({name + ": edges",
                   say(report.slack_edges, " of ", report.edges, " (",
                       rounded(100.0 * static_cast<double>(report.slack_edges) / edges),
                       " %) have stiffness 0: they carry nothing and still break"),
                   "make the cells more nearly cubes or equilateral prisms"});
}

void note_softening(const std::string& name, const MaterialReport& report, Notes& notes) {
  if (report.softening == 1.0) return;
  notes.push_back(
      {name + ": softening",
       say("S is ", rounded(report.softening), ": ", rounded(report.substeps_per_tick),
           report.substeps_per_tick == 1.0 ? " substep" : " substeps",
           " a tick of 1/60 s instead of ", rounded(report.substeps_per_tick_unsoftened),
           "; the modulus is divided by S, ", "strains at break are multiplied by ",
           rounded(std::sqrt(report.softening))),
       "what impact speed breaks it stays; loads at rest bend it S times as far"});
}

}  // namespace

PoissonMiss poisson_miss(double poisson_ratio) {
  return {(1.0 + poisson_ratio) / (1.0 + kPoissonOfSolid),
          (1.0 - 2.0 * poisson_ratio) / (1.0 - 2.0 * kPoissonOfSolid)};
}

PoissonMiss sheet_poisson_miss(double poisson_ratio) {
  return {(1.0 + poisson_ratio) / (1.0 + kPoissonOfSheet),
          (1.0 - poisson_ratio) / (1.0 - kPoissonOfSheet)};
}

MaterialReport material_report(const PhysicalModel& model) {
  MaterialReport report;
  judge_cells(model.geometry, report);
  judge_edges(model, report);
  judge_cost(model, report);
  return report;
}

std::vector<Diagnostic> modelling_notes(const PhysicalModel& model, const MaterialReport& report,
                                        std::span<const Material> materials) {
  Notes notes;
  note_materials(model.name, report, materials, notes);
  note_cells(model.name, report, notes);
  note_slack(model.name, report, notes);
  note_softening(model.name, report, notes);
  return notes;
}

}  // namespace limber

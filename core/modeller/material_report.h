#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/model/errors.h"
#include "core/modeller/material.h"

namespace limber {

// What a lattice of central forces makes of a material. Its Poisson ratio is 1/4, so its shear
// modulus E / 2.5 and its bulk modulus E / 1.5; the material has E / (2 (1 + nu)) and
// E / (3 (1 - 2 nu)) (Landau and Lifshitz, Theory of Elasticity, section 5).
struct PoissonMiss {
  double shear_ratio = 1.0;  // shear modulus of the lattice over that of the material
  double bulk_ratio = 1.0;   // bulk modulus, the same; 0 where the material is incompressible
};
PoissonMiss poisson_miss(double poisson_ratio);

// The same of a sheet, in plane stress. The Poisson ratio of its lattice is 1/3 (see
// isotropic_sheet_stiffness()). For bulk read area: its modulus is E / (2 (1 - nu)), the tension
// that is the same in all directions of the plane over the change of area that it makes.
PoissonMiss sheet_poisson_miss(double poisson_ratio);

// How well the lattice of a model can be what it stands for, and what that costs.
struct MaterialReport {
  // Of the cells that enclose a volume: what the springs that with_material() fits to their shapes
  // leave in anisotropy(), 0 for a cube; and elongation(), length over width.
  std::size_t solid_cells = 0;
  std::size_t sheet_cells = 0;  // those that do not: 2-D
  double worst_anisotropy = 0.0;
  double median_anisotropy = 0.0;
  double worst_elongation = 1.0;
  std::size_t long_cells = 0;  // longer than kLongestIsotropicBox times their width

  std::size_t edges = 0;
  std::size_t slack_edges = 0;  // with stiffness 0: they break but carry nothing

  // Largest stable substeps of semi-implicit Euler in a tick of 1/60 s, by the springs and their
  // dampers alone: as simulated, and for S = 1, where all frequencies are sqrt(S) times as high.
  double softening = 1.0;  // S
  double substeps_per_tick = 0.0;
  double substeps_per_tick_unsoftened = 0.0;
  bool frequency_verified = false;  // else substeps are up to 65 % too many
};

inline constexpr double kReportTick = 1.0 / 60.0;  // s

// Takes about as long as with_material(). Rest positions are those the model has now.
MaterialReport material_report(const PhysicalModel& model);

// What a user should know, with the numbers; empty when there is nothing to say. Of materials
// whose Poisson ratio is more than 0.02 off that of the lattice (1/4 of solid cells, 1/3 of sheets;
// without cells there is no shear); of cells longer than springs can make up for; of
// anisotropy above 0.15 in a cell, or 0.05 in half of them; of more than 1 % slack edges; of
// softening.
std::vector<Diagnostic> modelling_notes(const PhysicalModel& model, const MaterialReport& report,
                                        std::span<const Material> materials = {});

}  // namespace limber

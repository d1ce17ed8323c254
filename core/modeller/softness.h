#pragma once

#include <optional>
#include <string>

#include "core/model/errors.h"
#include "core/model/physical_model.h"

namespace limber {

// Central forces do not keep a cell from being pushed flat and on: its mirror image is as free of
// force as the cell itself. A solid that lands too hard for its stiffness turns cells inside out.
// Contact within cells (core/contact/cell_contacts.h) turns them back, as nothing in the material
// does. What follows says it before it happens.

// Speed of sound in a bar of what the springs are, sqrt(E / rho), m/s, from the springs themselves:
// the trace A_iijj = sum k l^2 / V of the tensor of a solid of central forces is 6 E (see
// isotropic_cell_stiffness()), and V is M / rho. 0 without springs.
double bar_wave_speed(const PhysicalModel& model);

// Strain of the lowest layer under what stands on it, rho g H / E = g H / c^2.
double sag_strain(double wave_speed_m_s, double height_m, double gravity_m_s2);

// The largest strain on landing at `speed_m_s`: s + sqrt(s^2 + (v / c)^2), s the sag_strain().
// v / c is the strain behind the front that a landing bar sends up (Kolsky, Stress Waves in Solids,
// 1953), 2 s that of a load put on at once, and together they are the falling weight on a spring
// that it presses in by s H at rest (Timoshenko, Strength of Materials).
double landing_strain(double sag_strain, double speed_m_s, double wave_speed_m_s);

// The landing strain from which on cells may turn inside out: 0.85 / sqrt(layers of cells).
// Measured on hard ground with friction, on cubes of 2, 3, 4, 6, 8, 12 and 16 cells a side at sags
// of 0 to 0.2 and damping ratios of 0.05 and 0.2: it began at 0.92 to 1.5 over sqrt(layers); slabs
// at 0.97 to 1.05; columns four and more times as tall as wide bear more, 0.37 with 24 layers. (One
// layer by itself would bear 0.55 E: its upright springs pushed to nothing.)
double most_landing_strain(double layers);

struct LandingEstimate {
  double wave_speed = 0.0;   // m/s, of a bar
  double height = 0.0;       // m, along y
  double layers = 0.0;       // height over the side of a cube as large as the mean cell
  double sag_strain = 0.0;   // of its weight alone
  double strain = 0.0;       // landing_strain()
  double most_strain = 0.0;  // most_landing_strain()

  bool inverts() const { return strain > most_strain; }
  // m/s up to which it lands whole; 0 where its own weight is too much.
  double most_speed() const;
};

// Nothing for what is not all solid cells (sheets and ropes fold and unfold), nor for what is
// pinned.
std::optional<LandingEstimate> landing_estimate(const PhysicalModel& model, double speed_m_s,
                                                double gravity_m_s2);

// What a user should know before the model lands, with the numbers; nothing where it lands whole.
std::optional<Diagnostic> softness_note(const std::string& where, const PhysicalModel& model,
                                        double speed_m_s, double gravity_m_s2);

}  // namespace limber

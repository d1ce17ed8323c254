#pragma once

#include "bullet_bridge/precision.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// The decision between rigid and flexible: numbers in, decision out. Loads and strengths are
// compared as strains, so that no setting depends on size, mass or material.

// What a piece can bear.
struct PieceStrength {
  double mass = 0.0;            // kg
  double wave_speed = 0.0;      // m/s, of a bar of its lattice: sqrt(E / rho)
  double weakest_strain = 0.0;  // smallest break threshold / rest length of its live springs
};

struct SwitchSettings {
  // A piece is handed to the lattice when a load would strain it by this share of its weakest
  // spring's threshold. 0.25: a pot that strikes with its rim cracks in bending at 0.4 of the
  // strain that v / c gives (measured on the teapot), less a margin.
  double load_share = 0.25;
  // ... or by this strain whatever its strength: what a player would see (1 % of its length).
  double visible_strain = 0.01;
  // A lattice becomes rigid again when for `calm_ticks` ticks its peak load stayed below this share
  // of the threshold and its vibration below half of what makes it flexible.
  double calm_load_share = 0.5;
  // ... or changed by less than this share from tick to tick: a jammed crack may keep a spring at
  // 0.8 of its threshold for ever, at rest.
  double steady_load_share = 0.05;
  int calm_ticks = 3;
  // Time over which a load counts as sustained, s: contacts of a resting body chatter from tick to
  // tick, and only their average strains it.
  double load_time = 0.1;
};

// What the last dt counts in a running average over the time tau: 1 - exp(-dt / tau).
double averaging_share(double dt, double tau);

// Strain of a piece of mass m that meets a partner of mass M at a closing speed v: the wave of a
// collinear impact has v / c; a partner lighter than the piece shortens the contact,
// sqrt(m_red / m) with m_red = m M / (m + M), as peak force pi J / (2 t_c), t_c = pi sqrt(m_red /
// k) has it. An immovable partner has infinite mass.
double impact_strain(const PieceStrength& piece, double closing_speed, double partner_mass);

// Strain under a sustained force F over the piece's length L, without knowing its section:
// F / (E A) with E = rho c^2 and A = m / (rho L), so F L / (m c^2).
double sustained_strain(const PieceStrength& piece, double force_N, double length_m);

// Strain above which a piece has to be flexible.
double flexible_strain(const PieceStrength& piece, const SwitchSettings& settings);

// The strain that a vibration of r.m.s. speed v about the rigid motion stands for: v / c.
double vibration_strain(const PieceStrength& piece, double rms_speed);

// Ticks for which a piece of this length has to be quiet: the settings', but at least a period of
// its slowest longitudinal vibration, 2 L / c, because every vibration stands still for a moment.
int calm_ticks_needed(const PieceStrength& piece, const SwitchSettings& settings, double length_m,
                      double tick, bool touched);

// What was seen of a lattice in one tick.
struct Calmness {
  double peak_load = 0.0;         // largest stretch / threshold
  double peak_load_before = 0.0;  // in the tick before
  double rms_vibration = 0.0;     // m/s
};

// Is a lattice quiet in this tick?
bool calm(const PieceStrength& piece, const SwitchSettings& settings, const Calmness& seen);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet

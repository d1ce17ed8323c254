#pragma once

#include <limits>
#include <vector>

#include "core/environment/track.h"
#include "core/model/vec3.h"

namespace limber {

// Where a primitive acts: fully within `radius` of `centre`, fading smoothly (3 s^2 - 2 s^3) to
// nothing over `fade` beyond it. Infinite radius: everywhere. In the fading shell the flow has a
// divergence and a curl that the primitive does not have.
struct FlowBounds {
  Vec3 centre = Vec3::Zero();                               // m
  double radius = std::numeric_limits<double>::infinity();  // m, >= 0
  double fade = 0.0;                                        // m, >= 0; 0: ends at once
};

// With r the offset from `position`, across the axis for the line primitives, n = r / |r|, a and d
// the unit vectors of `axis` and `direction`, and S the `strength`. Sources: Batchelor, An
// Introduction to Fluid Dynamics (1967), sections 2.5 and 2.6, whose signs these are; Wejchert and
// Haumann, Animation Aerodynamics (SIGGRAPH 1991), whose b / r is S / (2 pi r).
enum class FlowKind {
  kUniform,      // v = S d; S in m/s
  kLineSource,   // v = S / (2 pi r) n; S in m^2/s, what flows out per length; < 0: a sink
  kPointSource,  // v = S / (4 pi r^2) n; S in m^3/s, what flows out; < 0: a sink
  kLineVortex,   // v = S / (2 pi r) a x n: right-handed about the axis; S in m^2/s, the circulation
  // Limit of a source at r = h d and a sink at r = 0 with S = h x the source's strength. Of a line
  // doublet only the part of d across the axis counts, d' = d - (d . a) a.
  kLineDoublet,   // v = S / (2 pi r^2) (2 (d' . n) n - d'); S in m^3/s
  kPointDoublet,  // v = S / (4 pi r^3) (3 (d . n) n - d); S in m^4/s
};

// One flow primitive. Inside of the core radius, where the formulas have their pole, the velocity
// falls smoothly to zero: see regularised_pole(). Outside they are exact.
struct FlowPrimitive {
  FlowKind kind = FlowKind::kUniform;
  Track<Vec3> position = Vec3(Vec3::Zero());  // m, a point of the axis
  Vec3 axis = Vec3::UnitZ();                  // of the line primitives; any length but zero
  Vec3 direction = Vec3::UnitX();             // of uniform flow and doublets; any length but zero
  Track<double> strength = 0.0;
  double core_radius = 0.01;  // m, > 0
  FlowBounds bounds;          // moves with nothing: world coordinates
};

// Their superposition.
struct FlowField {
  std::vector<FlowPrimitive> primitives;
};

// Uniform flow of this velocity, m/s, which may be zero.
FlowPrimitive uniform_flow(const Vec3& velocity);

// 1/r^p outside of the core radius R. Inside R^-p s^q (1 + (p + q)/2 (1 - s^2)) with s = r/R: has
// the same value and slope at R, and falls to zero as r^q. q is 1 for sources and vortices and 2
// for doublets, which makes the velocity a polynomial in the coordinates there, without a kink at
// the centre. A source (vortex) then is its strength spread over the core with a density
// proportional to 1 - s^2. At most 1.25 R^-p. Unit m^-p.
double regularised_pole(double r, double core_radius, int p, int q);

// 1 where the bounds let a primitive act fully, 0 where not at all.
double share_within(const FlowBounds& bounds, const Vec3& at);

// Velocity of the air, m/s. `at` in world coordinates, m; `time` in s.
Vec3 flow_velocity(const FlowPrimitive& primitive, const Vec3& at, double time);
Vec3 flow_velocity(const FlowField& field, const Vec3& at, double time);

// Throws InputError for a primitive that has no direction, no core, or keys out of order, and for
// numbers that are not finite.
void require_valid(const FlowField& field);

}  // namespace limber

#pragma once

#include "core/model/physical_model.h"
#include "tests/bridge/models.h"

// What the scenes are made of. Blocks: make_block() of tests/bridge/models.h.

namespace limber::bullet::test {

inline constexpr double kCushionSide = 0.5;  // m
inline constexpr double kCushionMass = 1.0;  // kg

// Six points a side; 1 % lower under its own weight.
PhysicalModel cushion(const Vec3& centre);

// 1 kg in a cube of this side, with the damping of a rubber toy.
Block toy_block(double side_m, int cells, double modulus_Pa);

struct SquareSheet {
  double side = 1.0;               // m, horizontal
  int cells = 20;                  // along a side
  double mass = 1.0;               // kg
  double stretch_stiffness = 1e5;  // N/m: modulus times thickness
  double strain_at_break = kUnbreakable;
  bool pinned_border = true;
};
PhysicalModel make_sheet(const SquareSheet& sheet, const Vec3& centre);

// 0.25 kg/m along x, a point every 5 cm.
PhysicalModel make_rope(const Vec3& centre, double length_m);

// Upright: 0.4 m long, one cell of 2 cm thick, 0.1 kg.
PhysicalModel make_needle(const Vec3& lower_end, double tilt_rad = 0.0);

}  // namespace limber::bullet::test

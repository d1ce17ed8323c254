#pragma once

#include <array>
#include <string>

#include "bullet_bridge/co_simulation.h"
#include "core/dynamics/lattice.h"
#include "core/modeller/box_lattice.h"
#include "core/modeller/material.h"

namespace limber::bullet::test {

// A block about the origin. The default is 4 x 4 x 4 points in a cube of 0.3 m and 8 kg, whose
// stable step is a little above 1 / (60 * 256) s.
struct Block {
  std::array<int, 3> cells = {3, 3, 3};
  double spacing = 0.1;  // m
  double mass = 8.0;     // kg
  double modulus = 2e7;  // Pa
  double strain_at_break = kUnbreakable;
  double damping_ratio = 0.02;
  double internal_damping = 0.0;  // 1/s
  double friction = 0.5;
  double restitution = 0.0;

  Vec3 size() const { return spacing * Vec3(cells[0], cells[1], cells[2]); }
  double wave_speed() const { return std::sqrt(modulus * size().prod() / mass); }  // m/s
};

inline PhysicalModel make_block(const Block& block, const Vec3& centre,
                                const Vec3& velocity = Vec3::Zero(),
                                const Vec3& omega = Vec3::Zero()) {
  Material material;
  material.density = block.mass / block.size().prod();
  material.youngs_modulus = block.modulus;
  material.strain_at_break = block.strain_at_break;
  material.damping_ratio = block.damping_ratio;
  material.internal_damping = block.internal_damping;
  material.friction = block.friction;
  material.restitution = block.restitution;
  PhysicalModel model = with_material(
      box_lattice(block.cells, Vec3::Constant(block.spacing), -0.5 * block.size(), "block"),
      "block", material);
  place(model, Mat3::Identity(), centre);
  set_in_motion(model, velocity, omega);
  return model;
}

// The setting that makes a lattice take substeps of `substep` s, which must be stable. A little
// more: a tick that is a float may be longer than the double by 1e-7.
inline double step_scale_for(const PhysicalModel& model, double substep) {
  Lattice lattice;
  add_object(lattice, model);
  return substep / lattice.objects[0].largest_step * (1.0 + 1e-6);
}

inline CoSimulationSettings settings_for(Representation representation, double step_scale = 1.0) {
  CoSimulationSettings settings;
  settings.representation = representation;
  settings.step_scale = step_scale;
  return settings;
}

}  // namespace limber::bullet::test

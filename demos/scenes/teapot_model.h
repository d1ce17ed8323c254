#pragma once

#include <cstdint>

#include "core/model/physical_model.h"

namespace limber::demos {

// A ceramic Utah teapot. The defaults are those of the scene `tipsy_teapot`.
struct TeapotOptions {
  double spacing = 0.0075;        // m, of neighbouring points
  double wall_thickness = 0.005;  // m
  double density = 2400.0;        // kg/m^3
  double softening = 2000.0;      // real modulus / simulated modulus, see Material
  std::uint64_t seed = 1;         // of the flaws
};

// The teapot as one model of the parts body, lid, spout and handle, glued together: 0.25 m from
// handle to spout, standing on y = 0 around the y axis, the spout towards +x.
PhysicalModel teapot_model(const TeapotOptions& options = {});

}  // namespace limber::demos

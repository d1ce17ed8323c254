#pragma once

#include <optional>

#include "core/environment/flow_field.h"
#include "core/environment/ground.h"

namespace limber {

// The air: what faces with a drag coefficient feel. Density 1.225 kg/m^3: the International
// Standard Atmosphere (ISO 2533) at sea level, 15 degrees C.
struct Air {
  double density = 1.225;  // kg/m^3
  FlowField wind = {};     // none: still air, which resists all the same
};

// What a scene puts objects into. Parts it does not have cost nothing.
struct Environment {
  Vec3 gravity = Vec3::Zero();  // m/s^2
  std::optional<Air> air = {};
  std::optional<Ground> ground = {};
};

inline const Environment kEmptySpace{};

// Throws InputError for what is not finite, a negative density, and what the parts object to.
void require_valid(const Environment& environment);

}  // namespace limber

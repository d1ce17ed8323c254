#include "core/environment/ground.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "core/model/diagnostic_list.h"
#include "core/model/errors.h"

namespace limber {
namespace {

void require(bool holds, const std::string& what, const std::string& remedy) {
  if (!holds) throw InputError({"ground", what, remedy});
}

bool finite_from(double least, double x) { return std::isfinite(x) && x >= least; }

}  // namespace

double ground_force(const Ground& ground, double depth, double depth_rate) {
  assert(std::isfinite(ground.stiffness));
  if (depth <= 0.0) return 0.0;
  const double force = ground.stiffness * depth + ground.damping * depth_rate;
  return ground.adhesive ? force : std::max(force, 0.0);
}

void require_valid(const Ground& ground) {
  // A normal of float precision passes; a wrong one does not.
  require(std::abs(ground.normal.norm() - 1.0) < 1e-6,
          say("length of its normal is ", ground.normal.norm()), "give it a unit vector");
  require(std::isfinite(ground.height), say("height is ", ground.height, " m"),
          "give it a finite one");
  require(ground.stiffness > 0.0, say("stiffness is ", ground.stiffness, " N/m"),
          "give it one above 0; infinity for a hard ground");
  require(finite_from(0.0, ground.damping), say("damping is ", ground.damping, " N s/m"),
          "give it a finite one, 0 or more");
  require(std::isfinite(ground.stiffness) || ground.damping == 0.0, "is hard and has damping",
          "give it a finite stiffness or no damping");
  require(finite_from(0.0, ground.kinetic_friction) &&
              finite_from(ground.kinetic_friction, ground.static_friction),
          say("friction is ", ground.static_friction, " at rest and ", ground.kinetic_friction,
              " sliding"),
          "give both 0 or more, and at rest no less than sliding");
}

}  // namespace limber

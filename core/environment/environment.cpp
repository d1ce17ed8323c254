#include "core/environment/environment.h"

#include <cmath>

#include "core/model/diagnostic_list.h"
#include "core/model/errors.h"

namespace limber {
namespace {

void require_valid(const Air& air) {
  if (!std::isfinite(air.density) || air.density < 0.0) {
    throw InputError(
        {"air", say("density is ", air.density, " kg/m^3"), "give it a finite one, 0 or more"});
  }
  require_valid(air.wind);
}

}  // namespace

void require_valid(const Environment& environment) {
  if (!environment.gravity.allFinite()) {
    throw InputError({"environment", "gravity is not finite", "give it finite numbers, m/s^2"});
  }
  if (environment.air) require_valid(*environment.air);
  if (environment.ground) require_valid(*environment.ground);
}

}  // namespace limber

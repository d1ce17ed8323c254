#include "core/modeller/shape_checks.h"

#include <cmath>

#include "core/model/diagnostic_list.h"
#include "core/model/errors.h"

namespace limber {

void require_positive(const std::string& where, const std::string& quantity, double value,
                      const std::string& unit) {
  if (std::isfinite(value) && value > 0.0) return;
  throw InputError({where, say(quantity, " is ", value, " ", unit), "give a finite value above 0"});
}

void require_at_least(const std::string& where, const std::string& what, int count, int least) {
  if (count >= least) return;
  throw InputError({where, say("there are ", count, " ", what), say("give at least ", least)});
}

void require_affordable(const std::string& where, double count, const std::string& remedy) {
  if (count <= kMostShapePoints) return;
  throw InputError(
      {where, say("it would have about ", count, " points, more than ", kMostShapePoints), remedy});
}

void require_finite(const std::string& where, const std::string& what, const Vec3& value_m) {
  if (value_m.allFinite()) return;
  throw InputError({where,
                    say(what, " is (", value_m.x(), ", ", value_m.y(), ", ", value_m.z(), ") m"),
                    "give finite coordinates"});
}

}  // namespace limber

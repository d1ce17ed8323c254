#include "demos/render/pov_text.h"

#include <fmt/format.h>

#include <cmath>

#include "core/model/errors.h"

namespace limber::demos {

std::string pov(double number) {
  if (std::isfinite(number)) return fmt::format("{:.6g}", number);
  throw SimulationError({"picture", "a position or a colour is not a finite number",
                         "render an earlier time, before the simulation blew up"});
}

std::string pov(const Vec3& v) {
  return fmt::format("<{},{},{}>", pov(v.x()), pov(v.y()), pov(v.z()));
}

std::string pov_colour(const Vec3& linear) {
  return "rgb " + pov(Vec3(linear.cwiseMax(0.0).cwiseMin(1.0)));
}

}  // namespace limber::demos

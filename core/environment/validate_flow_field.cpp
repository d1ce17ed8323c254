#include <cmath>
#include <string>

#include "core/environment/flow_field.h"
#include "core/model/diagnostic_list.h"
#include "core/model/errors.h"

// What a scene's author may have got wrong in a wind.

namespace limber {
namespace {

void require(bool holds, const std::string& where, const std::string& what,
             const std::string& remedy) {
  if (!holds) throw InputError({where, what, remedy});
}

bool is_finite(double x) { return std::isfinite(x); }
bool is_finite(const Vec3& v) { return v.allFinite(); }

template <class T>
void require_valid(const Track<T>& track, const std::string& where, const std::string& name) {
  require(!track.keys.empty(), where, name + " has no keys", "give it at least one");
  for (std::size_t k = 0; k < track.keys.size(); ++k) {
    const auto& key = track.keys[k];
    require(std::isfinite(key.time) && is_finite(key.value), where,
            say(name, ": key ", k, " is not finite"), "give it finite numbers");
    require(k == 0 || track.keys[k - 1].time < key.time, where,
            say(name, ": key ", k, " at ", key.time, " s does not come after the one before"),
            "sort the keys by time, one at each time");
  }
}

bool is_direction(const Vec3& v) { return v.allFinite() && v.norm() > 0.0; }

bool has_axis(FlowKind kind) {
  return kind == FlowKind::kLineSource || kind == FlowKind::kLineVortex ||
         kind == FlowKind::kLineDoublet;
}

bool has_direction(FlowKind kind) {
  return kind == FlowKind::kUniform || kind == FlowKind::kLineDoublet ||
         kind == FlowKind::kPointDoublet;
}

void require_directions(const FlowPrimitive& primitive, const std::string& where) {
  require(!has_axis(primitive.kind) || is_direction(primitive.axis), where, "has no axis",
          "give it a finite one of any length but zero");
  require(!has_direction(primitive.kind) || is_direction(primitive.direction), where,
          "has no direction", "give it a finite one of any length but zero");
  if (primitive.kind != FlowKind::kLineDoublet) return;
  const Vec3 direction = primitive.direction.normalized();
  require(direction.cross(primitive.axis.normalized()).norm() > 1e-12, where,
          "is a line doublet with its direction along its axis, which moves nothing",
          "give it a direction across the axis");
}

void require_valid(const FlowBounds& bounds, const std::string& where) {
  require(bounds.centre.allFinite(), where, "centre of its bounds is not finite",
          "give it finite coordinates");
  require(bounds.radius >= 0.0, where, say("radius of its bounds is ", bounds.radius, " m"),
          "give it 0 or more; infinity for everywhere");
  require(std::isfinite(bounds.fade) && bounds.fade >= 0.0, where,
          say("fade of its bounds is ", bounds.fade, " m"), "give it a finite length, 0 or more");
}

}  // namespace

void require_valid(const FlowField& field) {
  for (std::size_t i = 0; i < field.primitives.size(); ++i) {
    const FlowPrimitive& primitive = field.primitives[i];
    const std::string where = say("wind: primitive ", i);
    require_valid(primitive.position, where, "position");
    require_valid(primitive.strength, where, "strength");
    require_directions(primitive, where);
    require(std::isfinite(primitive.core_radius) && primitive.core_radius > 0.0, where,
            say("core radius is ", primitive.core_radius, " m"), "give it a finite one above 0");
    require_valid(primitive.bounds, where);
  }
}

}  // namespace limber

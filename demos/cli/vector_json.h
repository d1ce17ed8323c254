#pragma once

#include <nlohmann/json.hpp>

#include "core/model/vec3.h"

namespace limber::demos {

inline nlohmann::ordered_json vector_json(const Vec3& v) {
  return nlohmann::ordered_json::array({v.x(), v.y(), v.z()});
}

}  // namespace limber::demos

#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "core/model/vec3.h"

namespace limber::reference {

using Json = nlohmann::json;

Vec3 vec3(const Json& numbers);                  // [x, y, z]
Mat3 mat3(const Json& rows);                     // three rows of three
Vec3 gravity_of(const Json& params);             // "g" in -z, m/s^2
Json to_json(const Vec3& vector);                // [x, y, z]
Json to_json(const Mat3& matrix);                // rows
Json to_json(const std::vector<Vec3>& vectors);  // a row each

}  // namespace limber::reference

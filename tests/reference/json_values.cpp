#include "tests/reference/json_values.h"

#include <array>

namespace limber::reference {

Vec3 vec3(const Json& numbers) {
  const auto xyz = numbers.get<std::array<double, 3>>();
  return {xyz[0], xyz[1], xyz[2]};
}

Mat3 mat3(const Json& rows) {
  Mat3 m;
  for (int row = 0; row < 3; ++row) m.row(row) = vec3(rows.at(row)).transpose();
  return m;
}

Vec3 gravity_of(const Json& params) { return {0.0, 0.0, -params.at("g").get<double>()}; }

Json to_json(const Vec3& vector) { return {vector.x(), vector.y(), vector.z()}; }

Json to_json(const Mat3& matrix) {
  Json rows = Json::array();
  for (int row = 0; row < 3; ++row) rows.push_back(to_json(Vec3(matrix.row(row))));
  return rows;
}

Json to_json(const std::vector<Vec3>& vectors) {
  Json rows = Json::array();
  for (const Vec3& v : vectors) rows.push_back(to_json(v));
  return rows;
}

}  // namespace limber::reference

#include "tests/reference/score.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace limber::reference {
namespace {

using Json = nlohmann::json;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTiny = 1e-300;  // least scale: 0 is met by 0 alone

struct Array {
  std::vector<std::size_t> shape;
  std::vector<double> values;  // last index fastest
};

std::optional<Array> array_of(const Json& json) {
  if (json.is_number()) return Array{{}, {json.get<double>()}};
  if (json.is_boolean()) return Array{{}, {json.get<bool>() ? 1.0 : 0.0}};
  if (!json.is_array()) return std::nullopt;
  Array all{{json.size()}, {}};
  for (std::size_t i = 0; i < json.size(); ++i) {
    const std::optional<Array> item = array_of(json[i]);
    if (!item) return std::nullopt;
    if (i == 0) all.shape.insert(all.shape.end(), item->shape.begin(), item->shape.end());
    if (!std::equal(item->shape.begin(), item->shape.end(), all.shape.begin() + 1, all.shape.end()))
      return std::nullopt;
    all.values.insert(all.values.end(), item->values.begin(), item->values.end());
  }
  return all;
}

bool is_list_of_numbers(const Json& json, std::size_t size) {
  return json.is_array() && json.size() == size &&
         std::all_of(json.begin(), json.end(), [](const Json& item) { return item.is_number(); });
}

bool is_text_list(const Json& json) {
  return json.is_array() && !json.empty() && json[0].is_string();
}

double largest_magnitude(const std::vector<double>& values) {
  double largest = 0.0;
  for (double v : values) largest = std::max(largest, std::abs(v));
  return largest;
}

std::string column_scale(const Json& tolerance, std::size_t column) {
  if (!tolerance.contains("column_scale")) return "";
  const Json& scales = tolerance["column_scale"];
  return column < scales.size() && scales[column].is_string() ? scales[column] : "";
}

double error_by_column(const Array& value, const Array& reference, const Json& tolerance) {
  if (reference.shape.size() != 2) return kInfinity;
  double worst = 0.0;
  for (std::size_t i = 0; i < reference.values.size(); ++i) {
    const std::string by = column_scale(tolerance, i % reference.shape[1]);
    if (by == "-") continue;
    const double scale = by == "one" ? 1.0 : std::max(std::abs(reference.values[i]), kTiny);
    worst = std::max(worst, std::abs(value.values[i] - reference.values[i]) / scale);
  }
  return worst;
}

double error_of_arrays(const Array& value, const Array& reference, const Json& tolerance) {
  const std::string kind = tolerance.at("kind");
  if (value.shape != reference.shape) return kInfinity;
  std::vector<double> distance;
  for (std::size_t i = 0; i < reference.values.size(); ++i) {
    distance.push_back(value.values[i] - reference.values[i]);
    if (!std::isfinite(distance.back())) return kInfinity;
  }
  const double largest = largest_magnitude(distance);
  if (kind == "exact") return largest == 0.0 ? 0.0 : kInfinity;
  if (kind == "abs") return largest;
  if (tolerance.value("per_column", false)) return error_by_column(value, reference, tolerance);
  const double scale = tolerance.value("scale", largest_magnitude(reference.values));
  return largest / std::max(scale, kTiny);
}

double error_of_parts(const Json& value, const Json& reference, const Json& tolerance) {
  double worst = 0.0;
  for (const auto& [name, part] : reference.items()) {
    if (!value.is_object() || !value.contains(name)) return kInfinity;
    worst = std::max(worst, error_of(value[name], part, tolerance));
  }
  return worst;
}

}  // namespace

double error_of(const Json& value, const Json& reference, const Json& tolerance) {
  if (reference.is_object()) return error_of_parts(value, reference, tolerance);
  if (tolerance.at("kind") == "exact" && is_text_list(reference)) {
    return value == reference ? 0.0 : kInfinity;
  }
  const std::optional<Array> x = array_of(value), r = array_of(reference);
  return x && r ? error_of_arrays(*x, *r, tolerance) : kInfinity;
}

Json group_sums(const Json& values, const Json& keys) {
  constexpr double kEqual = 1e-6;
  Json sums = Json::array();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double value = values.at(i), key = keys.at(i);
    const bool is_new = i == 0 || key - keys.at(i - 1).get<double>() > kEqual * std::abs(key);
    if (is_new) sums.push_back(0.0);
    sums.back() = sums.back().get<double>() + value;
  }
  return sums;
}

double error_of_quantity(const std::string& name, const Json& found, const Json& expected) {
  const Json& wanted = expected.at(name);
  const Json& tolerance = wanted.at("tol");
  const std::string how = wanted.value("how", "");
  if (how.find("compare group sums") == std::string::npos) {
    return error_of(found.at(name), wanted.at("value"), tolerance);
  }
  const Json& keys = expected.at("mode_omega").at("value");
  if (!is_list_of_numbers(found.at(name), keys.size())) return kInfinity;
  return error_of(group_sums(found.at(name), keys), group_sums(wanted.at("value"), keys),
                  tolerance);
}

Grade grade(double error, const Json& tolerance) {
  if (tolerance.at("good").is_null()) return Grade::kInformation;
  if (error <= tolerance.at("excellent").get<double>()) return Grade::kExcellent;
  return error <= tolerance.at("good").get<double>() ? Grade::kGood : Grade::kFailure;
}

}  // namespace limber::reference

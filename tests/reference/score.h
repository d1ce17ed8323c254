#pragma once

#include <nlohmann/json.hpp>

namespace limber::reference {

// How well a computed quantity agrees with the expected one.
enum class Grade { kExcellent, kGood, kFailure, kInformation };

// Distance between a value and its reference by the rules of a case file's tolerance, which
// tests/data/README.md explains; infinity when shapes differ, something is not finite or no number.
double error_of(const nlohmann::json& value, const nlohmann::json& reference,
                const nlohmann::json& tolerance);

Grade grade(double error, const nlohmann::json& tolerance);

}  // namespace limber::reference

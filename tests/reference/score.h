#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace limber::reference {

// How well a computed quantity agrees with the expected one.
enum class Grade { kExcellent, kGood, kFailure, kInformation };

// Distance between a value and its reference by the rules of a case file's tolerance, which
// tests/data/README.md explains; infinity when shapes differ, something is not finite or no number.
double error_of(const nlohmann::json& value, const nlohmann::json& reference,
                const nlohmann::json& tolerance);

// Values added up over groups of neighbours with equal keys, relative to 1e-6: what is defined of
// the modes of one frequency together, not of each, as any basis of theirs is as good. Keys ascend.
nlohmann::json group_sums(const nlohmann::json& values, const nlohmann::json& keys);

// error_of() for one quantity of a case that `found` has. Where its `how` says "compare group
// sums", groups are those of equal "mode_omega" among the expected quantities.
double error_of_quantity(const std::string& name, const nlohmann::json& found,
                         const nlohmann::json& expected);

Grade grade(double error, const nlohmann::json& tolerance);

}  // namespace limber::reference

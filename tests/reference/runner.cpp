#include "tests/reference/runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace limber::reference {
namespace {

bool all_finite(const Json& value) {
  if (value.is_number_float()) return std::isfinite(value.get<double>());
  if (!value.is_structured()) return !value.is_null();
  return std::all_of(value.begin(), value.end(), [](const Json& item) { return all_finite(item); });
}

bool is_asked_for(const Json& quantity) {
  if (is_input(quantity)) return false;
  const Json* tolerance = quantity.contains("tol") ? &quantity["tol"] : nullptr;
  return tolerance && tolerance->contains("good") && !(*tolerance)["good"].is_null();
}

Outcome not_run(const std::string& reason) { return {nullptr, {reason}}; }

Outcome checked(Json quantities, const Json& expected) {
  Outcome outcome;
  outcome.quantities = Json::object();
  for (auto& [name, value] : quantities.items()) {
    if (all_finite(value)) {
      outcome.quantities[name] = std::move(value);
    } else {
      outcome.left_out.push_back(name + ": is not finite");
    }
  }
  for (const auto& [name, quantity] : expected.items()) {
    if (is_asked_for(quantity) && !quantities.contains(name)) {
      outcome.left_out.push_back(name + ": its kind does not compute it");
    }
  }
  return outcome;
}

}  // namespace

Outcome run_case(const CaseRecord& record) {
  const std::string kind = kind_of(record.id);
  const auto found = all_kinds().find(kind);
  if (found == all_kinds().end()) return not_run(fmt::format("there is no kind '{}'", kind));
  try {
    return checked(found->second(record.input), record.expected);
  } catch (const std::exception& error) {
    return not_run(error.what());
  }
}

}  // namespace limber::reference

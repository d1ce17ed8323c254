#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/analysis/stability_atlas.h"

// The stability atlas in words and numbers: docs/stability.md says what they mean.
namespace limber::demos {

bool is_of(const Scheme& scheme, const Scheme& other);  // the same one, by name

struct SchemeSummary {
  Scheme scheme;
  std::array<std::size_t, 5> outcomes = {};  // by StabilityOutcome
  std::size_t cases = 0;
  std::size_t violations = 0;
  // measured / analytic limit, over all damping and mass ratios
  double least_share = 0.0, largest_share = 0.0;
};

std::vector<SchemeSummary> summaries_of(const StabilityAtlas& atlas);
std::size_t violations_in(const StabilityAtlas& atlas);

std::string stability_report(const StabilityAtlas& atlas);
std::string stability_json(const StabilityAtlas& atlas);

// Tables with a header, a row each.
std::string cases_csv(const StabilityAtlas& atlas);
std::string limits_csv(const std::vector<LimitSample>& samples, const char* at);
std::string frequency_csv(const std::vector<FrequencySample>& samples);

}  // namespace limber::demos

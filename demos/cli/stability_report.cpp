#include "demos/cli/stability_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "demos/cli/text_table.h"

namespace limber::demos {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kOutcomes = {StabilityOutcome::kStable, StabilityOutcome::kGrew,
                                  StabilityOutcome::kStopped, StabilityOutcome::kRefused,
                                  StabilityOutcome::kFailed};
constexpr std::array kShownDamping = {0.01, 0.1, 1.0, 10.0, 100.0};

void widen(SchemeSummary& summary, const std::vector<LimitSample>& samples) {
  for (const LimitSample& l : samples) {
    const double share = l.measured / l.analytic;
    if (!is_of(l.scheme, summary.scheme) || !std::isfinite(share)) continue;
    summary.least_share = std::min(summary.least_share, share);
    summary.largest_share = std::max(summary.largest_share, share);
  }
}

SchemeSummary summary_of(const Scheme& scheme, const StabilityAtlas& atlas) {
  SchemeSummary summary{.scheme = scheme};
  for (const StabilityResult& r : atlas.cases) {
    if (!is_of(r.tried.scheme, scheme)) continue;
    ++summary.cases;
    ++summary.outcomes[static_cast<std::size_t>(r.outcome)];
    summary.violations += r.violation.empty() ? 0 : 1;
  }
  summary.least_share = std::numeric_limits<double>::infinity();
  summary.largest_share = -std::numeric_limits<double>::infinity();
  widen(summary, atlas.damping);
  widen(summary, atlas.mass_ratio);
  return summary;
}

std::string range_text(const SchemeSummary& summary) {
  if (summary.largest_share < summary.least_share) return "no limit";
  return fmt::format("{:.3f} to {:.3f}", summary.least_share, summary.largest_share);
}

std::string outcome_table(const StabilityAtlas& atlas) {
  TextTable table;
  std::vector<std::string> head = {"", "cases"};
  for (StabilityOutcome outcome : kOutcomes) head.push_back(name_of(outcome));
  head.insert(head.end(), {"limit found / analytic", "violations"});
  table.add_row(std::move(head));
  for (const SchemeSummary& summary : summaries_of(atlas)) {
    std::vector<std::string> row = {summary.scheme.name, grouped(summary.cases)};
    for (std::size_t count : summary.outcomes) row.push_back(grouped(count));
    row.insert(row.end(), {range_text(summary), grouped(summary.violations)});
    table.add_row(std::move(row));
  }
  return table.text();
}

// Of the sample nearest to the ratio.
std::string limit_text(const StabilityAtlas& atlas, const Scheme& scheme, double ratio) {
  const LimitSample* nearest = nullptr;
  const auto distance = [&](const LimitSample& l) { return std::abs(std::log(l.at / ratio)); };
  for (const LimitSample& l : atlas.damping) {
    if (!is_of(l.scheme, scheme)) continue;
    if (!nearest || distance(l) < distance(*nearest)) nearest = &l;
  }
  return nearest && std::isfinite(nearest->measured) ? significant(nearest->measured) : "any";
}

std::string limit_table(const StabilityAtlas& atlas) {
  TextTable table;
  std::vector<std::string> head = {"largest stable omega dt at damping ratio"};
  for (double ratio : kShownDamping) head.push_back(significant(ratio));
  table.add_row(std::move(head));
  for (const Scheme& scheme : schemes()) {
    std::vector<std::string> row = {scheme.name};
    for (double ratio : kShownDamping) row.push_back(limit_text(atlas, scheme, ratio));
    table.add_row(std::move(row));
  }
  return table.text();
}

const char* name_of(StabilityModel model) {
  constexpr std::array kNames = {"oscillator", "chain", "block"};
  return kNames[static_cast<std::size_t>(model)];
}

const char* name_of(ShapeDefect defect) {
  constexpr std::array kNames = {"none", "inside out", "one inverted",
                                 "flat", "coincident", "one place"};
  return kNames[static_cast<std::size_t>(defect)];
}

const char* name_of(Motion motion) {
  constexpr std::array kNames = {"translation", "spin", "scatter"};
  return kNames[static_cast<std::size_t>(motion)];
}

const char* name_of(StepChoice choice) {
  constexpr std::array kNames = {"share", "seconds", "automatic"};
  return kNames[static_cast<std::size_t>(choice)];
}

std::string described(const StabilityResult& r) {
  const StabilityCase& c = r.tried;
  return fmt::format(
      "{}: {}, {}, {:.4g} N/m, damping ratio {:.4g}, mass ratio {:.4g}, {:.4g} m, at {:.4g} m, "
      "{} at {:.4g} m/s, defect {}, contacts {}, step {:.6g} s, limit {:.6g} s: {}",
      c.sweep, c.scheme.name, name_of(c.model), c.stiffness, c.damping_ratio, c.mass_ratio, c.size,
      c.place, name_of(c.motion), c.speed, name_of(c.defect), c.contacts ? "on" : "off", r.step,
      r.limit, r.violation);
}

std::string violation_list(const StabilityAtlas& atlas) {
  std::string text;
  for (const StabilityResult& r : atlas.cases) {
    if (!r.violation.empty()) text += "  " + described(r) + "\n";
  }
  return text.empty() ? text : "\nviolations\n" + text;
}

// JSON knows neither infinity nor NaN.
Json or_null(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json limits_json(const std::vector<LimitSample>& samples, const Scheme& scheme) {
  Json list = Json::array();
  for (const LimitSample& l : samples) {
    if (!is_of(l.scheme, scheme)) continue;
    list.push_back(
        {{"at", l.at}, {"analytic", or_null(l.analytic)}, {"measured", or_null(l.measured)}});
  }
  return list;
}

Json frequency_json(const std::vector<FrequencySample>& samples, const Scheme& scheme) {
  Json list = Json::array();
  for (const FrequencySample& f : samples) {
    if (!is_of(f.scheme, scheme)) continue;
    list.push_back({{"omega_step", f.omega_step},
                    {"frequency_error_rel", or_null(f.frequency_error)},
                    {"factor_per_step", or_null(f.factor)}});
  }
  return list;
}

Json scheme_json(const SchemeSummary& summary, const StabilityAtlas& atlas) {
  Json json = {{"name", summary.scheme.name}, {"cases", summary.cases}};
  for (StabilityOutcome outcome : kOutcomes) {
    json[name_of(outcome)] = summary.outcomes[static_cast<std::size_t>(outcome)];
  }
  json["violations"] = summary.violations;
  json["least_limit_rel"] = or_null(summary.least_share);
  json["largest_limit_rel"] = or_null(summary.largest_share);
  json["damping_ratio"] = limits_json(atlas.damping, summary.scheme);
  json["mass_ratio"] = limits_json(atlas.mass_ratio, summary.scheme);
  json["undamped"] = frequency_json(atlas.frequency, summary.scheme);
  return json;
}

std::string csv_number(double x) { return std::isfinite(x) ? fmt::format("{:.9g}", x) : ""; }

// RFC 4180.
std::string csv_text(const std::string& text) {
  std::string quoted = "\"";
  for (char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string case_row(const StabilityResult& r) {
  const StabilityCase& c = r.tried;
  std::string row =
      fmt::format("{},{},{}", csv_text(c.sweep), csv_text(c.scheme.name), name_of(c.model));
  for (double x : {c.stiffness, c.damping_ratio, c.mass_ratio, c.size, c.place, c.speed}) {
    row += ',' + csv_number(x);
  }
  row += fmt::format(",{},{},{},{}", name_of(c.motion), name_of(c.defect), c.contacts ? 1 : 0,
                     name_of(c.choice));
  for (double x : {r.step, r.limit, r.growth}) row += ',' + csv_number(x);
  return row +
         fmt::format(",{},{},{}\n", name_of(r.outcome), csv_text(r.message), csv_text(r.violation));
}

}  // namespace

bool is_of(const Scheme& scheme, const Scheme& other) {
  return std::strcmp(scheme.name, other.name) == 0;
}

std::vector<SchemeSummary> summaries_of(const StabilityAtlas& atlas) {
  std::vector<SchemeSummary> summaries;
  for (const Scheme& scheme : schemes()) summaries.push_back(summary_of(scheme, atlas));
  return summaries;
}

std::size_t violations_in(const StabilityAtlas& atlas) {
  return static_cast<std::size_t>(std::ranges::count_if(
      atlas.cases, [](const StabilityResult& r) { return !r.violation.empty(); }));
}

std::string stability_report(const StabilityAtlas& atlas) {
  return outcome_table(atlas) + "\n" + limit_table(atlas) + violation_list(atlas);
}

std::string stability_json(const StabilityAtlas& atlas) {
  Json json = {{"cases", atlas.cases.size()}, {"violations", Json::array()}};
  for (const StabilityResult& r : atlas.cases) {
    if (!r.violation.empty()) json["violations"].push_back(described(r));
  }
  json["integrators"] = Json::array();
  for (const SchemeSummary& summary : summaries_of(atlas)) {
    json["integrators"].push_back(scheme_json(summary, atlas));
  }
  return json.dump(2) + "\n";
}

std::string cases_csv(const StabilityAtlas& atlas) {
  std::string text =
      "sweep,integrator,model,stiffness_N_m,damping_ratio,mass_ratio,size_m,place_m,speed_m_s,"
      "motion,defect,contacts,step_choice,step_s,limit_s,growth,outcome,message,violation\n";
  for (const StabilityResult& r : atlas.cases) text += case_row(r);
  return text;
}

std::string limits_csv(const std::vector<LimitSample>& samples, const char* at) {
  std::string text = fmt::format("integrator,{},analytic_omega_step,measured_omega_step\n", at);
  for (const LimitSample& l : samples) {
    text += fmt::format("{},{},{},{}\n", csv_text(l.scheme.name), csv_number(l.at),
                        csv_number(l.analytic), csv_number(l.measured));
  }
  return text;
}

std::string frequency_csv(const std::vector<FrequencySample>& samples) {
  std::string text = "integrator,omega_step,frequency_error_rel,factor_per_step\n";
  for (const FrequencySample& f : samples) {
    text += fmt::format("{},{},{},{}\n", csv_text(f.scheme.name), csv_number(f.omega_step),
                        csv_number(f.frequency_error), csv_number(f.factor));
  }
  return text;
}

}  // namespace limber::demos

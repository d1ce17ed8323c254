#include "demos/cli/report_json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "demos/cli/vector_json.h"

namespace limber::demos {
namespace {

using Json = nlohmann::ordered_json;

template <class Number>
Json or_null(const std::optional<Number>& value) {
  return value ? Json(*value) : Json(nullptr);
}

// Names come from the scene's author: a wrong byte must not cost the result of a long run.
std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json ledger_json(const RunResult& run) {
  const LedgerTotals& l = run.ledger;
  const bool any = run.to_flexible + run.to_rigid > 0;
  const auto defect = [any](double value) { return any ? Json(value) : Json(nullptr); };
  return {{"momentum_rel", defect(l.momentum_rel)},
          {"angular_momentum_rel", defect(l.angular_momentum_rel)},
          {"energy_in_J", l.energy_in_J},
          {"energy_out_J", l.energy_out_J},
          {"energy_stored_J", l.energy_stored_J},
          {"energy_discarded_J", l.energy_discarded_J},
          {"energy_unaccounted_rel", defect(l.energy_unaccounted_rel)}};
}

Json body_json(const BodySummary& body) {
  return {{"name", body.name},
          {"representation", body.representation},
          {"mass_kg", body.mass_kg},
          {"com_m", vector_json(body.centre_of_mass)},
          {"velocity_m_s", vector_json(body.velocity)},
          {"broken_edges", body.broken_edges},
          {"fragments", body.fragments},
          {"softening", body.softening}};
}

Json switch_json(const SwitchEvent& event) {
  Json numbers = Json::object();
  for (const auto& [name, value] : event.numbers) numbers[name] = value;
  return {{"time_s", event.time_s},
          {"body", event.body},
          {"to", event.to_flexible ? "flexible" : "rigid"},
          {"cause", event.cause},
          {"numbers", std::move(numbers)}};
}

template <class Item>
Json list_json(const std::vector<Item>& items, Json (*one)(const Item&)) {
  Json list = Json::array();
  for (const Item& item : items) list.push_back(one(item));
  return list;
}

Json real_time_factor(const RunResult& run) {
  return run.wall_s > 0.0 ? Json(run.seconds / run.wall_s) : Json(nullptr);
}

Json what_happened(const RunResult& run) {
  return {{"wall_s", run.wall_s},
          {"spring_updates", run.spring_updates},
          {"broken_edges", run.broken_edges},
          {"fragments", run.fragments},
          {"first_break_s", or_null(run.first_break_s)}};
}

Json switching_counts(const RunResult& run) {
  return {{"flexible_share", run.flexible_share},
          {"to_flexible", run.to_flexible},
          {"to_rigid", run.to_rigid},
          {"missed", or_null(run.missed)},
          {"needless", or_null(run.needless)}};
}

Json plausibility(const RunResult& run) {
  return {{"pieces", count_pieces(run)},
          {"fastest_piece_m_s", run.fastest_piece_m_s},
          {"fastest_chip_m_s", run.fastest_chip_m_s},
          {"impact_speed_m_s", run.impact_speed_m_s},
          {"fastest_piece_rel", run.fastest_piece_rel},
          {"highest_rise_m", run.highest_rise_m},
          {"highest_energy_rel", run.highest_energy_rel},
          {"state_hash", hex_hash(run.state_hash)}};
}

Json errors_json(const Errors& errors) {
  return {{"com_rel", or_null(errors.com_rel)},
          {"rotation_rad", or_null(errors.rotation_rad)},
          {"fragment_mass_l1", or_null(errors.fragment_mass_l1)}};
}

Json noise_json(const std::optional<Errors>& noise, std::size_t runs) {
  if (!noise) return nullptr;
  Json json;
  json["runs"] = runs;
  json.update(errors_json(*noise));
  return json;
}

Json flexible_json(const ComparedRuns& runs) {
  Json json = what_happened(runs.flexible.front());
  json.update(plausibility(runs.flexible.front()));
  json["wall_median_s"] = median_wall_s(runs.flexible);
  return json;
}

Json switching_json(const ComparedRuns& runs) {
  Json json = what_happened(runs.switching.front());
  json.update(switching_counts(runs.switching.front()));
  json.update(plausibility(runs.switching.front()));
  json["wall_median_s"] = median_wall_s(runs.switching);
  return json;
}

Json scene_json(const RunResult& run) {
  return {{"scene", run.scene},   {"seconds", run.seconds}, {"tick", run.tick},
          {"bodies", run.bodies}, {"points", run.points},   {"springs", run.springs}};
}

Json pieces_json(const RunResult& flexible, const RunResult& switching) {
  return {{"flexible", count_pieces(flexible)},
          {"switching", count_pieces(switching)},
          {"largest_rel", or_null(largest_piece_rel(flexible, switching))},
          {"debris_rel", or_null(debris_rel(flexible, switching))}};
}

const char* name_of(SpringPrecision precision) {
  return precision == SpringPrecision::kSingle ? "single" : "double";
}

// null: double precision uses none.
Json vector_instructions_of(const RunResult& run) {
  if (run.spring_precision == SpringPrecision::kDouble) return nullptr;
  return vector_instructions();
}

}  // namespace

std::string hex_hash(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

const char* name_of(Policy policy) {
  switch (policy) {
    case Policy::kFlexible:
      return "flexible";
    case Policy::kRigid:
      return "rigid";
    case Policy::kSwitching:
      break;
  }
  return "switching";
}

std::string run_json(const RunResult& run, Policy policy) {
  Json json = {{"scene", run.scene},
               {"policy", name_of(policy)},
               {"seconds", run.seconds},
               {"tick", run.tick},
               {"real_time_factor", real_time_factor(run)},
               {"state_hash", hex_hash(run.state_hash)},
               {"points", run.points},
               {"springs", run.springs},
               {"spring_precision", name_of(run.spring_precision)},
               {"vector_instructions", vector_instructions_of(run)},
               {"softening", run.softening}};
  json.update(what_happened(run));
  json.update(switching_counts(run));
  json.update(plausibility(run));
  json["bodies"] = list_json(run.summaries, body_json);
  json["piece_masses_kg"] = run.piece_masses;
  json["notes"] = run.notes;
  json["ledger"] = ledger_json(run);
  json["switches"] = list_json(run.switches, switch_json);
  return text_of(json);
}

std::string comparison_json(const ComparedRuns& runs, const Comparison& comparison) {
  const RunResult& flexible = runs.flexible.front();
  const RunResult& switching = runs.switching.front();
  Json json = scene_json(flexible);
  json["flexible"] = flexible_json(runs);
  json["switching"] = switching_json(runs);
  json["speedup"] = or_null(comparison.speedup);
  json["median_speedup"] = or_null(comparison.median_speedup);
  json["update_ratio"] = or_null(comparison.update_ratio);
  json["error"] = errors_json(comparison.error);
  json["pieces"] = pieces_json(flexible, switching);
  json["noise"] = noise_json(comparison.noise, runs.flexible.size());
  json["ledger"] = ledger_json(switching);
  json["softening"] = flexible.softening;
  json["spring_precision"] = name_of(flexible.spring_precision);
  json["vector_instructions"] = vector_instructions_of(flexible);
  json["notes"] = flexible.notes;
  json["baseline_efficiency"] = or_null(comparison.baseline_efficiency);
  return text_of(json);
}

}  // namespace limber::demos

#include "demos/cli/report_tables.h"

#include <fmt/format.h>

#include <algorithm>

#include "demos/cli/body_groups.h"
#include "demos/cli/report_json.h"
#include "demos/cli/text_table.h"

namespace limber::demos {
namespace {

constexpr std::size_t kMostSwitches = 24;  // lines of one report
constexpr std::size_t kMostPieces = 8;     // whose masses are shown

std::string or_dash(const std::optional<double>& value) {
  return value ? significant(*value) : "-";
}

std::string or_dash(const std::optional<std::size_t>& value) {
  return value ? grouped(*value) : "-";
}

std::string counted(std::size_t n, const char* one, const char* many) {
  return fmt::format("{} {}", grouped(n), n == 1 ? one : many);
}

std::string headline(const RunResult& run) {
  return fmt::format("{}: {} s at a tick of {} s; {}, {} and {}\n", run.scene,
                     significant(run.seconds), significant(run.tick),
                     counted(run.bodies, "body", "bodies"), counted(run.points, "point", "points"),
                     counted(run.springs, "spring", "springs"));
}

std::string spring_text(const RunResult& run) {
  if (run.spring_precision == SpringPrecision::kDouble) return "double precision";
  return fmt::format("single precision, {}", vector_instructions());
}

std::string softening_text(const RunResult& run) {
  if (run.softening <= 1.0) return "1 (the real material)";
  return fmt::format("{} (real modulus / simulated)", significant(run.softening));
}

std::string speed_text(const Vec3& v) {
  return fmt::format("{:.3f} {:.3f} {:.3f}", v.x(), v.y(), v.z());
}

std::string numbers_text(const SwitchEvent& event) {
  std::string text;
  for (const auto& [name, value] : event.numbers) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, significant(value));
  }
  return text;
}

std::string titled(const TextTable& table) {
  std::string text("\n");
  text += table.text();
  return text;
}

// Left-flush columns after the first, unlike TextTable's: sentences, not numbers.
std::string switch_line(const SwitchEvent& event) {
  return fmt::format("  {:8.4f} s  {} to {:<8}  {}  {}\n", event.time_s, event.body,
                     event.to_flexible ? "flexible" : "rigid", event.cause, numbers_text(event));
}

std::string switches_section(const RunResult& run) {
  if (run.switches.empty()) return "\nno switches\n";
  std::string text = fmt::format("\nswitches: {} to flexible, {} to rigid\n",
                                 grouped(run.to_flexible), grouped(run.to_rigid));
  const std::size_t shown = std::min(run.switches.size(), kMostSwitches);
  for (std::size_t i = 0; i < shown; ++i) text += switch_line(run.switches[i]);
  if (shown < run.switches.size()) {
    text += fmt::format("  and {} more; --json FILE lists them all\n",
                        grouped(run.switches.size() - shown));
  }
  return text;
}

std::string bodies_section(const RunResult& run) {
  TextTable table;
  table.add_row(
      {"body", "now", "mass kg", "centre m", "velocity m/s", "broken edges", "fragments"});
  for (const BodySummary& b : grouped_bodies(run.summaries)) {
    table.add_row({b.name, b.representation, significant(b.mass_kg), speed_text(b.centre_of_mass),
                   speed_text(b.velocity), grouped(b.broken_edges), grouped(b.fragments)});
  }
  return titled(table);
}

std::string largest_pieces(const RunResult& run) {
  std::string text;
  const std::size_t shown = std::min(run.piece_masses.size(), kMostPieces);
  for (std::size_t i = 0; i < shown; ++i)
    text += (i == 0 ? "" : ", ") + significant(run.piece_masses[i]);
  return shown < run.piece_masses.size() ? text + ", ..." : text;
}

std::string broken_section(const RunResult& run) {
  if (run.broken_edges == 0) return "";
  TextTable table;
  table.add_row({"what broke", ""});
  table.add_row({"edges", grouped(run.broken_edges)});
  table.add_row({"pieces", grouped(run.piece_masses.size())});
  table.add_row({"pieces over 0.5 % of the mass", grouped(count_pieces(run))});
  table.add_row({"the largest, kg", largest_pieces(run)});
  table.add_row({"debris, kg", significant(run.debris_mass)});
  return titled(table);
}

std::string run_facts(const RunResult& run, Policy policy) {
  TextTable table;
  table.add_row({"policy", name_of(policy)});
  table.add_row({"wall time", fmt::format("{:.3f} s", run.wall_s)});
  table.add_row({"real-time factor",
                 run.wall_s > 0.0 ? fmt::format("{:.3f}", run.seconds / run.wall_s) : "-"});
  table.add_row({"spring updates", grouped(run.spring_updates)});
  table.add_row({"flexible share", significant(run.flexible_share)});
  table.add_row({"first break, s", or_dash(run.first_break_s)});
  table.add_row({"softening S", softening_text(run)});
  table.add_row({"springs", spring_text(run)});
  table.add_row({"state hash", hex_hash(run.state_hash)});
  return table.text();
}

std::string cost_section(const RunResult& flexible, const RunResult& switching,
                         const Comparison& c) {
  TextTable table;
  table.add_row({"cost", "all flexible", "switching", "speed-up"});
  table.add_row({"wall time, s", significant(flexible.wall_s), significant(switching.wall_s),
                 or_dash(c.speedup)});
  table.add_row({"spring updates", grouped(flexible.spring_updates),
                 grouped(switching.spring_updates), or_dash(c.update_ratio)});
  table.add_row({"flexible share", significant(flexible.flexible_share),
                 significant(switching.flexible_share)});
  return table.text();
}

std::string noise_text(const ComparedRuns& runs, const Comparison& c) {
  if (!c.noise) return "not measured; --noise 5 measures it";
  return fmt::format("centre {}, rotation {} rad, fragment masses {} ({} flexible runs)",
                     or_dash(c.noise->com_rel), or_dash(c.noise->rotation_rad),
                     or_dash(c.noise->fragment_mass_l1), runs.flexible.size());
}

std::string efficiency_text(const Comparison& c) {
  if (!c.baseline_efficiency) return "not measured";
  return fmt::format("{} of the bare springs' updates per second",
                     significant(*c.baseline_efficiency));
}

// What a speed-up means nothing without.
std::string conditions_section(const ComparedRuns& runs, const Comparison& c) {
  std::string text = "\n  the speed-up holds for\n";
  text += fmt::format("    softening S          {}\n", softening_text(runs.flexible.front()));
  text += fmt::format("    noise floor          {}\n", noise_text(runs, c));
  text += fmt::format("    baseline efficiency  {}\n", efficiency_text(c));
  text += fmt::format("    springs              {}\n", spring_text(runs.flexible.front()));
  if (c.median_speedup) {
    text += fmt::format("    median wall times    speed-up {} over {} pairs of runs\n",
                        significant(*c.median_speedup), runs.flexible.size());
  }
  return text;
}

std::string errors_section(const Comparison& c) {
  const Errors noise = c.noise.value_or(Errors{});
  const std::string floor = c.noise ? "noise floor" : "noise floor: --noise 5";
  TextTable table;
  table.add_row({"error", "switching", floor});
  table.add_row({"centre of mass / size, before the break", or_dash(c.error.com_rel),
                 or_dash(noise.com_rel)});
  table.add_row({"rotation, rad, before the break", or_dash(c.error.rotation_rad),
                 or_dash(noise.rotation_rad)});
  table.add_row({"fragment masses, L1 / mass", or_dash(c.error.fragment_mass_l1),
                 or_dash(noise.fragment_mass_l1)});
  return titled(table);
}

std::string outcome_section(const RunResult& flexible, const RunResult& switching) {
  const RunResult* both[] = {&flexible, &switching};
  TextTable table;
  const auto row = [&](const char* name, auto value) {
    table.add_row({name, value(*both[0]), value(*both[1])});
  };
  table.add_row({"outcome", "all flexible", "switching"});
  row("first break, s", [](const RunResult& r) { return or_dash(r.first_break_s); });
  row("broken edges", [](const RunResult& r) { return grouped(r.broken_edges); });
  row("fragments", [](const RunResult& r) { return grouped(r.fragments); });
  row("pieces over 0.5 % of the mass", [](const RunResult& r) { return grouped(count_pieces(r)); });
  row("largest piece / mass", [](const RunResult& r) { return or_dash(largest_piece_rel(r, r)); });
  row("debris / mass", [](const RunResult& r) { return or_dash(debris_rel(r, r)); });
  row("fastest piece, m/s", [](const RunResult& r) { return significant(r.fastest_piece_m_s); });
  row("fastest chip under 0.5 %, m/s",
      [](const RunResult& r) { return significant(r.fastest_chip_m_s); });
  row("free fall to the floor, m/s",
      [](const RunResult& r) { return significant(r.impact_speed_m_s); });
  row("highest energy / start",
      [](const RunResult& r) { return significant(r.highest_energy_rel); });
  row("highest rise, m", [](const RunResult& r) { return significant(r.highest_rise_m); });
  return titled(table);
}

std::string hand_over_section(const RunResult& run) {
  const LedgerTotals& l = run.ledger;
  const bool any = run.to_flexible + run.to_rigid > 0;
  const auto defect = [any](double value) { return any ? significant(value) : "-"; };
  TextTable table;
  table.add_row({"hand-overs of the switching run", ""});
  table.add_row({"to flexible", grouped(run.to_flexible)});
  table.add_row({"to rigid", grouped(run.to_rigid)});
  table.add_row({"touches not foreseen", or_dash(run.missed)});
  table.add_row({"needless", or_dash(run.needless)});
  table.add_row({"worst momentum defect", defect(l.momentum_rel)});
  table.add_row({"worst angular momentum defect", defect(l.angular_momentum_rel)});
  table.add_row({"energy to lattices, J", significant(l.energy_in_J)});
  table.add_row({"energy to rigid bodies, J", significant(l.energy_out_J)});
  table.add_row({"elastic energy kept while rigid, J", significant(l.energy_stored_J)});
  table.add_row({"vibration discarded, J", significant(l.energy_discarded_J)});
  table.add_row({"worst energy unaccounted for", defect(l.energy_unaccounted_rel)});
  return titled(table);
}

}  // namespace

std::string scene_list(const std::vector<SceneEntry>& scenes) {
  std::string text = "Scenes for `limber run SCENE`, with the parameters of --set NAME=VALUE:\n";
  for (const SceneEntry& scene : scenes) {
    text += fmt::format("\n{}\n  {}\n", scene.name, scene.summary);
    std::size_t width = 0;
    for (const Parameter& p : scene.parameters) width = std::max(width, p.name.size());
    for (const Parameter& p : scene.parameters) {
      text += fmt::format("    {:<{}} = {} {}  {} ({} to {})\n", p.name, width, p.value, p.unit,
                          p.meaning, p.least, p.most);
    }
  }
  return text;
}

std::string run_report(const RunResult& run, Policy policy) {
  return headline(run) + run_facts(run, policy) + bodies_section(run) + broken_section(run) +
         switches_section(run);
}

std::string comparison_report(const ComparedRuns& runs, const Comparison& comparison) {
  const RunResult& flexible = runs.flexible.front();
  const RunResult& switching = runs.switching.front();
  return headline(flexible) + "\n" + cost_section(flexible, switching, comparison) +
         conditions_section(runs, comparison) + errors_section(comparison) +
         outcome_section(flexible, switching) + hand_over_section(switching);
}

}  // namespace limber::demos

#include "demos/cli/model_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "demos/cli/text_table.h"
#include "demos/cli/vector_json.h"

namespace limber::demos {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kLargest = 100.0;  // m
constexpr double kSmallest = 1e-3;  // m
constexpr double kManyCells = 2e5;  // a million took 50 s of one core and 1.6 GB
constexpr double kQuickCells = 2e4;
constexpr double kSecondsACell = 6e-5;

std::string size_line(const MadeModel& made) {
  return fmt::format("{} x {} x {} m, cells of {} m\n", significant(made.size.x()),
                     significant(made.size.y()), significant(made.size.z()),
                     significant(made.spacing));
}

// 0 for what rounds to it: no "-0.00 %".
std::string percent(double share) {
  const double hundredths = std::round(1e4 * share);
  return fmt::format("{:.2f} %", hundredths == 0.0 ? 0.0 : 0.01 * hundredths);
}

std::string fit_table(const MeshLatticeReport& fit) {
  TextTable table;
  table.add_row({"", "mesh", "lattice", "error"});
  table.add_row({"volume, m^3", significant(fit.mesh.volume), significant(fit.cells.volume),
                 percent(fit.volume_error)});
  table.add_row({"centre", "", "", fmt::format("{:.3f} cells", fit.centre_error)});
  table.add_row({"inertia", "", "", percent(fit.inertia_error)});
  return table.text();
}

std::string counted(std::size_t n, const char* one) {
  return fmt::format("{} {}{}", grouped(n), one, n == 1 ? "" : "s");
}

std::string substeps(double number) {
  const double whole = std::ceil(number);  // counts have no exponent
  return fmt::format("{:.0f} {}", whole, whole == 1.0 ? "substep" : "substeps");
}

std::string counts(const MadeModel& made) {
  return fmt::format(
      "{}, {}, {}, {} kg of {}\n{} in a tick of 1/60 s with softening S {}, {} with "
      "S 1\n",
      counted(made.count.points, "point"), counted(made.count.edges, "edge"),
      counted(made.count.cells, "cell"), significant(made.mass_kg), made.material,
      substeps(made.cost.substeps_per_tick), significant(made.cost.softening),
      substeps(made.cost.substeps_per_tick_unsoftened));
}

// Two digits of it.
std::uint64_t rounded_count(double number) {
  const double unit = std::pow(10.0, std::floor(std::log10(number)) - 1.0);
  return static_cast<std::uint64_t>(std::llround(number / unit) * unit);
}

Json solid_json(const SolidMoments& solid) {
  return {{"volume_m3", solid.volume}, {"com_m", vector_json(solid.centre)}};
}

Json fit_json(const MeshLatticeReport& fit) {
  return {{"mesh", solid_json(fit.mesh)},          {"mesh_is_exact", fit.mesh_is_exact},
          {"lattice", solid_json(fit.cells)},      {"volume_error", fit.volume_error},
          {"com_error_cells", fit.centre_error},   {"inertia_error", fit.inertia_error},
          {"separate_pieces", fit.separate_pieces}};
}

Json cost_json(const MaterialReport& cost) {
  return {{"softening", cost.softening},
          {"substeps_per_tick", cost.substeps_per_tick},
          {"substeps_per_tick_unsoftened", cost.substeps_per_tick_unsoftened}};
}

}  // namespace

std::vector<Diagnostic> size_notes(const std::string& mesh, const Vec3& size_m) {
  const double longest = size_m.maxCoeff();
  if (longest >= kSmallest && longest <= kLargest) return {};
  return {{mesh,
           fmt::format("it is {:.3g} m long, which is {} for what is dropped on a floor", longest,
                       longest > kLargest ? "large" : "small"),
           "if its unit is not what was taken, say how many metres it is: --scale 0.001 for "
           "millimetres, 0.01 for centimetres, 0.0254 for inches, 1 for metres"}};
}

std::vector<Diagnostic> count_notes(const std::string& mesh, double volume_m3, double spacing_m) {
  const double cells = volume_m3 / (spacing_m * spacing_m * spacing_m);
  if (!(cells > kManyCells)) return {};
  return {{mesh,
           fmt::format("about {} cells of {:.3g} m fill it: they take about {:.0f} s to make "
                       "here, and long to simulate",
                       grouped(rounded_count(cells)), spacing_m, kSecondsACell * cells),
           fmt::format("--spacing {:.2g} makes about {}", std::cbrt(volume_m3 / kQuickCells),
                       grouped(rounded_count(kQuickCells)))}};
}

std::string model_report(const MadeModel& made) {
  std::string text = size_line(made) + fit_table(made.fit) + counts(made);
  for (const Diagnostic& note : made.notes) text += "note: " + note.text() + "\n";
  if (made.output.empty()) return text;
  return text + fmt::format("{0}: written; `limber run {0}` drops it\n", made.output);
}

std::string model_json(const MadeModel& made) {
  Json json = {
      {"mesh", made.mesh},         {"material", made.material}, {"size_m", vector_json(made.size)},
      {"spacing_m", made.spacing}, {"fit", fit_json(made.fit)}, {"points", made.count.points},
      {"edges", made.count.edges}, {"cells", made.count.cells}, {"mass_kg", made.mass_kg}};
  json.update(cost_json(made.cost));
  json["notes"] = Json::array();
  for (const auto* notes : {&made.early, &made.notes})
    for (const Diagnostic& note : *notes) json["notes"].push_back(note.text());
  json["output"] = made.output.empty() ? Json(nullptr) : Json(made.output);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace limber::demos

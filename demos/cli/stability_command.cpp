#include "demos/cli/stability_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <ostream>
#include <utility>
#include <vector>

#include "core/analysis/stability_atlas.h"
#include "core/model/errors.h"
#include "core/storage/atomic_file.h"
#include "demos/cli/options.h"
#include "demos/cli/progress_bar.h"
#include "demos/cli/stability_plots.h"
#include "demos/cli/stability_report.h"
#include "demos/cli/text_table.h"
#include "demos/render/gnuplot.h"

namespace limber::demos {
namespace {

namespace fs = std::filesystem;

struct StabilityOptions : OutputOptions {
  std::string folder;  // empty: none
  AtlasExtent extent = AtlasExtent::kFull;
};

using NamedFile = std::pair<std::string, std::string>;  // name, contents

void require_folder(const std::string& folder) {
  if (folder.empty()) return;
  if (!fs::is_directory(folder)) {
    throw InputError({folder, "is no folder", "make it first, or name one that exists"});
  }
  require_writable(fs::path(folder) / "stability_cases.csv");
  require_gnuplot();
}

std::vector<NamedFile> files_of(const StabilityAtlas& atlas) {
  std::vector<NamedFile> files = {
      {"stability_cases.csv", cases_csv(atlas)},
      {"stability_damping.csv", limits_csv(atlas.damping, "damping_ratio")},
      {"stability_mass_ratio.csv", limits_csv(atlas.mass_ratio, "mass_ratio")},
      {"stability_accuracy.csv", frequency_csv(atlas.frequency)}};
  for (const auto& [name, plot] : stability_plots(atlas)) {
    files.emplace_back(name + ".png", plot_png(plot));
    files.emplace_back(name + ".svg", plot_svg(plot));
  }
  return files;
}

// All of them are made before the first is written. Returns what to say of it.
std::string write_files(const StabilityAtlas& atlas, const std::string& folder) {
  if (folder.empty()) return "";
  const std::vector<NamedFile> files = files_of(atlas);
  for (const auto& [name, contents] : files) {
    write_file_atomically(fs::path(folder) / name, contents);
  }
  return fmt::format("\n{}: {} files written\n", folder, files.size());
}

void refuse_violations(const StabilityAtlas& atlas) {
  const std::size_t count = violations_in(atlas);
  if (count == 0) return;
  throw SimulationError({"stability atlas",
                         fmt::format("{} of {} cases broke the rule that docs/stability.md states",
                                     grouped(count), grouped(atlas.cases.size())),
                         "please report it with the list of violations"});
}

StabilityAtlas make(const StabilityOptions& options, Terminal& terminal) {
  ProgressBar bar(terminal.err);
  return make_stability_atlas(options.extent, [&](double share) { bar.show("stability", share); });
}

void draw_atlas(const StabilityOptions& options, Terminal& terminal) {
  require_json_target(options);
  require_folder(options.folder);
  const StabilityAtlas atlas = make(options, terminal);
  const std::string written = write_files(atlas, options.folder);
  write_json(options, stability_json(atlas), terminal);
  if (tables_wanted(options)) terminal.out << stability_report(atlas) << written;
  refuse_violations(atlas);
}

}  // namespace

void add_stability_command(CLI::App& app, Action& chosen) {
  auto options = std::make_shared<StabilityOptions>();
  CLI::App* command = app.add_subcommand(
      "stability",
      "Try the integrators on stiffness, damping, masses, steps and broken shapes: "
      "where they hold and where they blow up");
  command
      ->add_option("-o,--output", options->folder,
                   "write the data (CSV) and plots (PNG and SVG, by gnuplot) into this folder")
      ->type_name("FOLDER");
  command->add_flag_callback(
      "--fast", [options] { options->extent = AtlasExtent::kFast; },
      "a part of the atlas, in a few seconds");
  add_json(*command, *options);
  command->callback([options, &chosen] {
    chosen = [options](Terminal& terminal) { draw_atlas(*options, terminal); };
  });
}

}  // namespace limber::demos

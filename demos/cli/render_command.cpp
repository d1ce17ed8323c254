#include "demos/cli/render_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <ostream>

#include "core/model/errors.h"
#include "core/storage/atomic_file.h"
#include "core/storage/model_file.h"
#include "demos/cli/numbers.h"
#include "demos/cli/options.h"
#include "demos/cli/progress_bar.h"
#include "demos/render/model_view.h"
#include "demos/render/pov_scene.h"
#include "demos/render/povray.h"

namespace limber::demos {
namespace {

constexpr double kMostTime_s = 1e5;
constexpr int kLeastPixels = 16;
constexpr int kMostPixels = 8192;

constexpr const char* kLegend =
    "Glazed surfaces are rigid just now; amber ones with their lattice drawn on them are "
    "flexible;\n"
    "reddish rough ones were inside until something broke.\n";

struct RenderOptions : SceneOptions {
  double time_s = -1.0;  // < 0: not given
  bool lattice = false;
  std::string image;
  PictureSize size;
};

double parse_time(const std::string& text) {
  const double time_s = parse_number(text, "--time");
  if (time_s >= 0.0 && time_s <= kMostTime_s) return time_s;
  throw InputError({"--time", fmt::format("{} s is out of range", text),
                    fmt::format("give 0 to {} s", kMostTime_s)});
}

std::string parse_image(const std::string& text) {
  if (std::filesystem::path(text).extension() == ".png") return text;
  throw InputError(
      {"--output", fmt::format("'{}' is not a PNG file's name", text), "let it end in .png"});
}

double largest_softening(const Scene& scene) {
  double largest = 1.0;
  for (const PhysicalModel& model : scene.objects) {
    largest = std::max(largest, model.object.softening);
  }
  return largest;
}

// The tick that ends nearest to the wanted time.
Snapshot simulate_until(const RenderOptions& options, const Scene& scene, ProgressBar& bar) {
  const double tick = options.run.tick > 0.0 ? options.run.tick : scene.tick;
  Simulation simulation(scene, options.run);
  while (simulation.time_s() + 0.5 * tick < options.time_s) {
    simulation.advance_tick();
    bar.show(scene.name, simulation.time_s() / options.time_s);
  }
  return simulation.snapshot();
}

Snapshot draw(const RenderOptions& options, const Scene& scene, Terminal& terminal) {
  ProgressBar bar(terminal.err);
  Snapshot snapshot = simulate_until(options, scene, bar);
  bar.show("ray tracing", 1.0);
  write_file_atomically(options.image, trace_png(pov_scene(snapshot, options.size), options.size));
  return snapshot;
}

// A model file without a time: the model as it is.
void render_model(const RenderOptions& options, Terminal& terminal) {
  const PhysicalModel model = read_model(options.scene);
  require_povray();
  require_writable(options.image);
  const ModelLook look = options.lattice ? ModelLook::kLattice : ModelLook::kSkin;
  const Snapshot snapshot = model_snapshot(model, look);
  write_file_atomically(options.image, trace_png(pov_scene(snapshot, options.size), options.size));
  terminal.out << fmt::format("{}: {}, {} x {} pixels\n", options.image, model.name,
                              options.size.width, options.size.height);
}

void render_scene(const RenderOptions& options, Terminal& terminal) {
  const Scene scene = scene_of(options, terminal);
  require_povray();
  require_writable(options.image);
  say_notes(scene.notes, terminal);
  const Snapshot snapshot = draw(options, scene, terminal);
  terminal.out << fmt::format("{}: {} at {:.4f} s, {} x {} pixels, softening S {:.4g}\n{}",
                              options.image, scene.name, snapshot.time_s, options.size.width,
                              options.size.height, largest_softening(scene), kLegend);
}

void render(const RenderOptions& options, Terminal& terminal) {
  if (options.time_s >= 0.0 && options.lattice) {
    throw InputError({"command line", "--lattice is for a model file without --time",
                      "leave out one of the two"});
  }
  if (options.time_s >= 0.0) return render_scene(options, terminal);
  if (!options.changes.empty()) {
    throw InputError(
        {"command line", "--set is for a scene, at a --time", "add --time, or leave out --set"});
  }
  const std::filesystem::path file(options.scene);
  if (std::filesystem::is_regular_file(file) && file.extension() != ".lua")
    return render_model(options, terminal);
  throw InputError({"command line", "--time is missing",
                    "name the instant to show; only a model file may go without"});
}

void add_pixels(CLI::App& command, const std::string& side, int& pixels) {
  const std::string name = "--" + side;
  command
      .add_option_function<std::string>(
          name,
          [name, &pixels](const std::string& text) {
            pixels = parse_whole(text, kLeastPixels, kMostPixels, name);
          },
          fmt::format("{} of the picture in pixels; {} without it", side, pixels))
      ->type_name("N");
}

void add_picture_options(CLI::App& command, RenderOptions& options) {
  command
      .add_option_function<std::string>(
          "--time", [&](const std::string& text) { options.time_s = parse_time(text); },
          "the instant to show, simulated s; the nearest tick is taken. A model file may go "
          "without: "
          "then it is shown as it is")
      ->type_name("S");
  command.add_flag("--lattice", options.lattice,
                   "of a model file without --time: its cells instead of its skin");
  command
      .add_option_function<std::string>(
          "-o,--output", [&](const std::string& text) { options.image = parse_image(text); },
          "the picture to write")
      ->type_name("IMAGE.png")
      ->required();
  add_pixels(command, "width", options.size.width);
  add_pixels(command, "height", options.size.height);
}

}  // namespace

void add_render_command(CLI::App& app, Action& chosen) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command = app.add_subcommand("render", "Ray-trace one picture of a scene (POV-Ray)");
  add_scene(*command, *options, true);
  add_picture_options(*command, *options);
  add_policy(*command, *options);
  add_tick(*command, *options);
  add_set(*command, *options);
  add_inputs(*command, *options);
  command->footer(kLegend);
  command->callback([options, &chosen] {
    chosen = [options](Terminal& terminal) { render(*options, terminal); };
  });
}

}  // namespace limber::demos

#include "demos/cli/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <ostream>

#include "core/model/errors.h"
#include "core/storage/atomic_file.h"
#include "demos/cli/numbers.h"
#include "demos/scripting/script_scene.h"

namespace limber::demos {
namespace {

constexpr double kLeastTick = 1e-5;  // s; below, a second takes more than 100,000 rigid steps
constexpr double kMostTick = 0.1;    // s; above, Bullet's contacts tunnel and jump
constexpr int kMostThreads = 1024;
constexpr double kMostSeconds = 1e5;  // s; above, the samples of one run no longer fit in memory

double parse_seconds(const std::string& text) {
  const double seconds = parse_number(text, "--seconds");
  if (seconds > 0.0 && seconds <= kMostSeconds) return seconds;
  throw InputError({"--seconds", fmt::format("{} s is out of range", text),
                    fmt::format("give more than 0 and at most {} s", kMostSeconds)});
}

double parse_tick(const std::string& text) {
  const double tick = parse_number(text, "--tick");
  if (tick >= kLeastTick && tick <= kMostTick) return tick;
  throw InputError({"--tick", fmt::format("{} s is out of range", text),
                    fmt::format("give {} to {} s, 1/60 for instance", kLeastTick, kMostTick)});
}

Policy parse_policy(const std::string& text) {
  static const std::map<std::string, Policy> policies = {{"switching", Policy::kSwitching},
                                                         {"flexible", Policy::kFlexible},
                                                         {"rigid", Policy::kRigid}};
  const auto found = policies.find(text);
  if (found != policies.end()) return found->second;
  throw InputError({"--policy", fmt::format("there is no policy '{}'", text),
                    "give switching, flexible or rigid"});
}

RunOptions::Integration parse_integrator(const std::string& text) {
  static const std::map<std::string, RunOptions::Integration> ways = {
      {"explicit", RunOptions::Integration::kExplicit},
      {"implicit", RunOptions::Integration::kImplicit},
      {"automatic", RunOptions::Integration::kAutomatic}};
  const auto found = ways.find(text);
  if (found != ways.end()) return found->second;
  throw InputError({"--integrator", fmt::format("there is no integrator '{}'", text),
                    "give explicit, implicit or automatic"});
}

SpringPrecision parse_springs(const std::string& text) {
  static const std::map<std::string, SpringPrecision> precisions = {
      {"single", SpringPrecision::kSingle}, {"double", SpringPrecision::kDouble}};
  const auto found = precisions.find(text);
  if (found != precisions.end()) return found->second;
  throw InputError(
      {"--springs", fmt::format("there is no precision '{}'", text), "give single or double"});
}

}  // namespace

void add_scene(CLI::App& command, SceneOptions& options, bool required) {
  command
      .add_option(
          "SCENE", options.scene,
          "name of a scene (`limber run` alone lists them), a script (.lua) or a model file")
      ->required(required)
      ->type_name("");
}

void add_set(CLI::App& command, SceneOptions& options) {
  command
      .add_option_function<std::vector<std::string>>(
          "--set",
          [&options](const std::vector<std::string>& assignments) {
            for (const std::string& text : assignments) {
              const auto [name, value] = parse_assignment(text);
              options.changes[name] = value;
            }
          },
          "change a parameter of the scene; may be repeated")
      ->type_name("NAME=VALUE")
      ->expected(1)
      ->take_all();
}

void add_inputs(CLI::App& command, SceneOptions& options) {
  command
      .add_option_function<std::string>(
          "--inputs", [&](const std::string& file) { options.inputs = read_inputs(file); },
          "what a player does, for scripts: lines of a time in s, a name and a number")
      ->type_name("FILE");
}

void add_seconds(CLI::App& command, SceneOptions& options) {
  command
      .add_option_function<std::string>(
          "--seconds", [&](const std::string& s) { options.run.seconds = parse_seconds(s); },
          "simulated time, s; the scene's own without it")
      ->type_name("T");
}

void add_tick(CLI::App& command, SceneOptions& options) {
  command
      .add_option_function<std::string>(
          "--tick", [&](const std::string& s) { options.run.tick = parse_tick(s); },
          "step of the rigid world, s, as 1/60 or 0.01; the scene's own without it")
      ->type_name("S");
}

void add_policy(CLI::App& command, SceneOptions& options) {
  command
      .add_option_function<std::string>(
          "--policy", [&](const std::string& s) { options.run.policy = parse_policy(s); },
          "switching (default): rigid until it matters; flexible: always the spring lattice; "
          "rigid: never")
      ->type_name("POLICY");
}

void add_integrator(CLI::App& command, SceneOptions& options) {
  command
      .add_option_function<std::string>(
          "--integrator",
          [&](const std::string& s) { options.run.integration = parse_integrator(s); },
          "explicit (default): vibrates and breaks as it should; implicit: any stiffness, no "
          "vibration; automatic: implicit for what would need too many substeps")
      ->type_name("METHOD");
}

void add_springs(CLI::App& command, SceneOptions& options) {
  command
      .add_option_function<std::string>(
          "--springs", [&](const std::string& s) { options.run.springs = parse_springs(s); },
          "precision of the springs' forces: single (fast) or double; Bullet's own without it")
      ->type_name("PRECISION");
}

void add_threads(CLI::App& command, SceneOptions& options) {
  command
      .add_option_function<std::string>(
          "--threads",
          [&](const std::string& s) {
            options.threads = parse_whole(s, 1, kMostThreads, "--threads");
          },
          "threads for large lattices, 1 without it; results do not depend on it")
      ->type_name("N");
}

void add_json(CLI::App& command, OutputOptions& options) {
  command
      .add_option("--json", options.json,
                  "write the same facts as JSON; - writes them to standard output, alone")
      ->type_name("FILE");
}

void require_json_target(const OutputOptions& options) {
  if (!options.json.empty() && options.json != "-") require_writable(options.json);
}

void write_json(const OutputOptions& options, const std::string& text, Terminal& terminal) {
  if (options.json.empty()) return;
  if (options.json == "-") {
    terminal.out << text;
  } else {
    write_file_atomically(options.json, text);
  }
}

Scene scene_of(const SceneOptions& options, Terminal& terminal,
               const std::function<void(const std::filesystem::path&)>& on_file) {
  ScriptSettings settings;
  settings.on_file = on_file;
  settings.inputs = options.inputs;
  settings.printed = &terminal.err;
  return build_scene(options.scene, options.changes, settings);
}

void require_other_file(const std::string& input, const std::string& output) {
  std::error_code none;
  if (!std::filesystem::equivalent(input, output, none)) return;
  throw InputError({output, "is what the command reads", "write to another file"});
}

void say_notes(const std::vector<Diagnostic>& notes, Terminal& terminal) {
  for (const Diagnostic& note : notes) terminal.err << "note: " << note.text() << '\n';
}

bool tables_wanted(const OutputOptions& options) { return options.json != "-"; }

}  // namespace limber::demos

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "tests/contact_scenes/run_scene.h"
#include "tests/contact_scenes/scenes.h"

namespace {

using namespace limber::bullet::test;

constexpr const char* kColumns =
    "penetration mm | energy rise J (%) | climb J | end m/s | ms per frame";
constexpr const char* kAbout =
    "Runs scenes of contact with Limber and with Bullet's own soft bodies and prints a table:\n"
    "the deepest penetration, the largest rise of energy above the start and its largest climb\n"
    "above the least so far, the speed of the fastest body at the end, and the time a frame of\n"
    "1/60 s takes.";

std::string cells(const Measured& measured) {
  return fmt::format("{:.1f} | {:.3g} ({:.2g}) | {:.3g} | {:.3g} | {:.2f}",
                     1e3 * measured.penetration, measured.energy_rise,
                     100.0 * measured.energy_rise / std::abs(measured.energy_start),
                     measured.energy_climb, measured.rest_speed, measured.ms_per_frame);
}

struct Options {
  std::string only;
  std::string engine = "both";
  double ticks_per_second = 60.0;
  bool slow = false;
  bool list = false;
  bool all_demands = false;
  std::optional<std::string> representation;
};

void print_head(const Options& options) {
  std::string head = "scene", rule = "---";
  for (const char* engine : {"limber", "bullet"}) {
    if (options.engine != "both" && options.engine != engine) continue;
    head += fmt::format(" | {}: {} | verdict", engine, kColumns);
    for (int i = 0; i < 6; ++i) rule += "|---";
  }
  fmt::print("| {} |\n|{}|\n", head, rule);
}

std::string result(const Scene& scene, Engine engine, const Options& options) {
  const Measured measured = run_scene(scene, engine, 1.0 / options.ticks_per_second);
  std::string text = fmt::format(" | {} | {}", cells(measured), measured.verdict());
  if (!options.all_demands) return text;
  for (const Finding& finding : measured.findings) {
    text += fmt::format("; {} {:.3g} of {:.3g}", finding.what, finding.value, finding.most);
  }
  return text;
}

void print_row(Scene scene, const Options& options) {
  if (options.representation == "switching")
    scene.representation = limber::bullet::Representation::kSwitching;
  if (options.representation == "flexible")
    scene.representation = limber::bullet::Representation::kAlwaysFlexible;
  std::string row = "| " + scene.name;
  if (options.engine != "bullet") row += result(scene, Engine::kLimber, options);
  if (options.engine != "limber") row += result(scene, Engine::kBulletSoft, options);
  fmt::print("{} |\n", row);
  std::fflush(stdout);
}

void print_table(const Options& options) {
  if (!options.list) print_head(options);
  for (const Scene& scene : all_scenes()) {
    if (scene.name.find(options.only) == std::string::npos) continue;
    if (options.list)
      fmt::print("{}{}\n", scene.name, scene.slow ? " (slow)" : "");
    else if (options.slow || !scene.slow)
      print_row(scene, options);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{kAbout};
  Options options;
  app.add_option("--only", options.only, "scenes whose name contains this");
  app.add_option("--engine", options.engine)->check(CLI::IsMember({"limber", "bullet", "both"}));
  app.add_option("--ticks", options.ticks_per_second, "ticks a second")
      ->check(CLI::Range(1, 10000));
  app.add_option("--representation", options.representation, "instead of each scene's own")
      ->check(CLI::IsMember({"flexible", "switching"}));
  app.add_flag("--slow", options.slow, "also scenes that take minutes");
  app.add_flag("--list", options.list, "only their names");
  app.add_flag("--demands", options.all_demands, "also what was found of every demand");
  CLI11_PARSE(app, argc, argv);
  print_table(options);
}

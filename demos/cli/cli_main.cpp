#include "demos/cli/cli_main.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/errors.h"
#include "demos/cli/api_command.h"
#include "demos/cli/command.h"
#include "demos/cli/compare_command.h"
#include "demos/cli/info_command.h"
#include "demos/cli/model_command.h"
#include "demos/cli/render_command.h"
#include "demos/cli/run_command.h"
#include "demos/cli/stability_command.h"

namespace limber::demos {
namespace {

constexpr int kDone = 0;
constexpr int kSimulationFailed = 1;
constexpr int kBadInput = 2;

#ifdef BT_USE_DOUBLE_PRECISION
constexpr const char* kBulletPrecision = "float64";
#else
constexpr const char* kBulletPrecision = "float32";
#endif

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

// CLI11 would call an unknown command a missing one.
void refuse_unknown_command(const CLI::App& app, int argc, const char* const* argv) {
  if (argc < 2 || std::string_view(argv[1]).starts_with('-')) return;
  const auto names = command_names(app);
  if (std::find(names.begin(), names.end(), argv[1]) != names.end()) return;
  throw InputError({"command line", fmt::format("there is no command '{}'", argv[1]),
                    fmt::format("the commands are {}", fmt::join(names, ", "))});
}

std::string on_one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  const auto end = text.find_last_not_of(" .");
  return end == std::string::npos ? "" : text.substr(0, end + 1);
}

// CLI11 looks for what is missing before it looks at what is too much; the user's typing error
// comes first, and in the order of typing.
std::string what_is_wrong(const CLI::ParseError& error, const CLI::App& app) {
  const std::vector<std::string> unknown = app.remaining(true);
  if (!unknown.empty()) return fmt::format("'{}' is not understood", fmt::join(unknown, " "));
  if (app.get_subcommands().empty()) return "a command is missing";
  return on_one_line(error.what());
}

InputError as_input_error(const CLI::ParseError& error, const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  const std::string command =
      chosen.empty() ? std::string("limber") : "limber " + chosen.front()->get_name();
  return InputError({"command line", what_is_wrong(error, app),
                     fmt::format("`{} --help` says what is possible", command)});
}

Action parse(int argc, const char* const* argv) {
  CLI::App app("Flexible, breakable objects for Bullet physics: rigid until it matters.", "limber");
  app.set_version_flag("--version",
                       fmt::format("limber {} (Bullet in {})", LIMBER_VERSION, kBulletPrecision));
  app.require_subcommand(1);
  Action chosen;
  add_run_command(app, chosen);
  add_compare_command(app, chosen);
  add_render_command(app, chosen);
  add_model_command(app, chosen);
  add_info_command(app, chosen);
  add_stability_command(app, chosen);
  add_api_command(app, chosen);
  refuse_unknown_command(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    const std::string help = app.help();
    return [help](Terminal& terminal) { terminal.out << help; };
  } catch (const CLI::CallForVersion& error) {
    const std::string version = error.what();
    return [version](Terminal& terminal) { terminal.out << version << '\n'; };
  } catch (const CLI::ParseError& error) {
    throw as_input_error(error, app);
  }
  return chosen;
}

void require_all_said(std::ostream& out) {
  if (out.flush()) return;
  throw InputError({"standard output", "could not be written",
                    "check where it is redirected to and that the disk is not full"});
}

int report(Terminal& terminal, const Diagnostic& diagnostic, int exit_code) {
  say_failure(diagnostic, terminal);
  return exit_code;
}

}  // namespace

void say_failure(const Diagnostic& diagnostic, Terminal& terminal) {
  terminal.err << "limber: " << diagnostic.text() << '\n';
}

int cli_main(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  Terminal terminal{out, err};
  try {
    parse(argc, argv)(terminal);
    require_all_said(out);
    return kDone;
  } catch (const InputError& error) {
    return report(terminal, error.diagnostic, kBadInput);
  } catch (const SimulationError& error) {
    return report(terminal, error.diagnostic, kSimulationFailed);
  } catch (const std::exception& error) {
    return report(terminal,
                  {"internal error", error.what(), "please report it with the command line"},
                  kSimulationFailed);
  }
}

}  // namespace limber::demos

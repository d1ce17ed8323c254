#include "demos/cli/info_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "core/model/errors.h"
#include "core/model/validate.h"
#include "core/storage/model_file.h"
#include "demos/cli/info_report.h"
#include "demos/cli/model_facts.h"
#include "demos/cli/options.h"
#include "demos/cli/text_table.h"

namespace limber::demos {
namespace {

struct InfoOptions : OutputOptions {
  std::string file;
};

void refuse_invalid(const PhysicalModel& model, const std::string& file, Terminal& terminal) {
  constexpr std::size_t kMost = 100;  // more would bury the first
  const std::vector<Diagnostic> found = validate(model, kMost);
  if (found.empty()) return;
  for (const Diagnostic& d : found) terminal.err << "limber: " << printable(d.text()) << '\n';
  throw InputError(
      {file,
       fmt::format("holds a model with {}{} {} (above)", found.size() == kMost ? "at least " : "",
                   grouped(found.size()), found.size() == 1 ? "error" : "errors"),
       "mend what wrote it; docs/invariants.md lists what a model has to fulfil"});
}

void inspect_file(const InfoOptions& options, Terminal& terminal) {
  require_other_file(options.file, options.json);
  require_json_target(options);
  const Seal seal = model_file_seal(options.file);
  PhysicalModel model = read_model_unchecked(options.file);
  refuse_invalid(model, options.file, terminal);
  const ModelFacts facts = model_facts(std::move(model));
  write_json(options, info_json(options.file, seal, facts), terminal);
  if (tables_wanted(options)) terminal.out << info_report(options.file, seal, facts);
}

}  // namespace

void add_info_command(CLI::App& app, Action& chosen) {
  auto options = std::make_shared<InfoOptions>();
  CLI::App* command =
      app.add_subcommand("info", "Say what is in a model file, and check all of it");
  command->add_option("FILE", options->file, "a model file")->required()->type_name("");
  add_json(*command, *options);
  command->callback([options, &chosen] {
    chosen = [options](Terminal& terminal) { inspect_file(*options, terminal); };
  });
}

}  // namespace limber::demos

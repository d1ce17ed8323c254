#include "demos/cli/api_command.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "demos/scripting/api_text.h"

namespace limber::demos {

void add_api_command(CLI::App& app, Action& chosen) {
  auto stubs = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("api", "Print what scripts can use, as Markdown");
  command->add_flag("--stubs", *stubs,
                    "as annotations for editors (Lua language server): put them into the folder of "
                    "your scenes");
  command->callback([stubs, &chosen] {
    chosen = [stubs](Terminal& terminal) {
      terminal.out << (*stubs ? api_stubs() : api_reference());
    };
  });
}

}  // namespace limber::demos

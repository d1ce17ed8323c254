#pragma once

#include <functional>
#include <iosfwd>

#include "core/model/errors.h"

namespace CLI {
class App;
}

namespace limber::demos {

// Where a command talks to its user.
struct Terminal {
  std::ostream& out;
  std::ostream& err;
};

// "limber: WHERE: WHAT; REMEDY" on standard error.
void say_failure(const Diagnostic& diagnostic, Terminal& terminal);

// What the command line asked for. Parsing only chooses it; it runs after the whole line was found
// good, so that bad usage never leaves half a result behind.
using Action = std::function<void(Terminal&)>;

}  // namespace limber::demos

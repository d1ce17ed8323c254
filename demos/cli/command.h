#pragma once

#include <functional>
#include <iosfwd>

namespace CLI {
class App;
}

namespace limber::demos {

// Where a command talks to its user.
struct Terminal {
  std::ostream& out;
  std::ostream& err;
};

// What the command line asked for. Parsing only chooses it; it runs after the whole line was found
// good, so that bad usage never leaves half a result behind.
using Action = std::function<void(Terminal&)>;

}  // namespace limber::demos

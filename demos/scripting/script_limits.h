#pragma once

#include <cstddef>
#include <cstdint>

namespace limber::demos {

// How much a script may use. Scripts come from strangers: each limit ends a way to make the program
// hang or to eat the machine's memory. A step is one instruction of Lua's machine; what C does for
// a script (copying, searching, sorting) is charged in steps of about the same time, 10 ns.
struct ScriptLimits {
  std::size_t memory_bytes = std::size_t{64} << 20;  // of Lua's own values
  std::uint64_t load_steps = 300'000'000;            // to set the scene up: seconds
  std::uint64_t tick_steps = 20'000'000;             // of all callbacks of one tick
  std::size_t points = 1'000'000;                    // of all models a script makes: 2 GB
  std::size_t bodies = 10'000;                       // rigid ones
  std::size_t objects = 20'000;                      // spawned, flexible ones
  std::size_t printed_bytes = 1'000'000;
  std::size_t file_bytes = 1'000'000;  // of one script or module
};

}  // namespace limber::demos

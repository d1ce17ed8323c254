#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace limber {

// What a child process may use before it is ended.
struct ApartLimits {
  std::size_t memory_bytes = std::size_t{6} << 30;  // beside what this process has already
  unsigned seconds = 120;                           // of its time and of ours
};

struct ApartResult {
  std::string bytes;    // what `work` returned
  std::string failure;  // how the child ended, for a message; empty: well
};

// Calls `work` in a forked child of this process and hands over what it returns, so that a library
// that trips over a hostile file (aborts, writes through wild pointers, never ends, eats the
// memory) ends the child and not us. What it prints is lost. `work` must not throw, and must not
// count on other threads: the child has none. Whatever the host does with signals and its children
// (ignores SIGCHLD, blocks signals, waits for any child): a child that outlives the limits by two
// seconds is killed, and bytes that came whole are good.
ApartResult run_apart(const std::function<std::string()>& work, const ApartLimits& limits = {});

}  // namespace limber

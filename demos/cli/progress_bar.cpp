#include "demos/cli/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>

namespace limber::demos {
namespace {

constexpr int kWidth = 30;                               // characters
constexpr auto kPause = std::chrono::milliseconds(100);  // between two drawings
constexpr const char* kWipe = "\r\x1b[K";                // to the line's start, clear it

// Only the process's own standard error can be a terminal; a test's string stream never is.
bool is_terminal(const std::ostream& stream) {
  return &stream == &std::cerr && ::isatty(STDERR_FILENO) == 1;
}

}  // namespace

ProgressBar::ProgressBar(std::ostream& stream) : ProgressBar(stream, is_terminal(stream)) {}

ProgressBar::ProgressBar(std::ostream& stream, bool is_terminal)
    : stream_(stream), is_terminal_(is_terminal) {}

ProgressBar::~ProgressBar() {
  if (drawn_) stream_ << kWipe << std::flush;
}

void ProgressBar::show(const std::string& what, double fraction) {
  if (!is_terminal_) return;
  const auto now = std::chrono::steady_clock::now();
  if (drawn_ && what == last_what_ && now - last_time_ < kPause) return;
  const double shown = std::clamp(fraction, 0.0, 1.0);
  const int full = static_cast<int>(shown * kWidth);
  stream_ << fmt::format("{}{} [{:#<{}}{:.<{}}] {:3.0f} %", kWipe, what, "", full, "",
                         kWidth - full, 100.0 * shown)
          << std::flush;
  drawn_ = true;
  last_what_ = what;
  last_time_ = now;
}

}  // namespace limber::demos

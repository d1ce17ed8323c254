#pragma once

#include <chrono>
#include <iosfwd>
#include <string>

namespace limber::demos {

// One line on a terminal that shows how far long work is, and nothing at all elsewhere. The line is
// wiped when the bar goes, also by an exception, before anything else is printed.
class ProgressBar {
 public:
  explicit ProgressBar(std::ostream& stream);  // decides by itself
  ProgressBar(std::ostream& stream, bool is_terminal);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // Redraws a few times a second at most, so it may be called as often as is convenient.
  void show(const std::string& what, double fraction);

 private:
  std::ostream& stream_;
  bool is_terminal_;
  bool drawn_ = false;
  std::string last_what_;
  std::chrono::steady_clock::time_point last_time_;
};

}  // namespace limber::demos

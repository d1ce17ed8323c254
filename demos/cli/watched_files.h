#pragma once

#include <cstdint>
#include <filesystem>
#include <map>

namespace limber::demos {

// Files of which one wants to know when they are saved. They are asked for, not waited for: that
// works on every system, and a scene reads few.
class WatchedFiles {
 public:
  // As it is now; call it before the file is read, so that nothing is missed that is written in
  // between. One that is not there yet may be named as well. The first time counts.
  void add(const std::filesystem::path& file);

  // Is any of them another one than when it was added? One that has gone is not, yet: editors take
  // a file away before they put the new one in its place.
  bool changed() const;

  void clear() { stamps_.clear(); }

 private:
  struct Stamp {
    bool there = false;
    std::filesystem::file_time_type saved;
    std::uintmax_t bytes = 0;

    bool operator==(const Stamp&) const = default;
  };
  static Stamp stamp_of(const std::filesystem::path& file);

  std::map<std::filesystem::path, Stamp> stamps_;
};

}  // namespace limber::demos

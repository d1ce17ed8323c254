#include "demos/cli/watched_files.h"

#include <algorithm>
#include <system_error>

namespace limber::demos {

WatchedFiles::Stamp WatchedFiles::stamp_of(const std::filesystem::path& file) {
  std::error_code trouble;
  Stamp stamp;
  stamp.saved = std::filesystem::last_write_time(file, trouble);
  if (trouble) return {};
  stamp.bytes = std::filesystem::file_size(file, trouble);
  if (trouble) return {};
  stamp.there = true;
  return stamp;
}

void WatchedFiles::add(const std::filesystem::path& file) {
  stamps_.try_emplace(file, stamp_of(file));
}

bool WatchedFiles::changed() const {
  return std::ranges::any_of(stamps_, [](const auto& watched) {
    const Stamp now = stamp_of(watched.first);
    return now.there && now != watched.second;
  });
}

}  // namespace limber::demos

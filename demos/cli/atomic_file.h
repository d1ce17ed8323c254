#pragma once

#include <filesystem>
#include <string_view>

namespace limber::demos {

// Refuses with an InputError a path that write_file_atomically could not write: a missing folder,
// missing rights, a folder instead of a file. Asked before long work starts, whose result would
// otherwise have nowhere to go. Leaves no trace.
void require_writable(const std::filesystem::path& target);

// All or nothing: the contents are written beside the target and renamed into place, so that a
// reader never sees half a file and a failure leaves the old one. Links are followed; the rights of
// an existing file are kept. What is no regular file (a pipe, /dev/null) is written directly.
void write_file_atomically(const std::filesystem::path& target, std::string_view contents);

}  // namespace limber::demos

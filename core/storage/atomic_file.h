#pragma once

#include <filesystem>
#include <string_view>

namespace limber {

// A new file beside its target, to be written through path() or descriptor() and then renamed into
// place: a reader never sees half a file, and without commit() the old one stays and this one is
// gone. Links are followed; the rights of an existing file are kept. Throws InputError where the
// target cannot be written or is no regular file.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& target);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  const std::filesystem::path& path() const { return path_; }
  int descriptor() const { return descriptor_; }  // for reading and writing

  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path path_;
  int descriptor_ = -1;
};

// Refuses with an InputError a path that write_file_atomically could not write: a missing folder,
// missing rights, a folder instead of a file. Asked before long work starts, whose result would
// otherwise have nowhere to go. Leaves no trace.
void require_writable(const std::filesystem::path& target);

// All or nothing, as AtomicFile. What is no regular file (a pipe, /dev/null) is written directly.
void write_file_atomically(const std::filesystem::path& target, std::string_view contents);

// The one message for a file that cannot be written, from an error number of the system's.
[[noreturn]] void refuse_writing(const std::filesystem::path& target, int error);

}  // namespace limber

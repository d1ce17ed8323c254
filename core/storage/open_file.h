#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace limber {

// A regular file, open for reading. Throws InputError where there is none or it cannot be read.
class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& path);
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile();

  const std::filesystem::path& path() const { return path_; }
  std::uintmax_t size() const { return size_; }  // bytes, when it was opened
  int descriptor() const { return descriptor_; }

 private:
  std::filesystem::path path_;
  int descriptor_;
  std::uintmax_t size_ = 0;
};

// How many bytes from `offset` on were there to read, at most `count`; `file` is for messages.
std::size_t read_at(int descriptor, std::uintmax_t offset, void* into, std::size_t count,
                    const std::filesystem::path& file);

}  // namespace limber

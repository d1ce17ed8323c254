#include "core/storage/open_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "core/model/errors.h"

namespace limber {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_reading(const fs::path& file, int error) {
  throw InputError({file.string(), std::string("cannot be read: ") + std::strerror(error),
                    "name a file that exists and that you may read"});
}

}  // namespace

// O_NONBLOCK: without waiting for the other end of a pipe.
OpenFile::OpenFile(const fs::path& path)
    : path_(path), descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  if (descriptor_ < 0) refuse_reading(path, errno);
  struct stat status;
  const bool regular = ::fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode);
  if (!regular) {
    ::close(descriptor_);
    throw InputError({path.string(), "is no regular file", "name a file that Limber wrote"});
  }
  size_ = static_cast<std::uintmax_t>(status.st_size);
}

OpenFile::~OpenFile() { ::close(descriptor_); }

std::size_t read_at(int descriptor, std::uintmax_t offset, void* into, std::size_t count,
                    const fs::path& file) {
  std::size_t done = 0;
  while (done < count) {
    const ssize_t n = ::pread(descriptor, static_cast<char*>(into) + done, count - done,
                              static_cast<off_t>(offset + done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) refuse_reading(file, errno);
    if (n == 0) break;
    done += static_cast<std::size_t>(n);
  }
  return done;
}

}  // namespace limber

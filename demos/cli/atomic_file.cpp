#include "demos/cli/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include "core/model/errors.h"

namespace limber::demos {
namespace {

namespace fs = std::filesystem;

std::string remedy_for(int error) {
  switch (error) {
    case ENOENT:
    case ENOTDIR:
      return "make the folder first or name another one";
    case EISDIR:
      return "name a file in it";
    case ENOSPC:
    case EDQUOT:
      return "make room or choose another disk";
    default:
      return "choose a place where you may write";
  }
}

[[noreturn]] void refuse(const fs::path& target, int error) {
  throw InputError({target.string(), fmt::format("cannot be written: {}", std::strerror(error)),
                    remedy_for(error)});
}

// A new file beside the target that is gone again unless it was renamed.
class FileBeside {
 public:
  explicit FileBeside(const fs::path& target) : target_(target), path_(unused_name(target)) {
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0) refuse(target_, errno);
  }
  FileBeside(const FileBeside&) = delete;
  FileBeside& operator=(const FileBeside&) = delete;
  ~FileBeside() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!path_.empty()) ::unlink(path_.c_str());
  }

  int descriptor() const { return descriptor_; }

  void rename_into_place() {
    // Without the sync a power cut could leave the new name on empty contents.
    if (::fsync(descriptor_) != 0) refuse(target_, errno);
    if (::close(std::exchange(descriptor_, -1)) != 0) refuse(target_, errno);
    if (::rename(path_.c_str(), target_.c_str()) != 0) refuse(target_, errno);
    path_.clear();
  }

 private:
  static fs::path unused_name(const fs::path& target) {
    static std::atomic<int> count = 0;
    return target.parent_path() /
           fmt::format(".{}.{}-{}.tmp", target.filename().string(), ::getpid(), ++count);
  }

  fs::path target_;
  fs::path path_;
  int descriptor_ = -1;
};

void write_all(int descriptor, std::string_view contents, const fs::path& target) {
  while (!contents.empty()) {
    const ssize_t n = ::write(descriptor, contents.data(), contents.size());
    if (n < 0 && errno != EINTR) refuse(target, errno);
    if (n > 0) contents.remove_prefix(static_cast<std::size_t>(n));
  }
}

void write_directly(const fs::path& target, std::string_view contents) {
  const int descriptor = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) refuse(target, errno);
  try {
    write_all(descriptor, contents, target);
  } catch (...) {
    ::close(descriptor);
    throw;
  }
  ::close(descriptor);
}

// Where the name really leads: renaming onto a link would replace the link.
fs::path resolved(const fs::path& target) {
  std::error_code ignored;
  const fs::path real = fs::weakly_canonical(target, ignored);
  return ignored || real.empty() ? target : real;
}

bool is_special(const fs::path& target) {
  std::error_code ignored;
  const fs::file_status status = fs::status(target, ignored);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

void refuse_unwritable_existing(const fs::path& target) {
  std::error_code ignored;
  if (fs::is_directory(target, ignored)) refuse(target, EISDIR);
  if (fs::exists(target, ignored) && ::access(target.c_str(), W_OK) != 0) refuse(target, errno);
}

}  // namespace

void require_writable(const fs::path& target) {
  const fs::path real = resolved(target);
  refuse_unwritable_existing(real);
  if (!is_special(real)) FileBeside probe(real);
}

void write_file_atomically(const fs::path& target, std::string_view contents) {
  const fs::path real = resolved(target);
  refuse_unwritable_existing(real);
  if (is_special(real)) return write_directly(real, contents);
  FileBeside file(real);
  struct stat old;
  if (::stat(real.c_str(), &old) == 0) ::fchmod(file.descriptor(), old.st_mode & 07777);
  write_all(file.descriptor(), contents, real);
  file.rename_into_place();
}

}  // namespace limber::demos

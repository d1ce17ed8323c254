#include "core/storage/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include "core/model/errors.h"

namespace limber {
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

void write_all(int descriptor, std::string_view contents, const fs::path& target) {
  while (!contents.empty()) {
    const ssize_t n = ::write(descriptor, contents.data(), contents.size());
    if (n < 0 && errno != EINTR) refuse_writing(target, errno);
    if (n > 0) contents.remove_prefix(static_cast<std::size_t>(n));
  }
}

void write_directly(const fs::path& target, std::string_view contents) {
  const int descriptor = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) refuse_writing(target, errno);
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
  if (fs::is_directory(target, ignored)) refuse_writing(target, EISDIR);
  if (fs::exists(target, ignored) && ::access(target.c_str(), W_OK) != 0)
    refuse_writing(target, errno);
}

fs::path unused_name(const fs::path& target) {
  static std::atomic<int> count = 0;
  return target.parent_path() /
         ('.' + target.filename().string() + "." + std::to_string(::getpid()) + "-" +
          std::to_string(++count) + ".tmp");
}

}  // namespace

void refuse_writing(const fs::path& target, int error) {
  throw InputError({target.string(), std::string("cannot be written: ") + std::strerror(error),
                    remedy_for(error)});
}

AtomicFile::AtomicFile(const fs::path& target) : target_(resolved(target)) {
  refuse_unwritable_existing(target_);
  if (is_special(target_))
    throw InputError({target.string(), "is no regular file", "name a file on a disk"});
  do {  // what a crashed run of the same number left behind is not ours to take away
    path_ = unused_name(target_);
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ >= 0) return;
  path_.clear();
  refuse_writing(target_, errno);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!path_.empty()) ::unlink(path_.c_str());
}

void AtomicFile::commit() {
  struct stat old;
  if (::stat(target_.c_str(), &old) == 0) ::fchmod(descriptor_, old.st_mode & 07777);
  // Without the sync a power cut could leave the new name on empty contents.
  if (::fsync(descriptor_) != 0) refuse_writing(target_, errno);
  if (::close(std::exchange(descriptor_, -1)) != 0) refuse_writing(target_, errno);
  if (::rename(path_.c_str(), target_.c_str()) != 0) refuse_writing(target_, errno);
  path_.clear();
}

void require_writable(const fs::path& target) {
  if (is_special(target)) return refuse_unwritable_existing(target);
  AtomicFile probe(target);
}

void write_file_atomically(const fs::path& target, std::string_view contents) {
  if (is_special(target)) {
    refuse_unwritable_existing(target);
    return write_directly(target, contents);
  }
  AtomicFile file(target);
  write_all(file.descriptor(), contents, target);
  file.commit();
}

}  // namespace limber

#pragma once

#include <signal.h>
#include <sys/resource.h>

namespace limber::test {

// As on a full disk: no file of this process may grow beyond so many bytes while this lives.
class TinyDisk {
 public:
  explicit TinyDisk(unsigned long bytes) {
    old_handler_ = ::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &old_);
    rlimit tiny = old_;
    tiny.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &tiny);
  }
  ~TinyDisk() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    ::signal(SIGXFSZ, old_handler_);
  }
  TinyDisk(const TinyDisk&) = delete;
  TinyDisk& operator=(const TinyDisk&) = delete;

 private:
  rlimit old_{};
  sighandler_t old_handler_;
};

}  // namespace limber::test

#include "core/modeller/run_apart.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>

namespace limber {
namespace {

void limit(int resource, rlim_t most) {
  rlimit now{};
  if (::getrlimit(resource, &now) != 0) return;
  now.rlim_cur = now.rlim_max == RLIM_INFINITY || most < now.rlim_max ? most : now.rlim_max;
  ::setrlimit(resource, &now);
}

// Address space in use, bytes; sanitizers use terabytes of it.
rlim_t address_space() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

// No crash handlers of the host's, no core dumps, no output, no more than the limits.
void shut_in(const ApartLimits& limits) {
  for (int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGALRM, SIGXCPU})
    std::signal(signal, SIG_DFL);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, limits.seconds);
  if (const rlim_t used = address_space(); used > 0) limit(RLIMIT_AS, used + limits.memory_bytes);
  ::alarm(limits.seconds);
}

[[noreturn]] void be_child(int out, const std::function<std::string()>& work,
                           const ApartLimits& limits) {
  shut_in(limits);
  const std::string bytes = work();
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t n = ::write(out, bytes.data() + done, bytes.size() - done);
    if (n <= 0) ::_exit(1);
    done += static_cast<std::size_t>(n);
  }
  ::_exit(0);  // nobody's destructors and exit handlers but this process's own
}

std::string read_all(int in) {
  std::string bytes;
  std::array<char, 1 << 16> buffer;
  for (;;) {
    const ssize_t n = ::read(in, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return bytes;
    bytes.append(buffer.data(), static_cast<std::size_t>(n));
  }
}

std::string ending_of(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return "its process was lost";
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    if (signal == SIGALRM || signal == SIGXCPU) return "it took too long";
    return std::string("the reader crashed (") + ::strsignal(signal) + ")";
  }
  return WEXITSTATUS(status) == 0 ? "" : "the reader failed";
}

}  // namespace

ApartResult run_apart(const std::function<std::string()>& work, const ApartLimits& limits) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return {"", std::string("no pipe: ") + std::strerror(errno)};
  const pid_t child = ::fork();
  if (child == 0) be_child(ends[1], work, limits);
  ::close(ends[1]);
  ApartResult result;
  if (child < 0) {
    result.failure = std::string("no process: ") + std::strerror(errno);
  } else {
    result.bytes = read_all(ends[0]);
    result.failure = ending_of(child);
  }
  ::close(ends[0]);
  return result;
}

}  // namespace limber

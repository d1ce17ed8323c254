#include "core/modeller/run_apart.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <fstream>

namespace limber {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kGrace{2};  // for the child to end by its own limits

// The hard limit is one above: of CPU time the second after SIGXCPU, which can be ignored, the
// child is killed.
void limit(int resource, rlim_t most) {
  rlimit now{};
  if (::getrlimit(resource, &now) != 0) return;
  now.rlim_max = std::min(now.rlim_max, most + 1);  // RLIM_INFINITY is the largest number
  now.rlim_cur = std::min(now.rlim_max, most);
  ::setrlimit(resource, &now);
}

// Address space in use, bytes; sanitizers use terabytes of it.
rlim_t address_space() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

// The host's handlers are not for the child, and signals that the host blocks would not end it.
void hear_all_signals() {
  for (int signal :
       {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGALRM, SIGXCPU, SIGTERM, SIGINT, SIGPIPE})
    std::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
}

// No core dumps, no output, no more than the limits.
void shut_in(const ApartLimits& limits) {
  hear_all_signals();
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, limits.seconds);
  if (const rlim_t used = address_space(); used > 0) limit(RLIMIT_AS, used + limits.memory_bytes);
  ::alarm(limits.seconds);
}

void write_all(int out, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t n = ::write(out, bytes, count);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) ::_exit(1);
    bytes += n;
    count -= static_cast<std::size_t>(n);
  }
}

// Sends the number of bytes, then the bytes.
[[noreturn]] void be_child(int out, const std::function<std::string()>& work,
                           const ApartLimits& limits) {
  shut_in(limits);
  const std::string bytes = work();
  const std::uint64_t count = bytes.size();
  write_all(out, reinterpret_cast<const char*>(&count), sizeof count);
  write_all(out, bytes.data(), bytes.size());
  ::_exit(0);  // nobody's destructors and exit handlers but this process's own
}

// Waits until there is something to read, or the other end is closed. False: too late.
bool wait_for_input(int in, Clock::time_point deadline) {
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
    if (left.count() <= 0) return false;
    pollfd end{in, POLLIN, 0};
    const int ready = ::poll(&end, 1, static_cast<int>(left.count()));
    if (ready > 0 || (ready < 0 && errno != EINTR)) return true;
  }
}

// All that came so far, and why there is no more.
struct Received {
  std::string bytes;
  bool late = false;

  bool complete() const {
    std::uint64_t count = 0;
    if (bytes.size() < sizeof count) return false;
    std::memcpy(&count, bytes.data(), sizeof count);
    return bytes.size() - sizeof count == count;
  }
};

// Not until the end of file: another child of the host's may hold the other end open.
Received receive(int in, Clock::time_point deadline) {
  Received received;
  std::array<char, 1 << 16> buffer;
  while (!received.complete()) {
    received.late = !wait_for_input(in, deadline);
    if (received.late) break;
    const ssize_t n = ::read(in, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    received.bytes.append(buffer.data(), static_cast<std::size_t>(n));
  }
  return received;
}

std::string failure_of(int status) {
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    if (signal == SIGALRM || signal == SIGXCPU) return "it took too long";
    return std::string("the reader crashed (") + ::strsignal(signal) + ")";
  }
  return "the reader failed";
}

// What came decides. How the child ended only explains why nothing did: a host that ignores SIGCHLD
// or waits for all its children leaves us no status (ECHILD).
std::string ending_of(pid_t child, const Received& received) {
  if (received.late) ::kill(child, SIGKILL);
  int status = 0;
  pid_t ended = 0;
  do ended = ::waitpid(child, &status, 0);
  while (ended < 0 && errno == EINTR);
  if (received.late) return "it took too long";
  if (received.complete()) return "";
  return ended < 0 ? "the reader failed" : failure_of(status);
}

}  // namespace

ApartResult run_apart(const std::function<std::string()>& work, const ApartLimits& limits) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return {"", std::string("no pipe: ") + std::strerror(errno)};
  const auto deadline = Clock::now() + std::chrono::seconds(limits.seconds) + kGrace;
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);  // so that it does not wait for a parent that is gone
    be_child(ends[1], work, limits);
  }
  ::close(ends[1]);
  ApartResult result;
  if (child < 0) {
    result.failure = std::string("no process: ") + std::strerror(errno);
  } else {
    const Received received = receive(ends[0], deadline);
    result.failure = ending_of(child, received);
    if (result.failure.empty()) result.bytes = received.bytes.substr(sizeof(std::uint64_t));
  }
  ::close(ends[0]);
  return result;
}

}  // namespace limber

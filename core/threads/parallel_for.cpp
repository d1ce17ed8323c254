#include "core/threads/parallel_for.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <memory>
#include <mutex>
#include <string>

#include "core/model/errors.h"

namespace limber {
namespace {

int thread_count = 1;
std::unique_ptr<tbb::task_arena> arena;  // none for one thread

// Which of several exceptions is told must not depend on timing: the one of the lowest range, and
// no range is left out for another's.
class LowestFailure {
 public:
  template <class Body>
  void guard(std::size_t range, const Body& body) {
    try {
      body();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (range < range_) {
        range_ = range;
        failure_ = std::current_exception();
      }
    }
  }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::mutex mutex_;
  std::size_t range_ = std::numeric_limits<std::size_t>::max();
  std::exception_ptr failure_;
};

// In the arena.
template <class Partitioner>
void run_ranges(std::size_t count, std::size_t grain, const RangeBody& body,
                const Partitioner& partitioner) {
  const std::size_t ranges = (count + grain - 1) / grain;
  LowestFailure failure;
  const auto run = [&](std::size_t r) {
    failure.guard(r, [&] { body(r * grain, std::min(count, (r + 1) * grain)); });
  };
  arena->execute([&] { tbb::parallel_for(std::size_t{0}, ranges, run, partitioner); });
  failure.rethrow();
}

}  // namespace

void set_threads(int count) {
  if (count < 1) {
    throw InputError(
        {"threads", "the number of threads is " + std::to_string(count), "give 1 or more"});
  }
  arena = count > 1 ? std::make_unique<tbb::task_arena>(count) : nullptr;
  thread_count = count;
}

int threads() { return thread_count; }

void parallel_for(std::size_t count, std::size_t grain, RangeBody body) {
  if (thread_count == 1 || count <= 2 * grain) {
    body(0, count);
    return;
  }
  run_ranges(count, grain, body, tbb::static_partitioner());
}

void parallel_tasks(std::size_t count, RangeBody body) {
  if (thread_count == 1 || count <= 1) {
    body(0, count);
    return;
  }
  run_ranges(count, 1, body, tbb::simple_partitioner());
}

}  // namespace limber

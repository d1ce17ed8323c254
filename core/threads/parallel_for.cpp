#include "core/threads/parallel_for.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <memory>
#include <string>

#include "core/model/errors.h"

namespace limber {
namespace {

int thread_count = 1;
std::unique_ptr<tbb::task_arena> arena;  // none for one thread

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
  const std::size_t ranges = (count + grain - 1) / grain;
  arena->execute([&] {
    tbb::parallel_for(
        std::size_t{0}, ranges,
        [&](std::size_t r) { body(r * grain, std::min(count, (r + 1) * grain)); },
        tbb::static_partitioner());
  });
}

}  // namespace limber

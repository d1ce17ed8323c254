#include "core/threads/parallel_for.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/model/errors.h"

namespace limber {
namespace {

// Back to one thread at the end, also of a test that failed.
class Threads {
 public:
  explicit Threads(int count) { set_threads(count); }
  ~Threads() { set_threads(1); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;
};

using Range = std::pair<std::size_t, std::size_t>;

// Every call of the body; two equal ones show as one more in `calls`.
struct Calls {
  std::set<Range> ranges;
  std::size_t calls = 0;
};

Calls calls_of(std::size_t count, std::size_t grain) {
  Calls seen;
  std::mutex mutex;
  parallel_for(count, grain, [&](std::size_t from, std::size_t to) {
    const std::scoped_lock lock(mutex);
    seen.ranges.insert({from, to});
    ++seen.calls;
  });
  return seen;
}

class ParallelFor : public testing::TestWithParam<int> {
 protected:
  Threads threads_{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Threads, ParallelFor, testing::Values(1, 2, 4));

TEST_P(ParallelFor, RunsEachOfSomeTasksOnce) {
  for (std::size_t count : {0u, 1u, 2u, 3u, 50u}) {
    std::vector<std::atomic<int>> visits(count);
    parallel_tasks(count, [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i) ++visits[i];
    });
    for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(visits[i], 1) << i << " of " << count;
  }
}

TEST_P(ParallelFor, TellsTheFailureOfTheLowestTask) {
  const auto fail = [](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      if (i % 3 == 1) throw std::runtime_error(std::to_string(i));
    }
  };
  try {
    parallel_tasks(20, fail);
    ADD_FAILURE();
  } catch (const std::runtime_error& failure) {
    EXPECT_STREQ(failure.what(), "1");
  }
}

TEST_P(ParallelFor, VisitsEveryIndexOnce) {
  for (std::size_t grain : {1u, 7u, 64u}) {
    for (std::size_t count : {std::size_t{1}, grain, 2 * grain, 2 * grain + 1, 10 * grain,
                              10 * grain + 3, std::size_t{1000}}) {
      std::vector<std::atomic<int>> visits(count);
      parallel_for(count, grain, [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) ++visits[i];
      });
      for (std::size_t i = 0; i < count; ++i) {
        ASSERT_EQ(visits[i], 1) << i << " of " << count << ", grain " << grain;
      }
    }
  }
}

TEST_P(ParallelFor, OfNothingVisitsNothing) {
  for (const Range& range : calls_of(0, 8).ranges) EXPECT_EQ(range, Range(0, 0));
}

// Callers keep one result per range at from / grain.
TEST_P(ParallelFor, RangesBeginAtMultiplesOfTheGrain) {
  for (std::size_t count : {17u, 64u, 999u, 1000u}) {
    const Calls seen = calls_of(count, 8);
    EXPECT_EQ(seen.calls, seen.ranges.size());
    for (const auto& [from, to] : seen.ranges) {
      EXPECT_EQ(from % 8, 0u);
      EXPECT_TRUE(to == count || GetParam() == 1 || to == from + 8) << from << " " << to;
    }
  }
}

TEST_P(ParallelFor, RunsInOneRangeUpToTwoGrains) {
  EXPECT_EQ(calls_of(16, 8).ranges, (std::set<Range>{{0, 16}}));
  EXPECT_EQ(calls_of(17, 8).calls, GetParam() == 1 ? 1u : 3u);
}

TEST_P(ParallelFor, PassesAnExceptionOnAndRunsOnAfterwards) {
  const auto fail_at = [](std::size_t bad) {
    parallel_for(1000, 8, [&](std::size_t from, std::size_t to) {
      if (from <= bad && bad < to) throw std::runtime_error("at " + std::to_string(bad));
    });
  };
  for (std::size_t bad : {0u, 500u, 999u}) {
    try {
      fail_at(bad);
      ADD_FAILURE() << "no exception";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(), "at " + std::to_string(bad));
    }
    EXPECT_NO_THROW(fail_at(2000));
  }
}

// And every range runs.
TEST_P(ParallelFor, PassesOnTheExceptionOfTheLowestRange) {
  for (int repeat = 0; repeat < 50; ++repeat) {
    std::atomic<int> ranges = 0;
    try {
      parallel_for(1000, 10, [&](std::size_t from, std::size_t) {
        ++ranges;
        if (from >= 370 || GetParam() == 1) throw std::runtime_error(std::to_string(from));
      });
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), GetParam() == 1 ? "0" : "370");
      EXPECT_EQ(ranges, GetParam() == 1 ? 1 : 100);
    }
  }
}

TEST_P(ParallelFor, RunsInsideOfItself) {
  constexpr std::size_t kRows = 50, kColumns = 70;
  std::vector<std::atomic<int>> visits(kRows * kColumns);
  parallel_for(kRows, 2, [&](std::size_t first_row, std::size_t end_row) {
    for (std::size_t row = first_row; row < end_row; ++row) {
      parallel_for(kColumns, 3, [&, row](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) ++visits[row * kColumns + i];
      });
    }
  });
  for (std::size_t i = 0; i < visits.size(); ++i) ASSERT_EQ(visits[i], 1) << i;
}

TEST_P(ParallelFor, KnowsItsNumberOfThreads) { EXPECT_EQ(threads(), GetParam()); }

TEST(SetThreads, RefusesLessThanOneAndStaysAsItWas) {
  const Threads two(2);
  for (int bad : {0, -3}) EXPECT_THROW(set_threads(bad), InputError);
  EXPECT_EQ(threads(), 2);
  EXPECT_EQ(calls_of(17, 8).calls, 3u);
}

}  // namespace
}  // namespace limber

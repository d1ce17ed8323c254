#include "tests/fuzz/coverage.h"

#include <array>
#include <bit>
#include <cstdint>

namespace limber::demos::fuzz {
namespace {

constexpr std::size_t kPlaces = std::size_t{1} << 16;
std::array<std::uint8_t, kPlaces> counts;
std::array<std::uint8_t, kPlaces> seen;  // a bit for each size of count
std::size_t known = 0;

}  // namespace

void forget_run() { counts.fill(0); }

std::size_t new_places() {
  std::size_t fresh = 0;
  for (std::size_t i = 0; i < kPlaces; ++i) {
    if (counts[i] == 0) continue;
    const auto bit = static_cast<std::uint8_t>(1u << (std::bit_width(counts[i]) - 1));
    if (seen[i] & bit) continue;
    seen[i] |= bit;
    ++fresh;
  }
  known += fresh;
  return fresh;
}

std::size_t places() { return known; }

}  // namespace limber::demos::fuzz

// Called by the compiler's instrumentation at every branch.
extern "C" void __sanitizer_cov_trace_pc() {
  using namespace limber::demos::fuzz;
  auto at = reinterpret_cast<std::uintptr_t>(__builtin_return_address(0));
  at ^= at >> 16;
  std::uint8_t& count = counts[at % kPlaces];
  if (count < 255) ++count;
}

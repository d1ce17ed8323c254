#pragma once

#include <cstdint>
#include <random>

#include "core/model/bounds.h"

namespace limber {

// The same numbers everywhere: std::mt19937_64 is, the standard library's distributions are not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  // In [0, 1), 53 bits.
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

  double in(double low, double high) { return low + (high - low) * uniform(); }

  Vec3 in_box(const Box3& box) {
    const double x = uniform(), y = uniform(), z = uniform();
    return box.min() + Vec3(x, y, z).cwiseProduct(box.sizes());
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace limber

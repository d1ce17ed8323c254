#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/model/physical_model.h"

namespace limber {

// What the vector kernels count lengths in: positions are whole numbers of quanta modulo 2^32, so
// that differences of neighbours are exact wherever in the world they are.
class Quanta {
 public:
  // For springs of these rest lengths, m. A quantum is 2^-25 of the shortest (a strain of 3e-8), or
  // more where the longest would else not have room: 2^-28 of it leaves a factor of 4 up to
  // longest_measurable(). A power of two: scaling by it rounds nothing.
  Quanta(double shortest, double longest)
      : quantum_(std::ldexp(1.0, std::max(std::ilogb(shortest) - 25, std::ilogb(longest) - 27))),
        per_metre_(1.0 / quantum_) {}
  Quanta() : Quanta(1.0, 1.0) {}

  double quantum() const { return quantum_; }  // m

  // Springs up to this length are what they seem, m. Twice that, and their difference wraps round.
  double longest_measurable() const { return 0x1p30 * quantum_; }

  // Could a spring that was measurable be past where it wraps, dt (s) later, if no component of an
  // end's velocity is above this, quanta/s? Also true for what is not a number.
  static bool may_wrap(double speed, double dt) { return !(speed * dt < 0x1p27); }
  double speed(double m_s) const { return m_s * per_metre_; }  // quanta/s

  // The nearest whole number, modulo 2^32: adding 1.5 x 2^52 leaves it in the lowest bits of the
  // sum's mantissa, as long as x is less than 2^51 quanta.
  std::int32_t count(double x) const {
    return static_cast<std::int32_t>(std::bit_cast<std::uint64_t>(x * per_metre_ + 0x1.8p52));
  }

  // Of a spring in the kernels' units.
  float rest_length(double rest) const { return static_cast<float>(rest * per_metre_); }
  float damping(double c) const { return static_cast<float>(c * per_metre_); }

  // Bounds of L^2 - L0^2, quanta^2, past which a spring may have passed its threshold, or what is
  // measurable. Nearer to zero by what rounding may take: the kernels flag too many rather than too
  // few.
  float longest(double rest, double break_threshold) const {
    return bound(rest, std::min(rest + break_threshold, longest_measurable()));
  }
  float shortest(double rest, double crush_threshold) const {
    return crush_threshold < rest ? bound(rest, rest - crush_threshold) : -kNever;
  }

  static constexpr float kNever = std::numeric_limits<float>::infinity();

 private:
  // 1e-6: sixteen times the rounding of single precision. Both ends rounded to half a quantum, in
  // three components, are sqrt(3) quanta of length, twice that times b of its square.
  float bound(double rest, double length) const {
    const double a = rest * per_metre_, b = length * per_metre_;
    const double rounding = 1e-6 * a * a + 4.0 * b;
    return static_cast<float>((b - a) * (b + a) * (1.0 - 1e-6) - std::copysign(rounding, b - a));
  }

  double quantum_;
  double per_metre_;
};

// Can the kernels' units hold springs with these extremes? Constants end before single precision
// does, at 3.4e38, with room for the squares of lengths; `most_spread` is of rest lengths.
inline bool fits_single_precision(double shortest, double longest, double stiffness, double damping,
                                  double most_spread) {
  if (!(shortest > 1e-12 && longest >= shortest && longest <= most_spread * shortest &&
        longest < 1e12))
    return false;
  return stiffness < 1e15 && damping / Quanta(shortest, longest).quantum() < 1e20;
}

}  // namespace limber

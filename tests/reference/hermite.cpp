#include "tests/reference/hermite.h"

#include <algorithm>
#include <cmath>

namespace limber::reference {
namespace {

// Cubic c0 + c1 s + c2 s^2 + c3 s^3 over s from 0 to 1.
struct Cubic {
  double c0, c1, c2, c3;
  double at(double s) const { return c0 + s * (c1 + s * (c2 + s * c3)); }
};

Cubic cubic_between(const Reading& a, const Reading& b) {
  const double h = b.time - a.time, rise = b.value - a.value;
  return {a.value, h * a.rate, 3.0 * rise - h * (2.0 * a.rate + b.rate),
          h * (a.rate + b.rate) - 2.0 * rise};
}

// Where c1 + 2 c2 s + 3 c3 s^2 changes from the sign of c1, in a form that does not cancel.
double stationary_point(const Cubic& c) {
  const double root = std::sqrt(std::max(0.0, c.c2 * c.c2 - 3.0 * c.c1 * c.c3));
  return -c.c1 / (c.c2 + std::copysign(root, -c.c1));
}

}  // namespace

std::optional<Reading> extremum_between(const Reading& a, const Reading& b) {
  if (!(a.rate * b.rate < 0.0)) return std::nullopt;
  const Cubic cubic = cubic_between(a, b);
  const double s = stationary_point(cubic);
  if (!(s >= 0.0 && s <= 1.0)) return std::nullopt;
  return Reading{a.time + s * (b.time - a.time), cubic.at(s), 0.0};
}

void PeakRecorder::read(const Reading& now) {
  if (!empty_) {
    if (const auto between = extremum_between(last_, now)) consider(*between);
  } else {
    highest_ = lowest_ = now;
    empty_ = false;
  }
  consider(now);
  last_ = now;
}

const Reading& PeakRecorder::farthest() const {
  return highest_.value > -lowest_.value ? highest_ : lowest_;
}

void PeakRecorder::consider(const Reading& reading) {
  if (reading.value > highest_.value) highest_ = reading;
  if (reading.value < lowest_.value) lowest_ = reading;
}

}  // namespace limber::reference

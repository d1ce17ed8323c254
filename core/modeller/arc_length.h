#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace limber {

// Internal to the geometric modellers: cumulative length of a sampled curve, and the way back.
class ArcLength {
 public:
  // The parameters of the samples, ascending, at least two.
  explicit ArcLength(std::vector<double> parameter) : parameter_(std::move(parameter)) {}

  // The distance to the next sample; as many as there are samples, less one.
  void append(double step) { length_.push_back(length_.back() + step); }
  double total() const { return length_.back(); }

  double parameter_at(double length) const {
    const auto above = std::upper_bound(length_.begin() + 1, length_.end() - 1, length);
    const std::size_t i = static_cast<std::size_t>(above - length_.begin());
    const double step = length_[i] - length_[i - 1];
    const double t = step > 0.0 ? (length - length_[i - 1]) / step : 0.0;
    return std::lerp(parameter_[i - 1], parameter_[i], t);
  }

 private:
  std::vector<double> parameter_;
  std::vector<double> length_ = {0.0};
};

// first, ..., last in `steps` equal steps.
inline std::vector<double> evenly(double first, double last, int steps) {
  std::vector<double> values;
  for (int i = 0; i <= steps; ++i) values.push_back(std::lerp(first, last, double(i) / steps));
  return values;
}

}  // namespace limber

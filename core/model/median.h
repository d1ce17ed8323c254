#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace limber {

// The middle value of a sorted list, the larger of the two in the middle of an even number: always
// a value that is there. 0 for none. In linear time.
inline double upper_median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace limber

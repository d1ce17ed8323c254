#pragma once

#include <vector>

#include "tests/reference/hermite.h"
#include "tests/reference/run.h"

namespace limber::reference {

// Follows the stretch of every edge, read once a step; peaks between two steps count.
class EdgeRecorder {
 public:
  explicit EdgeRecorder(const Run& run);

  void read(const Run& run);

  // The edge that was longer or shorter than any other; of those that tie, the first.
  std::size_t farthest() const;

  double distance(std::size_t edge) const;  // largest |L - L0| so far, m
  const std::vector<PeakRecorder>& peaks() const { return peaks_; }

 private:
  std::vector<PeakRecorder> peaks_;  // shape (edges)
};

// Steps on until each of the edges had an extremum of its stretch; returns the first ones, in the
// order of `edges`. Smaller ones than `least` (m) do not count: rounding makes edges tremble that
// nothing has reached yet.
std::vector<Reading> first_extrema(Run& run, const std::vector<std::size_t>& edges, double dt,
                                   double least);

}  // namespace limber::reference

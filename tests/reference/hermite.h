#pragma once

#include <optional>

namespace limber::reference {

// A value and its rate at one time.
struct Reading {
  double time = 0.0;
  double value = 0.0;
  double rate = 0.0;
};

// The extremum between two readings of the cubic that has their values and rates; none where the
// rate keeps its sign. The value is off by the fourth power of the interval.
std::optional<Reading> extremum_between(const Reading& a, const Reading& b);

// The largest magnitude that a quantity had, read once a step.
class PeakRecorder {
 public:
  void read(const Reading& now);
  const Reading& highest() const { return highest_; }  // largest value and when
  const Reading& lowest() const { return lowest_; }
  const Reading& farthest() const;  // of the two, the one farther from 0

 private:
  void consider(const Reading& reading);

  bool empty_ = true;
  Reading last_, highest_, lowest_;
};

}  // namespace limber::reference

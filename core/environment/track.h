#pragma once

#include <algorithm>
#include <utility>
#include <vector>

namespace limber {

// A quantity that changes with time: linear between the keys, constant before the first and after
// the last one. One key: a constant.
template <class T>
struct Track {
  struct Key {
    double time = 0.0;  // s
    T value{};
  };
  std::vector<Key> keys;  // strictly ascending in time, at least one

  Track(const T& constant) : keys{{0.0, constant}} {}  // NOLINT: a constant is a track
  explicit Track(std::vector<Key> of) : keys(std::move(of)) {}

  T at(double time) const;  // s
};

template <class T>
T Track<T>::at(double time) const {
  const auto is_before = [](double t, const Key& key) { return t < key.time; };
  const auto next = std::upper_bound(keys.begin(), keys.end(), time, is_before);
  if (next == keys.begin()) return keys.front().value;
  const Key& last = *(next - 1);
  if (next == keys.end()) return last.value;
  const double share = (time - last.time) / (next->time - last.time);
  return last.value + share * (next->value - last.value);
}

}  // namespace limber

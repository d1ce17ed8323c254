#pragma once

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace limber {

// A list of numbers without what rounding does to them: shapes that are equal on paper, such as the
// cells of a regular lattice, have equal keys. Two that differ by less than a quantum may still get
// different ones, which costs time and nothing else.
class RoundedKey {
 public:
  // The step that numbers of this size are rounded to: 2^-40 (1e-12) of the next power of two. The
  // differences of coordinates up to a thousand times as large agree better than that.
  static double quantum(double largest) {
    return largest > 0.0 ? std::ldexp(1.0, std::ilogb(largest) + 1 - 40) : 1.0;
  }

  void clear() { numbers_.clear(); }
  void add(std::int64_t number) { numbers_.push_back(number); }
  void add(double value, double quantum) { add(std::int64_t{std::llrint(value / quantum)}); }

  // Rounded relative to itself: its exponent and the leading 40 bits.
  void add_relative(double value) {
    int exponent = 0;
    const double mantissa = std::frexp(value, &exponent);
    add(exponent);
    add(std::int64_t{std::llrint(std::ldexp(mantissa, 40))});
  }

  bool operator==(const RoundedKey&) const = default;

  struct Hash {
    std::size_t operator()(const RoundedKey& key) const {
      std::uint64_t h = key.numbers_.size();
      for (std::int64_t number : key.numbers_) {
        h = (h ^ static_cast<std::uint64_t>(number)) * 0x9E3779B97F4A7C15u;  // 2^64 / golden ratio
        h ^= h >> 32;
      }
      return h;
    }
  };

 private:
  std::vector<std::int64_t> numbers_;
};

// Answers that cost much more than their keys; the first of all that share a key stands for them.
// Models of a million different cells must not fill the memory: what comes after the 4096th kind
// starts the collection anew.
template <class Answer>
class RoundedCache {
 public:
  // The reference holds until the next call.
  template <class Compute>
  const Answer& get(const RoundedKey& key, const Compute& compute) {
    const auto known = answers_.find(key);
    if (known != answers_.end()) return known->second;
    if (answers_.size() >= kMostKinds) answers_.clear();
    return answers_.emplace(key, compute()).first->second;
  }

  std::size_t kinds() const { return answers_.size(); }

 private:
  static constexpr std::size_t kMostKinds = 4096;
  std::unordered_map<RoundedKey, Answer, RoundedKey::Hash> answers_;
};

}  // namespace limber

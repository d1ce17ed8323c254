#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>

namespace limber {

// 64-bit XXH3 of a stream of plain values: equal hashes mean, for all practical purposes, equal
// bits.
class StateHash {
 public:
  StateHash();
  ~StateHash();

  template <class T>
  void add(std::span<const T> values) {
    add_bytes(values.data(), values.size_bytes());
  }
  template <class T>
  requires std::is_arithmetic_v<T>
  void add(T value) { add_bytes(&value, sizeof value); }
  std::uint64_t value() const;

 private:
  void add_bytes(const void* data, std::size_t size);

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace limber

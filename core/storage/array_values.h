#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "core/model/physical_model.h"

namespace limber {

// Files hold little-endian numbers, and pieces of them are read and written as they are.
static_assert(std::endian::native == std::endian::little);

enum class NumberType { kFloat64, kInt32, kInt64, kUint8 };

template <class T>
constexpr NumberType number_type() {
  if constexpr (std::is_same_v<T, double>) return NumberType::kFloat64;
  if constexpr (std::is_same_v<T, std::int32_t>) return NumberType::kInt32;
  if constexpr (std::is_same_v<T, std::int64_t>) return NumberType::kInt64;
  if constexpr (std::is_same_v<T, std::uint8_t>) return NumberType::kUint8;
}

std::size_t bytes_of(NumberType type);
const char* name_of(NumberType type);

// Rows of equally many numbers each. Width 1 is a plain list, kScalar a number without rows.
inline constexpr int kScalar = 0;

struct ArrayShape {
  std::size_t rows = 0;  // 1 for a scalar
  int width = 1;

  std::size_t numbers_a_row() const { return width == kScalar ? 1 : std::size_t(width); }
  std::vector<std::uint64_t> extents() const;
};

// For messages: "3 x 2 numbers".
std::string text_of_extents(const std::vector<std::uint64_t>& extents);

// The shape of an array with so many numbers in all.
ArrayShape shape_of(std::size_t numbers, int width);

// Numbers that pass through memory at a time.
inline constexpr std::size_t kBufferNumbers = std::size_t{1} << 16;

// One array of a file. T is the kind of its numbers there.
template <class T>
struct ArraySpec {
  const char* path;  // "points/mass"
  const char* unit;  // SI; "1" for pure numbers; what the numbers mean where they stand for things
  int width = 1;     // numbers a row
  std::optional<T> absent = {};  // the array may be left out when every number is this one
};

template <class X>
concept AnId = std::same_as<decltype(X::value), std::int32_t>;

// A value of the model as a number of the file.
template <class T, class X>
T encoded(const X& x) {
  if constexpr (AnId<X>)
    return x.value;
  else
    return static_cast<T>(x);
}

// And back. False where the number stands for nothing.
template <class T, class X>
bool decode(T number, X& x) {
  if constexpr (AnId<X>) {
    x.value = number;
    return true;
  } else {
    x = static_cast<X>(number);
    if constexpr (std::is_same_v<X, bool>) return number <= 1;
    if constexpr (std::is_same_v<X, DragLaw>) return number <= static_cast<T>(DragLaw::kPressure);
    return true;
  }
}

template <class Container>
void give_size(Container& container, std::size_t n) {
  container.resize(n);
}
// Eigen leaves its vectors without values, and compilers say so.
template <class IdType>
void give_size(IdVector<IdType, Vec3>& container, std::size_t n) {
  container.resize(n, Vec3::Zero());
}

// 0.0 and -0.0 are different numbers here.
template <class T>
bool same_bits(T a, T b) {
  if constexpr (std::is_same_v<T, double>)
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  else
    return a == b;
}

}  // namespace limber

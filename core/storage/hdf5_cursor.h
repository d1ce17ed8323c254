#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

namespace limber {

using Hdf5Bytes = std::span<const std::uint8_t>;

inline constexpr std::uint64_t kHdf5Nowhere = ~std::uint64_t{0};  // HDF5's undefined address

// Thrown by what reads pieces of a file: what is wrong, without where. read_catalogue() makes an
// InputError of it.
struct Hdf5Refusal {
  std::string what;
};

[[noreturn]] inline void refuse_hdf5(std::string what) { throw Hdf5Refusal{std::move(what)}; }

// Takes little-endian numbers and pieces off the front; never reads beyond the end.
class Hdf5Cursor {
 public:
  explicit Hdf5Cursor(Hdf5Bytes bytes) : left_(bytes) {}

  Hdf5Bytes take(std::uint64_t count) {
    if (count > left_.size()) refuse_hdf5("has a header that ends too early");
    const Hdf5Bytes front = left_.first(count);
    left_ = left_.subspan(count);
    return front;
  }
  std::uint64_t number(std::size_t bytes) {
    std::uint64_t value = 0;
    const Hdf5Bytes digits = take(bytes);
    for (std::size_t i = 0; i < bytes; ++i) value |= std::uint64_t{digits[i]} << (8 * i);
    return value;
  }
  std::string text(std::uint64_t bytes) {
    const Hdf5Bytes t = take(bytes);
    return {t.begin(), t.end()};
  }
  // Takes what has to be there.
  void expect(std::uint64_t value, std::size_t bytes, const char* what) {
    if (number(bytes) != value) refuse_hdf5(what);
  }
  std::size_t left() const { return left_.size(); }

 private:
  Hdf5Bytes left_;
};

}  // namespace limber

#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace limber {

// Lists of indices, one list a row, in two flat arrays: row r is items[start[r]] up to, but without,
// items[start[r + 1]].
struct IndexRows {
  std::vector<std::int32_t> start;
  std::vector<std::int32_t> items;

  std::span<const std::int32_t> operator[](std::size_t row) const {
    return {items.data() + start[row], items.data() + start[row + 1]};
  }
  std::size_t rows() const { return start.empty() ? 0 : start.size() - 1; }
};

}  // namespace limber

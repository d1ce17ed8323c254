#include "core/storage/array_values.h"

namespace limber {

std::size_t bytes_of(NumberType type) {
  switch (type) {
    case NumberType::kFloat64:
    case NumberType::kInt64:
      return 8;
    case NumberType::kInt32:
      return 4;
    case NumberType::kUint8:
      break;
  }
  return 1;
}

const char* name_of(NumberType type) {
  switch (type) {
    case NumberType::kFloat64:
      return "float64";
    case NumberType::kInt32:
      return "int32";
    case NumberType::kInt64:
      return "int64";
    case NumberType::kUint8:
      break;
  }
  return "uint8";
}

std::vector<std::uint64_t> ArrayShape::extents() const {
  if (width == kScalar) return {};
  if (width == 1) return {rows};
  return {rows, static_cast<std::uint64_t>(width)};
}

std::string text_of_extents(const std::vector<std::uint64_t>& extents) {
  if (extents.empty()) return "one number";
  std::string text;
  for (std::uint64_t extent : extents) text += (text.empty() ? "" : " x ") + std::to_string(extent);
  return text + " numbers";
}

ArrayShape shape_of(std::size_t numbers, int width) {
  ArrayShape shape{0, width};
  shape.rows = numbers / shape.numbers_a_row();
  return shape;
}

}  // namespace limber

#include "tests/support/partition.h"

namespace limber::test {

std::vector<std::int32_t> smallest_in_piece(const Components& components) {
  std::vector<std::int32_t> smallest(components.count, -1), result;
  for (std::size_t p = 0; p < components.label.size(); ++p) {
    const std::int32_t label = components.label[p];
    if (label >= 0 && smallest[label] < 0) smallest[label] = static_cast<std::int32_t>(p);
    result.push_back(label < 0 ? -1 : smallest[label]);
  }
  return result;
}

std::vector<std::int32_t> sizes_of(const Components& components) {
  std::vector<std::int32_t> sizes(components.count, 0);
  for (std::int32_t label : components.label)
    if (label >= 0) ++sizes[label];
  return sizes;
}

}  // namespace limber::test

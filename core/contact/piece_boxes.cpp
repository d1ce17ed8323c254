#include "core/contact/piece_boxes.h"

#include <algorithm>

namespace limber {
namespace {

// A test of two boxes takes about a nanosecond, a point in the grid some thirty.
constexpr std::size_t kBoxTestsPerPoint = 32;

}  // namespace

Components with_carriers(const Lattice& lattice, const Components& pieces) {
  Components all = pieces;
  for (std::int32_t p : lattice.carried_points) {
    all.label[p] = pieces.count + lattice.carrier[p];
    all.count = std::max(all.count, all.label[p] + 1);
  }
  return all;
}

PieceBoxes::PieceBoxes(const Lattice& lattice, std::span<const std::int32_t> points,
                       const Components& pieces, double by)
    : boxes_(static_cast<std::size_t>(pieces.count)), others_(boxes_.size()) {
  std::vector<bool> flexible(boxes_.size(), false);
  for (std::int32_t p : points) {
    boxes_[pieces.label[p]].extend(lattice.motion[p].position);
    if (lattice.role[p] == PointRole::kDynamic) flexible[pieces.label[p]] = true;
  }
  for (Box3& box : boxes_) {
    if (box.isEmpty()) continue;
    box.min() -= Vec3::Constant(by);
    box.max() += Vec3::Constant(by);
  }
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    for (std::size_t j = 0; j < boxes_.size(); ++j) {
      if (i == j || !(flexible[i] || flexible[j])) continue;
      if (boxes_[i].isEmpty() || !boxes_[i].intersects(boxes_[j])) continue;
      others_[i].push_back(static_cast<std::int32_t>(j));
    }
  }
}

bool PieceBoxes::reaches_into_another(const Box3& box, std::int32_t piece) const {
  const auto& others = others_[piece];
  return std::any_of(others.begin(), others.end(),
                     [&](std::int32_t other) { return boxes_[other].intersects(box); });
}

bool PieceBoxes::pay(std::int32_t pieces, std::size_t points) {
  const auto count = static_cast<std::size_t>(pieces);
  return count * count <= kBoxTestsPerPoint * points;
}

}  // namespace limber

#include "core/operators/boundary_tracker.h"

#include <algorithm>

#include "core/operators/boundary_operator.h"
#include "core/operators/prefetch.h"

namespace limber {

void BoundaryTracker::reset(const BreakingState& state) {
  ++revision_;
  faces_.clear();
  place_.assign(state.face_external.size(), -1);
  for (std::size_t f = 0; f < state.face_external.size(); ++f) {
    if (state.face_external[f]) enter(static_cast<std::int32_t>(f));
  }
}

void BoundaryTracker::update(const BreakingTopology& topology, const BreakingResult& result) {
  for (std::int32_t face : result.exposed_faces) prefetch(&place_[face]);
  for (std::int32_t cell : result.invalid_cells) {
    for (std::int32_t face : topology.cell_faces[cell]) leave(face);
  }
  for (std::int32_t edge : result.broken_edges) {
    for (std::int32_t face : topology.edge_sheet_faces[edge]) leave(face);
  }
  for (std::int32_t face : result.exposed_faces) enter(face);
}

// The last face takes the place of the one that leaves.
void BoundaryTracker::leave(std::int32_t face) {
  const std::int32_t place = place_[face];
  if (place < 0) return;
  ++revision_;
  place_[face] = -1;
  const std::int32_t last = faces_.back();
  faces_.pop_back();
  if (last == face) return;
  faces_[place] = last;
  place_[last] = place;
}

void BoundaryTracker::enter(std::int32_t face) {
  if (place_[face] >= 0) return;
  ++revision_;
  place_[face] = static_cast<std::int32_t>(faces_.size());
  faces_.push_back(face);
}

std::vector<FaceId> BoundaryTracker::faces_of(IdRange<FaceId> range) const {
  std::vector<FaceId> faces;
  for (std::int32_t f : faces_) {
    if (f < range.begin || f >= range.end) continue;
    faces.push_back(FaceId(static_cast<std::size_t>(f - range.begin)));
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

SurfaceModel BoundaryTracker::surface(const PhysicalModel& model, const BreakingTopology& topology,
                                      IdRange<FaceId> range) const {
  const std::span<const TwinFace> twins = topology.face_twin;
  return surface_of(model, faces_of(range), twins.subspan(range.begin, range.end - range.begin));
}

}  // namespace limber

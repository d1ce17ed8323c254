#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/model/surface_model.h"
#include "core/operators/breaking_operator.h"

namespace limber {

// The external faces of one or several compiled objects, kept up to date while edges break: what
// boundary() finds from scratch, at the cost of what breaks.
class BoundaryTracker {
 public:
  // Starts from state.face_external. Costs the number of faces.
  void reset(const BreakingState& state);

  // To be told after every break_edges(): faces of the cells that became invalid leave, those they
  // uncovered enter, faces of sheets leave with an edge of theirs.
  void update(const BreakingTopology& topology, const BreakingResult& result);

  // All external faces, in an order that depends on the order of the breaks.
  const std::vector<std::int32_t>& faces() const { return faces_; }
  bool contains(std::int32_t face) const { return place_[face] >= 0; }

  // Another number after every change.
  std::uint64_t revision() const { return revision_; }

  // Those of one object, ascending and numbered as in its model. `faces`: its share of the indices.
  std::vector<FaceId> faces_of(IdRange<FaceId> faces) const;

  // What boundary(model) would give, for the object that has this share of the faces.
  SurfaceModel surface(const PhysicalModel& model, const BreakingTopology& topology,
                       IdRange<FaceId> faces) const;

 private:
  void enter(std::int32_t face);
  void leave(std::int32_t face);

  std::vector<std::int32_t> faces_;
  std::vector<std::int32_t> place_;  // shape (faces of the state): where in faces_, or -1
  std::uint64_t revision_ = 0;
};

}  // namespace limber

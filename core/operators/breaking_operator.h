#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/model/index_rows.h"
#include "core/model/physical_model.h"

namespace limber {

// The reverse of a face, with its cell: what breaking asks of it without reading that face.
struct TwinFace {
  std::int32_t face = -1;  // -1: there is none
  std::int32_t cell = -1;
};

// The links the breaking operator walks; constant while an object is simulated.
struct BreakingTopology {
  IndexRows cell_edges;                 // cell -> edges
  IndexRows edge_cells;                 // edge -> cells, the paper's two-way pointer
  IndexRows cell_faces;                 // cell -> faces
  std::vector<std::int32_t> face_cell;  // face -> cell or -1
  std::vector<TwinFace> face_twin;      // face -> its reverse face
  IndexRows edge_sheet_faces;           // edge -> the faces without a cell that it bounds
};

// What breaking changes.
struct BreakingState {
  std::vector<std::uint8_t> edge_broken;    // shape (edges)
  std::vector<std::int32_t> valid_cells;    // shape (edges), how many of its cells are valid
  std::vector<std::uint8_t> cell_valid;     // shape (cells)
  std::vector<std::uint8_t> face_external;  // shape (faces), maintained by the third step
};

struct BreakingResult {
  std::vector<std::int32_t> broken_edges;  // marked and consequent, each once, in order of breaking
  std::vector<std::int32_t> invalid_cells;  // newly invalid
  std::vector<std::int32_t> exposed_faces;  // newly external
};

BreakingTopology breaking_topology(const GeometricModel& geometry);
BreakingState breaking_state(const PhysicalModel& model, const BreakingTopology& topology);

// The breaking operator (paper, section 5.2), incremental, its cost proportional to what breaks:
//   1. mark each edge as broken;
//   2. invalidate every cell it belongs to, and break each edge of those that no valid cell shares;
//   3. expose the faces that an invalid cell leaves behind.
// The result does not depend on the order of `edges`. Edges already broken are ignored.
BreakingResult break_edges(const BreakingTopology& topology, BreakingState& state,
                           std::span<const std::int32_t> edges);

// The same into `result`, whose storage is used again.
void break_edges(const BreakingTopology& topology, BreakingState& state,
                 std::span<const std::int32_t> edges, BreakingResult& result);

// The same on an authored model.
BreakingResult break_edges(PhysicalModel& model, std::span<const EdgeId> edges);

}  // namespace limber

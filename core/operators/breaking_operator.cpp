#include "core/operators/breaking_operator.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "core/model/diagnostic_list.h"
#include "core/model/errors.h"
#include "core/operators/prefetch.h"

namespace limber {
namespace {

// ---- compiling the links -----------------------------------------------------------------------

template <class IdType, class Lists, class ListOf>
IndexRows index_rows(const Lists& owners, ListOf list_of) {
  IndexRows rows;
  rows.start.reserve(owners.size() + 1);
  rows.start.push_back(0);
  for (const auto& owner : owners) {
    rows.start.push_back(rows.start.back() + static_cast<std::int32_t>(list_of(owner).size()));
  }
  rows.items.reserve(rows.start.back());
  for (const auto& owner : owners) {
    for (IdType id : list_of(owner)) rows.items.push_back(id.value);
  }
  return rows;
}

std::vector<std::int32_t> face_cells(const GeometricModel& geometry) {
  std::vector<std::int32_t> cells;
  cells.reserve(geometry.faces.size());
  for (const Face& face : geometry.faces) cells.push_back(face.cell.valid() ? face.cell.value : -1);
  return cells;
}

// Two faces are each other's reverse when one lists the corners of the other backwards. Both start
// with the smallest id, so that they differ in the order of the other two (paper, section 5.4):
// sorted by the corners without that order, they stand side by side.
std::vector<TwinFace> face_twins(const GeometricModel& geometry) {
  std::vector<std::array<std::int32_t, 4>> sorted;  // three corners, face
  sorted.reserve(geometry.faces.size());
  for (FaceId f : ids_of(geometry.faces)) {
    const auto& [p, q, r] = geometry.faces[f].corners;
    if (!geometry.faces[f].cell.valid()) continue;
    sorted.push_back({p.value, std::min(q, r).value, std::max(q, r).value, f.value});
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<TwinFace> twins(geometry.faces.size());
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const FaceId f(std::size_t(sorted[i - 1][3])), g(std::size_t(sorted[i][3]));
    if (geometry.faces[g].corners != reversed(geometry.faces[f].corners)) continue;
    twins[f.index()] = {g.value, geometry.faces[g].cell.value};
    twins[g.index()] = {f.value, geometry.faces[f].cell.value};
  }
  return twins;
}

using EndPoints = std::array<PointId, 2>;

EndPoints unordered_ends(PointId a, PointId b) { return {std::min(a, b), std::max(a, b)}; }

std::vector<std::pair<EndPoints, EdgeId>> edges_by_points(const GeometricModel& geometry) {
  std::vector<std::pair<EndPoints, EdgeId>> sorted;
  sorted.reserve(geometry.edges.size());
  for (EdgeId e : ids_of(geometry.edges))
    sorted.push_back({unordered_ends(geometry.edges[e].a, geometry.edges[e].b), e});
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

// Only sheets need it: what a face of a cell looks like follows from its cell.
IndexRows edge_sheet_faces(const GeometricModel& geometry) {
  std::vector<std::vector<FaceId>> faces_of_edge(geometry.edges.size());
  const auto is_sheet = [](const Face& face) { return !face.cell.valid(); };
  if (std::any_of(geometry.faces.begin(), geometry.faces.end(), is_sheet)) {
    const auto sorted = edges_by_points(geometry);
    for (FaceId f : ids_of(geometry.faces)) {
      const auto& [p, q, r] = geometry.faces[f].corners;
      if (!is_sheet(geometry.faces[f])) continue;
      for (const EndPoints& side :
           {unordered_ends(p, q), unordered_ends(q, r), unordered_ends(r, p)}) {
        const auto e = std::lower_bound(sorted.begin(), sorted.end(), std::pair(side, EdgeId()));
        if (e != sorted.end() && e->first == side) faces_of_edge[e->second.index()].push_back(f);
      }
    }
  }
  return index_rows<FaceId>(
      faces_of_edge, [](const auto& list) -> const auto& { return list; });
}

// ---- fetching what the steps will read ---------------------------------------------------------

constexpr std::size_t kIntsPerCacheLine = 64 / sizeof(std::int32_t);

void prefetch_row(std::span<const std::int32_t> row) {
  for (std::size_t i = 0; i < row.size(); i += kIntsPerCacheLine) prefetch(&row[i]);
  if (!row.empty()) prefetch(&row.back());
}

void prefetch_rows_of(const BreakingTopology& topology, std::span<const std::int32_t> cells) {
  for (std::int32_t cell : cells) {
    prefetch(&topology.cell_edges.start[cell]);
    prefetch(&topology.cell_faces.start[cell]);
  }
  for (std::int32_t cell : cells) {
    prefetch_row(topology.cell_edges[cell]);
    prefetch_row(topology.cell_faces[cell]);
  }
}

// Level by level: each pass needs what the one before has fetched.
void prefetch_around(const BreakingTopology& topology, const BreakingState& state,
                     std::span<const std::int32_t> cells) {
  prefetch_rows_of(topology, cells);
  for (std::int32_t cell : cells) {
    for (std::int32_t edge : topology.cell_edges[cell]) prefetch(&state.valid_cells[edge]);
    for (std::int32_t face : topology.cell_faces[cell]) {
      prefetch(&topology.face_twin[face]);
      prefetch(&state.face_external[face]);
    }
  }
  for (std::int32_t cell : cells)
    for (std::int32_t face : topology.cell_faces[cell]) {
      const TwinFace& twin = topology.face_twin[face];
      if (twin.face < 0) continue;
      prefetch(&state.cell_valid[twin.cell]);
      prefetch(&state.face_external[twin.face]);
    }
}

// ---- the three steps ---------------------------------------------------------------------------

void mark_broken(BreakingState& state, std::int32_t edge, BreakingResult& result) {
  if (state.edge_broken[edge]) return;
  state.edge_broken[edge] = 1;
  result.broken_edges.push_back(edge);
}

void invalidate_cells_of(const BreakingTopology& topology, BreakingState& state, std::int32_t edge,
                         BreakingResult& result) {
  for (std::int32_t cell : topology.edge_cells[edge]) {
    if (!state.cell_valid[cell]) continue;
    state.cell_valid[cell] = 0;
    result.invalid_cells.push_back(cell);
  }
}

// Breaks no further cell: such an edge belongs to invalid cells only, so the rule ends here.
void break_unshared_edges(const BreakingTopology& topology, BreakingState& state,
                          BreakingResult& result) {
  for (std::int32_t cell : result.invalid_cells)
    for (std::int32_t edge : topology.cell_edges[cell]) --state.valid_cells[edge];
  for (std::int32_t cell : result.invalid_cells)
    for (std::int32_t edge : topology.cell_edges[cell])
      if (state.valid_cells[edge] == 0) mark_broken(state, edge, result);
}

bool reversed_by_valid_cell(const BreakingTopology& topology, const BreakingState& state,
                            std::int32_t face) {
  const TwinFace& twin = topology.face_twin[face];
  return twin.face >= 0 && state.cell_valid[twin.cell];
}

// A face shows when its reverse has lost its cell and its own is still there.
void expose_faces(const BreakingTopology& topology, BreakingState& state, BreakingResult& result) {
  for (std::int32_t cell : result.invalid_cells)
    for (std::int32_t face : topology.cell_faces[cell]) {
      state.face_external[face] = 0;
      if (!reversed_by_valid_cell(topology, state, face)) continue;
      const std::int32_t twin = topology.face_twin[face].face;
      state.face_external[twin] = 1;
      result.exposed_faces.push_back(twin);
    }
}

std::vector<std::int32_t> valid_cells_of_edges(const BreakingTopology& topology,
                                               const std::vector<std::uint8_t>& cell_valid) {
  std::vector<std::int32_t> count(topology.edge_cells.rows(), 0);
  for (std::size_t e = 0; e < count.size(); ++e)
    for (std::int32_t cell : topology.edge_cells[e]) count[e] += cell_valid[cell];
  return count;
}

void hide_sheet_faces_of(const BreakingTopology& topology, BreakingState& state,
                         std::int32_t edge) {
  for (std::int32_t face : topology.edge_sheet_faces[edge]) state.face_external[face] = 0;
}

}  // namespace

BreakingTopology breaking_topology(const GeometricModel& geometry) {
  BreakingTopology topology;
  topology.cell_edges = index_rows<EdgeId>(
      geometry.cells, [](const Cell& cell) -> const auto& { return cell.edges; });
  topology.edge_cells = edge_cells(geometry);
  topology.cell_faces = index_rows<FaceId>(
      geometry.cells, [](const Cell& cell) -> const auto& { return cell.faces; });
  topology.face_cell = face_cells(geometry);
  topology.face_twin = face_twins(geometry);
  topology.edge_sheet_faces = edge_sheet_faces(geometry);
  return topology;
}

BreakingState breaking_state(const PhysicalModel& model, const BreakingTopology& topology) {
  BreakingState state;
  for (const EdgeAttributes& edge : model.edges) state.edge_broken.push_back(edge.broken);
  for (const CellAttributes& cell : model.cells) state.cell_valid.push_back(cell.valid);
  state.valid_cells = valid_cells_of_edges(topology, state.cell_valid);
  const auto faces = static_cast<std::int32_t>(topology.face_cell.size());
  for (std::int32_t f = 0; f < faces; ++f) {
    const std::int32_t cell = topology.face_cell[f];
    state.face_external.push_back(
        cell < 0 || (state.cell_valid[cell] && !reversed_by_valid_cell(topology, state, f)));
  }
  for (std::size_t e = 0; e < state.edge_broken.size(); ++e)
    if (state.edge_broken[e]) hide_sheet_faces_of(topology, state, static_cast<std::int32_t>(e));
  return state;
}

BreakingResult break_edges(const BreakingTopology& topology, BreakingState& state,
                           std::span<const std::int32_t> edges) {
  BreakingResult result;
  break_edges(topology, state, edges, result);
  return result;
}

void break_edges(const BreakingTopology& topology, BreakingState& state,
                 std::span<const std::int32_t> edges, BreakingResult& result) {
  result.broken_edges.clear();
  result.invalid_cells.clear();
  result.exposed_faces.clear();
  for (std::int32_t edge : edges) {
    assert(edge >= 0 && edge < std::ssize(state.edge_broken));
    mark_broken(state, edge, result);
  }
  std::sort(result.broken_edges.begin(), result.broken_edges.end());
  // All marks first: whether an edge is shared by a valid cell has to be asked after the last one.
  for (std::int32_t edge : result.broken_edges) invalidate_cells_of(topology, state, edge, result);
  prefetch_around(topology, state, result.invalid_cells);
  break_unshared_edges(topology, state, result);
  expose_faces(topology, state, result);
  for (std::int32_t edge : result.broken_edges) hide_sheet_faces_of(topology, state, edge);
}

BreakingResult break_edges(PhysicalModel& model, std::span<const EdgeId> edges) {
  std::vector<std::int32_t> indices;
  for (EdgeId e : edges) {
    if (!model.edges.contains(e))
      throw InputError({say(model.name, ": edge ", e.value),
                        say("does not exist, there are ", model.edges.size()),
                        "break an edge of this model"});
    indices.push_back(e.value);
  }
  const BreakingTopology topology = breaking_topology(model.geometry);
  BreakingState state = breaking_state(model, topology);
  BreakingResult result = break_edges(topology, state, indices);
  for (std::int32_t e : result.broken_edges) model.edges[EdgeId(std::size_t(e))].broken = true;
  for (std::int32_t c : result.invalid_cells) model.cells[CellId(std::size_t(c))].valid = false;
  return result;
}

}  // namespace limber

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
    for (IdType id : list_of(owner)) rows.items.push_back(id.value);
    rows.start.push_back(static_cast<std::int32_t>(rows.items.size()));
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
// with the smallest id, so that comparing the three numbers is enough (paper, section 5.4).
std::vector<std::int32_t> face_twins(const GeometricModel& geometry) {
  using Entry = std::pair<std::array<PointId, 3>, FaceId>;
  std::vector<Entry> sorted;
  for (FaceId f : ids_of(geometry.faces))
    if (geometry.faces[f].cell.valid()) sorted.push_back({geometry.faces[f].corners, f});
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::int32_t> twins(geometry.faces.size(), -1);
  for (const auto& [corners, f] : sorted) {
    const Entry wanted{reversed(corners), FaceId()};
    const auto twin = std::lower_bound(sorted.begin(), sorted.end(), wanted);
    if (twin != sorted.end() && twin->first == wanted.first) twins[f.index()] = twin->second.value;
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

// Of every edge the first cell, which is a valid one more often than not.
void prefetch_edges_of(const BreakingTopology& topology, const BreakingState& state,
                       std::span<const std::int32_t> cells) {
  const IndexRows& edge_cells = topology.edge_cells;
  for (std::int32_t cell : cells)
    for (std::int32_t edge : topology.cell_edges[cell])
      prefetch(&edge_cells.items[edge_cells.start[edge]]);
  for (std::int32_t cell : cells)
    for (std::int32_t edge : topology.cell_edges[cell])
      prefetch(&state.cell_valid[edge_cells.items[edge_cells.start[edge]]]);
}

void prefetch_twins_of(const BreakingTopology& topology, const BreakingState& state,
                       std::span<const std::int32_t> cells) {
  for (std::int32_t cell : cells)
    for (std::int32_t face : topology.cell_faces[cell]) {
      const std::int32_t twin = topology.face_twin[face];
      if (twin < 0) continue;
      prefetch(&topology.face_cell[twin]);
      prefetch(&state.face_external[twin]);
    }
}

// Level by level: each pass needs what the one before has fetched.
void prefetch_around(const BreakingTopology& topology, const BreakingState& state,
                     std::span<const std::int32_t> cells) {
  prefetch_rows_of(topology, cells);
  for (std::int32_t cell : cells) {
    for (std::int32_t edge : topology.cell_edges[cell]) prefetch(&topology.edge_cells.start[edge]);
    for (std::int32_t face : topology.cell_faces[cell]) {
      prefetch(&topology.face_twin[face]);
      prefetch(&state.face_external[face]);
    }
  }
  prefetch_twins_of(topology, state, cells);
  prefetch_edges_of(topology, state, cells);
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

bool has_valid_cell(const BreakingTopology& topology, const BreakingState& state,
                    std::int32_t edge) {
  const auto cells = topology.edge_cells[edge];
  return std::any_of(cells.begin(), cells.end(), [&](auto c) { return state.cell_valid[c] != 0; });
}

// Breaks no further cell: such an edge belongs to invalid cells only, so the rule ends here.
void break_unshared_edges(const BreakingTopology& topology, BreakingState& state,
                          BreakingResult& result) {
  for (std::int32_t cell : result.invalid_cells)
    for (std::int32_t edge : topology.cell_edges[cell])
      if (!has_valid_cell(topology, state, edge)) mark_broken(state, edge, result);
}

bool is_external(const BreakingTopology& topology, const BreakingState& state, std::int32_t face) {
  const std::int32_t twin = topology.face_twin[face];
  return state.cell_valid[topology.face_cell[face]] &&
         (twin < 0 || !state.cell_valid[topology.face_cell[twin]]);
}

// A face shows when its reverse has lost its cell and its own is still there.
void expose_faces(const BreakingTopology& topology, BreakingState& state, BreakingResult& result) {
  for (std::int32_t cell : result.invalid_cells)
    for (std::int32_t face : topology.cell_faces[cell]) {
      state.face_external[face] = 0;
      const std::int32_t twin = topology.face_twin[face];
      if (twin < 0 || !state.cell_valid[topology.face_cell[twin]]) continue;
      state.face_external[twin] = 1;
      result.exposed_faces.push_back(twin);
    }
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
  topology.edge_cells = index_rows<CellId>(
      geometry.edge_cells, [](const auto& list) -> const auto& { return list; });
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
  const auto faces = static_cast<std::int32_t>(topology.face_cell.size());
  for (std::int32_t f = 0; f < faces; ++f)
    state.face_external.push_back(topology.face_cell[f] < 0 || is_external(topology, state, f));
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

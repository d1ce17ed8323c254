// Group 10: the breaking operator's three steps on blocks of cubic cells, and what is left counted.

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>

#include "core/dynamics/components.h"
#include "core/modeller/box_lattice.h"
#include "core/operators/boundary_operator.h"
#include "core/operators/breaking_operator.h"
#include "tests/reference/kinds.h"
#include "tests/reference/readings.h"

namespace limber::reference {
namespace {

using Cells = std::array<int, 3>;
using Triangle = std::array<std::int32_t, 3>;

// "A" axial, "D" one diagonal of every square, "F" both, "B" those through the body.
CellEdges edges_of(const std::string& edge_set) {
  const auto has = [&](char family) { return edge_set.find(family) != std::string::npos; };
  return {.axial = has('A'),
          .face_diagonals = has('F'),
          .body_diagonals = has('B'),
          .one_face_diagonal = has('D')};
}

PhysicalModel block_of(const Json& params) {
  PhysicalModel model =
      with_default_attributes(box_lattice(params.at("cells").get<Cells>(), Vec3::Ones(),
                                          Vec3::Zero(), "block", edges_of(params.at("edge_set"))),
                              "block");
  for (PointAttributes& point : model.points) point.mass = 1.0;
  return model;
}

EdgeId edge_between(const PhysicalModel& model, const Cells& cells, const Json& ends) {
  const auto point = [&](const Cells& at) {
    return at[0] + (cells[0] + 1) * (at[1] + (cells[1] + 1) * at[2]);
  };
  const int p = point(ends.at(0).get<Cells>()), q = point(ends.at(1).get<Cells>());
  for (EdgeId e : ids_of(model.geometry.edges)) {
    const auto& [a, b] = model.geometry.edges[e];
    if (std::minmax(a.value, b.value) == std::minmax(p, q)) return e;
  }
  throw std::runtime_error("no such edge");
}

// ---- counting ----------------------------------------------------------------------------------

struct Pieces {
  int count = 0;
  int isolated_points = 0;  // pieces of one point
};

Pieces pieces_of(const PhysicalModel& model) {
  Pieces pieces;
  for (const auto& points : points_of(components(compiled(model)))) {
    ++pieces.count;
    pieces.isolated_points += points.size() == 1;
  }
  return pieces;
}

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

// Distinct points, sides and triangles; how many triangles use each side.
struct Complex {
  std::set<std::int32_t> points;
  std::map<std::array<std::int32_t, 2>, int> sides;
  std::set<Triangle> triangles;

  void add(const Triangle& t) {
    const auto [a, b, c] = sorted(t);
    points.insert({a, b, c});
    for (const auto& side : {std::array{a, b}, std::array{b, c}, std::array{a, c}}) ++sides[side];
    triangles.insert({a, b, c});
  }
  int euler() const {  // V - E + F
    return static_cast<int>(points.size()) - static_cast<int>(sides.size()) +
           static_cast<int>(triangles.size());
  }
};

Triangle corners_of(const Face& face) {
  return {face.corners[0].value, face.corners[1].value, face.corners[2].value};
}

// Groups of valid cells that hang together by common triangles.
int cell_groups(const PhysicalModel& model) {
  std::vector<std::size_t> parent(model.cells.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  std::map<Triangle, std::size_t> first_with;
  std::set<std::size_t> roots;
  for (CellId c : ids_of(model.cells)) {
    if (!model.cells[c].valid) continue;
    for (FaceId f : model.geometry.cells[c].faces) {
      const Triangle shape = sorted(corners_of(model.geometry.faces[f]));
      parent[root(first_with.try_emplace(shape, c.index()).first->second)] = root(c.index());
    }
  }
  for (CellId c : ids_of(model.cells)) {
    if (model.cells[c].valid) roots.insert(root(c.index()));
  }
  return static_cast<int>(roots.size());
}

int valid_cells(const PhysicalModel& model) {
  return static_cast<int>(std::count_if(model.cells.begin(), model.cells.end(),
                                        [](const CellAttributes& c) { return c.valid; }));
}

void count_boundary(const PhysicalModel& model, const std::string& when, Json& counts) {
  const SurfaceModel surface = boundary(model);
  Complex skin;
  for (const SurfaceTriangle& t : surface.triangles) skin.add(t.corners);
  const auto odd = [](const auto& side) { return side.second != 2; };
  counts[when + "external_triangles"] = surface.triangles.size();
  counts[when + "boundary_points"] = surface.points.size();
  counts[when + "boundary_edges"] = skin.sides.size();
  counts[when + "boundary_euler_V_E_F"] = skin.euler();
  counts[when + "boundary_nonmanifold_edges"] =
      std::count_if(skin.sides.begin(), skin.sides.end(), odd);
}

void count_cells(const PhysicalModel& model, const std::string& when, Json& counts) {
  Complex solid;
  int triangles = 0;
  for (const Face& face : model.geometry.faces) {
    if (!model.cells[face.cell].valid) continue;
    solid.add(corners_of(face));
    ++triangles;
  }
  counts[when + "valid_cells"] = valid_cells(model);
  counts[when + "cell_components_by_faces"] = cell_groups(model);
  counts[when + "triangles_total"] = triangles;
  counts[when + "solid_euler"] = solid.euler() - valid_cells(model);
}

void count(const PhysicalModel& model, const std::string& when, Json& counts) {
  const auto broken = std::count_if(model.edges.begin(), model.edges.end(),
                                    [](const EdgeAttributes& e) { return e.broken; });
  const Pieces pieces = pieces_of(model);
  counts[when + "edges_broken"] = broken;
  counts[when + "edges_live"] = static_cast<long>(model.edges.size()) - broken;
  counts[when + "isolated_points"] = pieces.isolated_points;
  counts[when + "components_by_edges"] = pieces.count;
  count_cells(model, when, counts);
  count_boundary(model, when, counts);
}

Json break_topology(const Case& c) {
  PhysicalModel model = block_of(c.params);
  std::vector<EdgeId> marked;
  for (const Json& ends : c.params.at("break_edges")) {
    marked.push_back(edge_between(model, c.params.at("cells").get<Cells>(), ends));
  }
  const IndexRows cells_of = edge_cells(model.geometry);
  Json counts = {{"n_cells_sharing_first_edge", cells_of[marked.at(0).index()].size()}};
  const int before = valid_cells(model);
  count(model, "initial_", counts);
  for (EdgeId edge : marked) break_edges(model, std::array{edge});
  count(model, "after_", counts);
  counts["cells_invalidated"] = before - valid_cells(model);
  return counts;
}

}  // namespace

Kinds topology_kinds() {
  return {{"break_topology", break_topology}, {"break_layer", break_topology}};
}

}  // namespace limber::reference

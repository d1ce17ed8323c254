#include "tests/support/measure.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "core/operators/boundary_operator.h"

namespace limber::test {
namespace {

using Side = std::array<int, 2>;
using Triangle = std::array<int, 3>;

class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t root(std::size_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }
  void join(std::size_t i, std::size_t j) { parent_[root(i)] = root(j); }

 private:
  std::vector<std::size_t> parent_;
};

std::array<Side, 3> sides(const Triangle& t) {
  return {{{t[0], t[1]}, {t[1], t[2]}, {t[2], t[0]}}};
}

Side undirected(const Side& s) { return {std::min(s[0], s[1]), std::max(s[0], s[1])}; }

template <class T>
T sorted(T t) {
  std::sort(t.begin(), t.end());
  return t;
}

int components_by_edges(const PhysicalModel& m) {
  UnionFind sets(m.points.size());
  for (EdgeId e : ids_of(m.edges))
    if (!m.edges[e].broken) sets.join(m.geometry.edges[e].a.index(), m.geometry.edges[e].b.index());
  std::set<std::size_t> roots;
  for (std::size_t p = 0; p < m.points.size(); ++p) roots.insert(sets.root(p));
  return static_cast<int>(roots.size());
}

int isolated_points(const PhysicalModel& m) {
  std::set<PointId> held;
  for (EdgeId e : ids_of(m.edges))
    if (!m.edges[e].broken) held.insert({m.geometry.edges[e].a, m.geometry.edges[e].b});
  return static_cast<int>(m.points.size() - held.size());
}

Triangle triangle(const Face& face) {
  return {face.corners[0].value, face.corners[1].value, face.corners[2].value};
}

// The triangles of all valid cells, each with the cell it bounds.
std::vector<std::pair<Triangle, CellId>> valid_triangles(const PhysicalModel& m) {
  std::vector<std::pair<Triangle, CellId>> found;
  for (CellId c : ids_of(m.cells))
    if (m.cells[c].valid)
      for (FaceId f : m.geometry.cells[c].faces)
        found.push_back({triangle(m.geometry.faces[f]), c});
  return found;
}

int cell_components(const PhysicalModel& m) {
  UnionFind sets(m.cells.size());
  std::map<Triangle, CellId> first_with;
  for (const auto& [corners, cell] : valid_triangles(m)) {
    const auto [found, is_new] = first_with.try_emplace(sorted(corners), cell);
    if (!is_new) sets.join(found->second.index(), cell.index());
  }
  std::set<std::size_t> roots;
  for (CellId c : ids_of(m.cells))
    if (m.cells[c].valid) roots.insert(sets.root(c.index()));
  return static_cast<int>(roots.size());
}

// V - E + F of a set of triangles.
int euler(const std::vector<Triangle>& triangles) {
  std::set<int> points;
  std::set<Side> edges;
  std::set<Triangle> faces;
  for (const Triangle& t : triangles) {
    points.insert(t.begin(), t.end());
    for (const Side& s : sides(t)) edges.insert(undirected(s));
    faces.insert(sorted(t));
  }
  return static_cast<int>(points.size()) - static_cast<int>(edges.size()) +
         static_cast<int>(faces.size());
}

void count_boundary(const PhysicalModel& m, std::map<std::string, int>& counts) {
  const SurfaceModel surface = boundary(m);
  std::vector<Triangle> triangles;
  std::map<Side, int> uses;
  for (const SurfaceTriangle& t : surface.triangles) {
    triangles.push_back(t.corners);
    for (const Side& s : sides(t.corners)) ++uses[undirected(s)];
  }
  counts["external_triangles"] = static_cast<int>(triangles.size());
  counts["boundary_points"] = static_cast<int>(surface.points.size());
  counts["boundary_edges"] = static_cast<int>(uses.size());
  counts["boundary_euler_V_E_F"] = euler(triangles);
  counts["boundary_nonmanifold_edges"] = static_cast<int>(
      std::count_if(uses.begin(), uses.end(), [](const auto& use) { return use.second != 2; }));
}

}  // namespace

std::map<std::string, int> topology_counts(const PhysicalModel& m) {
  std::map<std::string, int> counts;
  const auto broken = std::count_if(m.edges.begin(), m.edges.end(),
                                    [](const EdgeAttributes& e) { return e.broken; });
  const auto valid = std::count_if(m.cells.begin(), m.cells.end(),
                                   [](const CellAttributes& c) { return c.valid; });
  std::vector<Triangle> triangles;
  for (const auto& [corners, cell] : valid_triangles(m)) triangles.push_back(corners);
  counts["valid_cells"] = static_cast<int>(valid);
  counts["edges_broken"] = static_cast<int>(broken);
  counts["edges_live"] = static_cast<int>(m.edges.size()) - static_cast<int>(broken);
  counts["isolated_points"] = isolated_points(m);
  counts["components_by_edges"] = components_by_edges(m);
  counts["cell_components_by_faces"] = cell_components(m);
  counts["triangles_total"] = static_cast<int>(triangles.size());
  counts["solid_euler"] = euler(triangles) - static_cast<int>(valid);
  count_boundary(m, counts);
  return counts;
}

int unmatched_sides(const SurfaceModel& surface) {
  std::map<Side, int> excess;  // of one direction over the other
  for (const SurfaceTriangle& t : surface.triangles)
    for (const Side& s : sides(t.corners)) {
      ++excess[s];
      --excess[{s[1], s[0]}];
    }
  return static_cast<int>(
      std::count_if(excess.begin(), excess.end(), [](const auto& e) { return e.second > 0; }));
}

Vec3 momentum(const PhysicalModel& m) {
  Vec3 sum = Vec3::Zero();
  for (const PointAttributes& p : m.points) sum += p.mass * p.velocity;
  return sum;
}

Vec3 angular_momentum(const PhysicalModel& m) {
  Vec3 sum = Vec3::Zero();
  for (PointId p : ids_of(m.points))
    sum += m.points[p].mass * m.geometry.points[p].cross(m.points[p].velocity);
  return sum;
}

double enclosed_volume(const SurfaceModel& surface) {
  double six_volumes = 0.0;
  for (const SurfaceTriangle& t : surface.triangles) {
    const auto& [a, b, c] = t.corners;
    six_volumes += surface.points[a].dot(surface.points[b].cross(surface.points[c]));
  }
  return six_volumes / 6.0;
}

}  // namespace limber::test

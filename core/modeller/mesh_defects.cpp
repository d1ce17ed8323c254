#include "core/modeller/mesh_defects.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "core/model/disjoint_sets.h"

namespace limber {
namespace {

bool corners_exist(const TriangleMesh& mesh, const MeshTriangle& t) {
  const auto n = static_cast<std::int32_t>(mesh.positions.size());
  return std::all_of(t.begin(), t.end(), [n](std::int32_t c) { return 0 <= c && c < n; });
}

bool is_degenerate(const TriangleMesh& mesh, const MeshTriangle& t) {
  const Vec3& a = mesh.positions[t[0]];
  return (mesh.positions[t[1]] - a).cross(mesh.positions[t[2]] - a).norm() == 0.0;
}

std::size_t doubled(const TriangleMesh& mesh) {
  std::vector<MeshTriangle> sorted;
  sorted.reserve(mesh.triangles.size());
  for (const MeshTriangle& t : mesh.triangles) sorted.push_back(lowest_first(t));
  std::sort(sorted.begin(), sorted.end());
  const auto last = std::unique(sorted.begin(), sorted.end());
  return static_cast<std::size_t>(sorted.end() - last);
}

void count_edge(const MeshSide* sides, std::size_t n, MeshDefects& defects) {
  if (n == 1) ++defects.open_edges;
  if (n == 2 && sides[0].from == sides[1].from) ++defects.inconsistent_edges;
  if (n > 2) ++defects.non_manifold_edges;
}

// How often the edge is run from low to high more than back.
int excess(const MeshSide* sides, std::size_t n) {
  int forward = 0;
  for (std::size_t i = 0; i < n; ++i) forward += sides[i].from == sides[i].low() ? 1 : -1;
  return forward;
}

// The holes: vector area of each connected set of sides without reverse.
class Holes {
 public:
  explicit Holes(const TriangleMesh& mesh) : mesh_(mesh), sets_(mesh.positions.size()) {}

  void add(std::int32_t low, std::int32_t high, int times) {
    sides_.push_back({low, high, times});
    sets_.join(low, high);
  }

  double area() const {
    std::map<std::int32_t, Vec3> areas;  // by the set's representative
    for (const auto& [low, high, times] : sides_) {
      const std::int32_t root = sets_.root(low);
      const Vec3& c = mesh_.positions[root];
      Vec3& sum = areas.try_emplace(root, Vec3::Zero()).first->second;
      sum += 0.5 * times * (mesh_.positions[low] - c).cross(mesh_.positions[high] - c);
    }
    double total = 0.0;
    for (const auto& [root, area] : areas) total += area.norm();
    return total;
  }

 private:
  struct Side {
    std::int32_t low, high;
    int times;
  };
  const TriangleMesh& mesh_;
  DisjointSets sets_;
  std::vector<Side> sides_;
};

void look_at_edges(const TriangleMesh& mesh, MeshDefects& defects) {
  const std::vector<MeshSide> sides = sorted_sides(mesh);
  DisjointSets parts(mesh.triangles.size());
  Holes holes(mesh);
  for (std::size_t i = 0, n = 0; i < sides.size(); i += n) {
    n = sides_of_edge(sides, i);
    count_edge(&sides[i], n, defects);
    for (std::size_t k = 1; k < n; ++k) parts.join(sides[i].triangle, sides[i + k].triangle);
    const int unmatched = excess(&sides[i], n);
    if (unmatched == 0) continue;
    defects.unmatched_sides += static_cast<std::size_t>(std::abs(unmatched));
    holes.add(sides[i].low(), sides[i].high(), unmatched);
  }
  defects.parts = parts.count();
  defects.missing_area = holes.area();
}

}  // namespace

MeshTriangle lowest_first(MeshTriangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

std::vector<MeshSide> sorted_sides(const TriangleMesh& mesh) {
  std::vector<MeshSide> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const MeshTriangle& t = mesh.triangles[i];
    for (std::size_t k = 0; k < 3; ++k)
      sides.push_back({t[k], t[(k + 1) % 3], static_cast<std::int32_t>(i)});
  }
  std::sort(sides.begin(), sides.end(), [](const MeshSide& a, const MeshSide& b) {
    return std::tuple(a.low(), a.high(), a.triangle) < std::tuple(b.low(), b.high(), b.triangle);
  });
  return sides;
}

std::size_t sides_of_edge(const std::vector<MeshSide>& sides, std::size_t first) {
  std::size_t end = first + 1;
  while (end < sides.size() && sides[end].low() == sides[first].low() &&
         sides[end].high() == sides[first].high())
    ++end;
  return end - first;
}

MeshDefects mesh_defects(const TriangleMesh& mesh) {
  MeshDefects defects;
  for (const MeshTriangle& t : mesh.triangles)
    if (!corners_exist(mesh, t)) ++defects.missing_corners;
  for (const Vec3& p : mesh.positions)
    if (!p.allFinite()) ++defects.non_finite_positions;
  if (defects.missing_corners + defects.non_finite_positions > 0) return defects;

  for (const MeshTriangle& t : mesh.triangles)
    if (is_degenerate(mesh, t)) ++defects.degenerate_triangles;
  defects.doubled_triangles = doubled(mesh);
  look_at_edges(mesh, defects);
  return defects;
}

}  // namespace limber

#include "core/modeller/mesh_refinement.h"

#include <algorithm>

#include "core/modeller/mesh_defects.h"

namespace limber {
namespace {

// Splits edges of a mesh in the middle; asked twice for an edge, it gives the same vertex.
class EdgeSplitter {
 public:
  EdgeSplitter(TriangleMesh& mesh, double longest) : mesh_(mesh), longest_(longest) {
    const std::vector<MeshSide> sides = sorted_sides(mesh);
    middle_.assign(mesh.triangles.size(), {-1, -1, -1});
    for (std::size_t i = 0, n = 0; i < sides.size(); i += n) {
      n = sides_of_edge(sides, i);
      const std::int32_t vertex = middle_of(sides[i].low(), sides[i].high());
      if (vertex < 0) continue;
      for (std::size_t k = 0; k < n; ++k) remember(sides[i + k], vertex);
    }
  }

  double longest_edge() const { return longest_met_; }  // m, before the split

  // How many triangles there will be.
  std::size_t triangles() const {
    std::size_t n = middle_.size();
    for (const MeshTriangle& m : middle_) n += 3 - std::count(m.begin(), m.end(), -1);
    return n;
  }

  void apply() {
    std::vector<MeshTriangle> made;
    made.reserve(triangles());
    for (std::size_t i = 0; i < middle_.size(); ++i) divide(mesh_.triangles[i], middle_[i], made);
    mesh_.triangles = std::move(made);
    mesh_.positions.insert(mesh_.positions.end(), added_.begin(), added_.end());
  }

 private:
  std::int32_t middle_of(std::int32_t a, std::int32_t b) {
    const Vec3 &p = mesh_.positions[a], &q = mesh_.positions[b];
    longest_met_ = std::max(longest_met_, (q - p).norm());
    if ((q - p).norm() <= longest_) return -1;
    added_.push_back(0.5 * (p + q));
    return static_cast<std::int32_t>(mesh_.positions.size() + added_.size() - 1);
  }

  void remember(const MeshSide& side, std::int32_t vertex) {
    const MeshTriangle& t = mesh_.triangles[side.triangle];
    const auto k = std::find(t.begin(), t.end(), side.from) - t.begin();
    middle_[side.triangle][static_cast<std::size_t>(k)] = vertex;
  }

  double length(std::int32_t a, std::int32_t b) const { return (place(a) - place(b)).norm(); }
  const Vec3& place(std::int32_t i) const {
    const auto n = static_cast<std::int32_t>(mesh_.positions.size());
    return i < n ? mesh_.positions[i] : added_[i - n];
  }

  // `m[k]`: on the side from corner k to k + 1, or -1. Turned so that the sides without come last.
  void divide(MeshTriangle t, MeshTriangle m, std::vector<MeshTriangle>& made) const {
    const auto split = 3 - std::count(m.begin(), m.end(), -1);
    const auto first_split = [&] { return m[0] >= 0 && (split != 2 || m[1] >= 0); };
    for (int turns = 0; split > 0 && turns < 3 && !first_split(); ++turns) {
      std::rotate(t.begin(), t.begin() + 1, t.end());
      std::rotate(m.begin(), m.begin() + 1, m.end());
    }
    const auto [a, b, c] = t;
    const auto [ab, bc, ca] = m;
    if (split == 0) made.push_back(t);
    if (split == 1) made.insert(made.end(), {{a, ab, c}, {ab, b, c}});
    if (split == 3) made.insert(made.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    if (split != 2) return;
    made.push_back({ab, b, bc});
    if (length(a, bc) <= length(ab, c))  // the square a ab bc c along its shorter diagonal
      made.insert(made.end(), {{a, ab, bc}, {a, bc, c}});
    else
      made.insert(made.end(), {{a, ab, c}, {ab, bc, c}});
  }

  TriangleMesh& mesh_;
  double longest_;                    // m, that stays whole
  double longest_met_ = 0.0;          // m
  std::vector<MeshTriangle> middle_;  // triangle -> vertices on its sides
  std::vector<Vec3> added_;
};

}  // namespace

RefinedMesh refined(TriangleMesh mesh, double longest_m, std::size_t most_triangles) {
  for (;;) {
    EdgeSplitter splitter(mesh, longest_m);
    const std::size_t wanted = splitter.triangles();
    if (wanted == mesh.triangles.size() || wanted > most_triangles)
      return {std::move(mesh), splitter.longest_edge()};
    splitter.apply();
  }
}

}  // namespace limber

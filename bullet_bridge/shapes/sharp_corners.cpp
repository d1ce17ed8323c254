#include "bullet_bridge/shapes/sharp_corners.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

constexpr double kSharp = 0.5;  // cosine of 60 degrees
constexpr double kFlat = 1e-6;  // of the size: coordinates in single precision

struct InOrder {
  bool operator()(const Vec3& a, const Vec3& b) const {
    return std::tie(a[0], a[1], a[2]) < std::tie(b[0], b[1], b[2]);
  }
};

// A triangle at one of its corners.
struct Leaf {
  Vec3 at;
  std::int32_t triangle;
  int corner;
};

std::vector<Leaf> leaves_of(const TrianglePatch& patch) {
  std::vector<Leaf> leaves;
  const std::span<const PatchTriangle> triangles = patch.triangles();
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      leaves.push_back({triangles[i].corners[k], static_cast<std::int32_t>(i), k});
    }
  }
  std::stable_sort(leaves.begin(), leaves.end(),
                   [](const Leaf& a, const Leaf& b) { return InOrder{}(a.at, b.at); });
  return leaves;
}

// Has each triangle a neighbour, with its front to the same side, beyond both of its edges there?
bool is_closed(const TrianglePatch& patch, std::span<const Leaf> around) {
  return std::all_of(around.begin(), around.end(), [&](const Leaf& leaf) {
    const auto& next = patch.triangles()[leaf.triangle].next[1];
    const TriangleSide after = next[leaf.corner], before = next[(leaf.corner + 2) % 3];
    return after.triangle >= 0 && before.triangle >= 0 && after.front && before.front;
  });
}

std::vector<Vec3> ring_of(const TrianglePatch& patch, std::span<const Leaf> around) {
  std::vector<Vec3> ring;
  for (const Leaf& leaf : around) {
    const Triangle& corners = patch.triangles()[leaf.triangle].corners;
    ring.push_back(corners[(leaf.corner + 1) % 3]);
    ring.push_back(corners[(leaf.corner + 2) % 3]);
  }
  std::sort(ring.begin(), ring.end(), InOrder{});
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  return ring;
}

bool is_convex(const TrianglePatch& patch, std::span<const Leaf> around,
               std::span<const Vec3> ring) {
  return std::all_of(around.begin(), around.end(), [&](const Leaf& leaf) {
    const PatchTriangle& triangle = patch.triangles()[leaf.triangle];
    return std::all_of(ring.begin(), ring.end(), [&](const Vec3& r) {
      return triangle.height_of(r) <= kFlat * (r - leaf.at).norm();
    });
  });
}

bool is_sharp(const TrianglePatch& patch, std::span<const Leaf> around) {
  const auto normal = [&](const Leaf& leaf) { return patch.triangles()[leaf.triangle].normal; };
  for (const Leaf& a : around) {
    for (const Leaf& b : around) {
      if (normal(a).dot(normal(b)) < kSharp) return true;
    }
  }
  return false;
}

Vec3 mean_of(std::span<const Vec3> points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

// Keys of triangles leave their lowest bits to what is of them: corners 0..2, edges 3..5.
std::int64_t key_of(const PatchTriangle& triangle, int feature) {
  return 8 * triangle.key + feature;
}

bool is_ridge(const PatchTriangle& a, const PatchTriangle& b, const Vec3& opposite) {
  const double size = (opposite - a.corners[0]).norm();
  return a.normal.dot(b.normal) < kSharp && a.height_of(opposite) < -kFlat * size;
}

class Finder {
 public:
  explicit Finder(const TrianglePatch& patch) : patch_(patch), taken_(patch.triangles().size()) {}

  void find_corners() {
    const std::vector<Leaf> leaves = leaves_of(patch_);
    for (std::size_t first = 0, last = 0; first < leaves.size(); first = last) {
      while (last < leaves.size() && leaves[first].at == leaves[last].at) ++last;
      look_at({leaves.data() + first, last - first});
    }
  }

  void find_ridges() {
    const std::span<const PatchTriangle> triangles = patch_.triangles();
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        const TriangleSide next = triangles[i].next[1][k];
        if (next.triangle <= static_cast<std::int32_t>(i) || !next.front) continue;
        if (!taken_[i][k] && !taken_[i][(k + 1) % 3]) look_at(triangles[i], k, next.triangle);
      }
    }
  }

  std::vector<SharpCorner> found;

 private:
  void look_at(std::span<const Leaf> around) {
    if (around.size() < 3 || !is_closed(patch_, around) || !is_sharp(patch_, around)) return;
    std::vector<Vec3> corners = ring_of(patch_, around);
    if (!is_convex(patch_, around, corners)) return;
    const Vec3 facing = around[0].at - mean_of(corners);
    corners.push_back(around[0].at);
    const PatchTriangle& lowest = patch_.triangles()[around[0].triangle];
    found.push_back({key_of(lowest, around[0].corner), std::move(corners), facing});
    for (const Leaf& leaf : around) taken_[leaf.triangle][leaf.corner] = true;
  }

  void look_at(const PatchTriangle& triangle, int edge, std::int32_t other) {
    const PatchTriangle& beyond = patch_.triangles()[other];
    const Vec3 &a = triangle.corners[edge], &b = triangle.corners[(edge + 1) % 3];
    const auto opposite = std::find_if(beyond.corners.begin(), beyond.corners.end(),
                                       [&](const Vec3& c) { return c != a && c != b; });
    if (!is_ridge(triangle, beyond, *opposite)) return;
    found.push_back({key_of(triangle, 3 + edge),
                     {a, b, triangle.corners[(edge + 2) % 3], *opposite},
                     triangle.normal + beyond.normal});
  }

  const TrianglePatch& patch_;
  std::vector<std::array<bool, 3>> taken_;  // by triangle and corner: has a part of its own
};

}  // namespace

std::vector<SharpCorner> sharp_corners(const TrianglePatch& patch) {
  Finder finder(patch);
  finder.find_corners();
  finder.find_ridges();
  return std::move(finder.found);
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet

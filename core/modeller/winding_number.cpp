#include "core/modeller/winding_number.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limber {
namespace {

constexpr double kFullAngle = 4.0 * std::numbers::pi;  // sr
constexpr std::int32_t kLeafTriangles = 8;

// A node is taken as one from this many of its radii on. Measured on round meshes against the sum:
// 2 (as in Barill et al.) is 0.006 off on average and 0.07 at worst, 3 is 0.002 and 0.03 off for
// twice the time, 4 is 0.001 and 0.02 off for five times.
constexpr double kAccuracy = 3.0;

}  // namespace

double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& q) {
  const Vec3 x = a - q, y = b - q, z = c - q;
  const double lx = x.norm(), ly = y.norm(), lz = z.norm();
  const double numerator = x.dot(y.cross(z));
  const double denominator = lx * ly * lz + x.dot(y) * lz + y.dot(z) * lx + z.dot(x) * ly;
  return 2.0 * std::atan2(numerator, denominator);
}

double winding_number(const TriangleMesh& mesh, const Vec3& q) {
  double sum = 0.0;
  for (const MeshTriangle& t : mesh.triangles)
    sum += solid_angle(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]], q);
  return sum / kFullAngle;
}

FastWindingNumber::FastWindingNumber(const TriangleMesh& mesh) {
  triangles_.reserve(mesh.triangles.size());
  for (const MeshTriangle& t : mesh.triangles)
    triangles_.push_back({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]});
  if (!triangles_.empty()) add_node(0, static_cast<std::int32_t>(triangles_.size()));
}

void FastWindingNumber::add_node(std::int32_t begin, std::int32_t end) {
  const std::size_t index = nodes_.size();
  nodes_.push_back(summary(begin, end));
  if (end - begin <= kLeafTriangles) {
    nodes_[index].leaf = true;
  } else {
    const std::int32_t middle = split(begin, end);
    add_node(begin, middle);
    add_node(middle, end);
  }
  nodes_[index].next = static_cast<std::int32_t>(nodes_.size());
}

FastWindingNumber::Node FastWindingNumber::summary(std::int32_t begin, std::int32_t end) const {
  Node node;
  node.begin = begin;
  node.end = end;
  double total = 0.0;
  for (std::int32_t i = begin; i < end; ++i) {
    const double area = triangles_[i].area().norm();
    total += area;
    node.centre += area * triangles_[i].centroid();
    node.area += triangles_[i].area();
  }
  node.centre = total > 0.0 ? Vec3(node.centre / total) : triangles_[begin].a;
  double radius = 0.0;
  for (std::int32_t i = begin; i < end; ++i) {
    const Triangle& t = triangles_[i];
    node.area_moment += (t.centroid() - node.centre) * t.area().transpose();
    for (const Vec3* p : {&t.a, &t.b, &t.c}) radius = std::max(radius, (*p - node.centre).norm());
  }
  node.reach = kAccuracy * radius;
  return node;
}

// Halves the list across the longest side of the box around the centroids.
std::int32_t FastWindingNumber::split(std::int32_t begin, std::int32_t end) {
  Vec3 low = triangles_[begin].centroid(), high = low;
  for (std::int32_t i = begin; i < end; ++i) {
    low = low.cwiseMin(triangles_[i].centroid());
    high = high.cwiseMax(triangles_[i].centroid());
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const std::int32_t middle = begin + (end - begin) / 2;
  const auto at = triangles_.begin();
  std::nth_element(at + begin, at + middle, at + end, [axis](const Triangle& s, const Triangle& t) {
    return s.centroid()[axis] < t.centroid()[axis];
  });
  return middle;
}

// A triangle's part is about n . (x - q) / |x - q|^3 at its centroid x = centre + d, n its vector
// area; to first order in d, with r = centre - q:
//   n . r / r^3 + n . d / r^3 - 3 (n . r) (r . d) / r^5.
double FastWindingNumber::at(const Vec3& q) const {
  double sum = 0.0;
  const auto count = static_cast<std::int32_t>(nodes_.size());
  for (std::int32_t i = 0; i < count;) {
    const Node& node = nodes_[i];
    const Vec3 r = node.centre - q;
    const double squared = r.squaredNorm();
    if (squared > node.reach * node.reach) {
      const double cubed = squared * std::sqrt(squared);
      sum += (node.area.dot(r) + node.area_moment.trace()) / cubed -
             3.0 * r.dot(node.area_moment * r) / (cubed * squared);
      i = node.next;
    } else if (node.leaf) {
      for (std::int32_t t = node.begin; t < node.end; ++t)
        sum += solid_angle(triangles_[t].a, triangles_[t].b, triangles_[t].c, q);
      i = node.next;
    } else {
      ++i;
    }
  }
  return sum / kFullAngle;
}

}  // namespace limber

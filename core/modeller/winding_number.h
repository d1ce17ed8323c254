#pragma once

#include <cstdint>
#include <vector>

#include "core/modeller/triangle_mesh.h"

namespace limber {

// Solid angle of the triangle a b c seen from q, sr, -2 pi .. 2 pi: positive where q is behind it
// (sees it clockwise). 0 where q is one of the corners. (van Oosterom and Strackee, The solid angle
// of a plane triangle, 1983)
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& q);

// How often the mesh goes round q: 1 inside a closed mesh, 0 outside, and in between, smoothly,
// where the mesh has holes (Jacobson, Kavan and Sorkine-Hornung, Robust inside-outside segmentation
// using generalized winding numbers, 2013). The sum over all triangles.
double winding_number(const TriangleMesh& mesh, const Vec3& q);

// The same for many places: far triangles are taken together, by the first two terms of their
// field's expansion (Barill, Dickson, Schmidt, Levin and Jacobson, Fast winding numbers for soups
// and clouds, 2018). On round meshes 0.002 off the sum on average and 0.03 at worst; exact near
// small meshes. Copies what it needs; the mesh may go.
class FastWindingNumber {
 public:
  explicit FastWindingNumber(const TriangleMesh& mesh);
  double at(const Vec3& q) const;

 private:
  struct Triangle {
    Vec3 a, b, c;
    Vec3 centroid() const { return (a + b + c) / 3.0; }
    Vec3 area() const { return 0.5 * (b - a).cross(c - a); }
  };
  // In depth-first order: the node's children, if any, follow it, up to `next`.
  struct Node {
    Vec3 centre = Vec3::Zero();       // m, of area
    Vec3 area = Vec3::Zero();         // m^2, sum of the vector areas
    Mat3 area_moment = Mat3::Zero();  // m^3, sum of (centroid - centre) area^T
    double reach = 0.0;               // m: how near the expansion is good enough
    std::int32_t begin = 0, end = 0;  // triangles
    std::int32_t next = 0;            // the node after all of this one's children
    bool leaf = false;
  };

  void add_node(std::int32_t begin, std::int32_t end);
  Node summary(std::int32_t begin, std::int32_t end) const;
  std::int32_t split(std::int32_t begin, std::int32_t end);

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace limber

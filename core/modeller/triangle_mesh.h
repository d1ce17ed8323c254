#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/model/vec3.h"

namespace limber {

using MeshTriangle = std::array<std::int32_t, 3>;  // anticlockwise seen from outside

// A surface as files hold it: closed or not, well made or not.
struct TriangleMesh {
  std::string name;             // of the file or the author, for messages
  std::vector<Vec3> positions;  // m
  std::vector<MeshTriangle> triangles;
};

// A body of density 1 kg/m^3: mass properties but for the density.
struct SolidMoments {
  double volume = 0.0;          // m^3
  Vec3 centre = Vec3::Zero();   // m; the origin where the volume is 0
  Mat3 inertia = Mat3::Zero();  // m^5, about the centre
};

// Sums of 1, x and x x^T over volumes, from which SolidMoments come. All about `origin`, which
// should be near the body: sums about a far point lose digits.
struct MomentSums {
  Vec3 origin = Vec3::Zero();  // m
  double zeroth = 0.0;         // m^3
  Vec3 first = Vec3::Zero();   // m^4
  Mat3 second = Mat3::Zero();  // m^5

  // A piece of this volume and centre, and its integral of (x - centre) (x - centre)^T.
  void add(double volume, const Vec3& centre, const Mat3& spread);
  SolidMoments moments() const;
};

// Exact for the polyhedron that a closed mesh bounds: the sum over the signed tetrahedra that the
// triangles span with a point (Mirtich, Fast and accurate computation of polyhedral mass
// properties, 1996; in tetrahedra: Blow and Binstock, How to find the inertia tensor, 2004). What
// is enclosed twice counts twice, what is inside out counts negative.
SolidMoments solid_moments(const TriangleMesh& mesh);

double surface_area(const TriangleMesh& mesh);  // m^2

// Lowest and highest corner, m. Both zero without positions.
std::pair<Vec3, Vec3> bounding_box(const TriangleMesh& mesh);

}  // namespace limber

#pragma once

#include <array>
#include <memory>
#include <variant>
#include <vector>

#include "bullet_bridge/precision.h"
#include "core/model/vec3.h"

class btCollisionShape;

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// The shapes of rigid bodies, all in m. Those with an axis stand along y; the origin is the middle.
struct BoxShape {
  Vec3 half_extents;
};
struct SphereShape {
  double radius = 0.0;
};
struct CapsuleShape {
  double radius = 0.0, height = 0.0;  // the height between the centres of its caps
};
struct CylinderShape {
  double radius = 0.0, height = 0.0;
};
struct ConeShape {
  double radius = 0.0, height = 0.0;
};
// The convex hull of at least four points that do not lie in a plane.
struct HullShape {
  std::vector<Vec3> points;
};
// For bodies that do not move.
struct MeshShape {
  std::vector<Vec3> positions;
  std::vector<std::array<std::int32_t, 3>> triangles;
};
// Heights, row by row, of a grid parallel to x and z about the origin. For bodies that do not move.
struct TerrainShape {
  int columns = 0;              // along x
  int rows = 0;                 // along z
  double spacing = 0.0;         // m, of the grid
  std::vector<double> heights;  // m, shape (rows, columns)
};

using SolidShape =
    std::variant<BoxShape, SphereShape, CapsuleShape, CylinderShape, ConeShape, HullShape>;

// Solids that are one body; each as heavy as its volume. They may overlap: what does counts twice.
struct CompoundShape {
  struct Part {
    SolidShape shape;
    Vec3 centre = Vec3::Zero();  // m
    Mat3 rotation = Mat3::Identity();
  };
  std::vector<Part> parts;
};

using StageShape = std::variant<BoxShape, SphereShape, CapsuleShape, CylinderShape, ConeShape,
                                HullShape, MeshShape, TerrainShape, CompoundShape>;

// Of one density, in the frame of the shape.
struct SolidVolume {
  double volume = 0.0;         // m^3
  Vec3 centre = Vec3::Zero();  // m, its centre of mass
};
SolidVolume volume_of(const SolidShape& shape);
SolidVolume volume_of(const CompoundShape& compound);

// Moves the parts so that their centre of mass is the origin; returns where it was.
Vec3 centre_parts(CompoundShape& compound);

// How a compound of this mass is laid in its body: Bullet keeps three moments of inertia, so its
// axes have to be the principal ones.
struct PrincipalFrame {
  Mat3 axes = Mat3::Identity();  // columns, in the frame of the parts
  Vec3 moments = Vec3::Zero();   // kg m^2, about them and the origin
};
PrincipalFrame principal_frame(const CompoundShape& compound, double mass);

// A rigid body of a Stage.
struct StageBody {
  StageShape shape;
  Vec3 centre = Vec3::Zero();  // m, of its shape: Bullet takes it for the centre of mass
  Mat3 rotation = Mat3::Identity();
  double mass = 0.0;  // kg, 0: does not move
  double friction = 0.5;
  double restitution = 0.0;
  Vec3 velocity = Vec3::Zero();  // m/s
  Vec3 spin = Vec3::Zero();      // rad/s
};

struct TriangleList {
  std::vector<Vec3> positions;                         // m
  std::vector<std::array<std::int32_t, 3>> triangles;  // anticlockwise from outside
};

// A shape of Bullet with what it points to.
class OwnedShape {
 public:
  // `axes`: of a compound's body, in the frame of its parts.
  explicit OwnedShape(const StageShape& shape, const Mat3& axes = Mat3::Identity());
  ~OwnedShape();
  OwnedShape(OwnedShape&&) noexcept;

  btCollisionShape& shape() const { return *shape_; }

 private:
  struct Data;
  std::unique_ptr<Data> data_;
  std::unique_ptr<btCollisionShape> shape_;
};

// What is seen of a hull, a mesh or a terrain; empty for the others, which have formulas.
TriangleList triangles_of(const StageShape& shape);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet

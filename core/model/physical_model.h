#pragma once

#include <limits>
#include <string>

#include "core/model/geometric_model.h"

namespace limber {

inline constexpr double kUnbreakable = std::numeric_limits<double>::infinity();

struct PointAttributes {
  double mass = 0.0;             // kg, > 0
  Vec3 velocity = Vec3::Zero();  // m/s
};

struct EdgeAttributes {
  double stiffness = 0.0;                 // N/m, >= 0
  double damping = 0.0;                   // N s/m, >= 0, along the edge only
  double rest_length = 0.0;               // m, > 0
  double break_threshold = kUnbreakable;  // m of stretch (L - L0) the spring bears, > 0
  bool broken = false;
};

// Air resistance; read by the wind of a later version, kept through every operator.
struct FaceAttributes {
  double normal_drag = 0.0;      // kg/m^3, force per area per squared normal speed
  double tangential_drag = 0.0;  // kg/m^3
};

struct CellAttributes {
  bool valid = true;  // false once one of its edges broke
};

// How one part looks; it has no influence on the physics.
struct SurfaceProperties {
  Vec3 colour = {0.8, 0.8, 0.8};  // linear RGB, 0..1
  double specularity = 0.3;       // 0..1
  double transparency = 0.0;      // 0 opaque .. 1 clear
};

// What belongs to the object as a whole.
struct ObjectAttributes {
  double friction = 0.5;          // Coulomb coefficient, combined with the partner's by product
  double restitution = 0.0;       // of contacts, 0..1, combined by product as Bullet does
  double internal_damping = 0.0;  // 1/s, draws each connected piece towards its rigid motion
  double softening = 1.0;         // S: real modulus / modulus simulated, for the reports
};

// A geometric model with all its physical attributes: what the simulator takes and gives back.
struct PhysicalModel {
  std::string name;
  GeometricModel geometry;
  IdVector<PointId, PointAttributes> points;
  IdVector<EdgeId, EdgeAttributes> edges;
  IdVector<FaceId, FaceAttributes> faces;
  IdVector<CellId, CellAttributes> cells;
  std::vector<SurfaceProperties> surfaces;  // one per subobject
  ObjectAttributes object;
};

// Default attributes for every element; rest lengths from the geometry.
PhysicalModel with_default_attributes(GeometricModel geometry, std::string name);

// Rigid placement: x -> rotation x + translation, velocities rotated alike.
void place(PhysicalModel& model, const Mat3& rotation, const Vec3& translation_m);

// Adds v + omega x (x - centre of mass) to every point's velocity.
void set_in_motion(PhysicalModel& model, const Vec3& velocity_m_s, const Vec3& omega_rad_s);

}  // namespace limber

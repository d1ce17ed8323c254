#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "core/model/geometric_model.h"
#include "core/model/skin.h"

namespace limber {

inline constexpr double kUnbreakable = std::numeric_limits<double>::infinity();

struct PointAttributes {
  double mass = 0.0;             // kg, > 0
  Vec3 velocity = Vec3::Zero();  // m/s
  bool pinned = false;           // held where it is: forces act on it and move nothing
};

struct EdgeAttributes {
  double stiffness = 0.0;                 // N/m, >= 0
  double damping = 0.0;                   // N s/m, >= 0, along the edge only
  double rest_length = 0.0;               // m, > 0
  double break_threshold = kUnbreakable;  // m of stretch (L - L0) the spring bears, > 0
  // m of shortening (L0 - L) it bears, > 0. Infinite: what the paper calls the maximum amount the
  // spring will stretch; as large as break_threshold: its section 5.2, the difference either way.
  double crush_threshold = kUnbreakable;
  bool broken = false;
};

// How a face resists the air that passes it; see environment/face_drag.h for the formulas.
enum class DragLaw : std::uint8_t { kQuadratic, kLinear, kPressure };

// Both coefficients: without unit for kQuadratic and kPressure, kg/(m^2 s) for kLinear. 0: no drag.
struct FaceAttributes {
  DragLaw drag_law = DragLaw::kQuadratic;
  double normal_drag = 0.0;
  double tangential_drag = 0.0;  // kPressure has none
};

struct CellAttributes {
  bool valid = true;  // false once one of its edges broke
};

// How one part looks; it has no influence on the physics.
struct SurfaceProperties {
  Vec3 colour = {0.8, 0.8, 0.8};     // linear RGB, 0..1
  double specularity = 0.3;          // 0..1
  double transparency = 0.0;         // 0 opaque .. 1 clear
  double index_of_refraction = 1.5;  // of what is transparent, >= 1: 1.33 water, 1.5 glass
  std::string texture;               // file of an image; empty: none
  // m, how thick what has no faces is: edges of no cell (rope) and points without edges (grains). 0:
  // they are not seen.
  double strand_radius = 0.0;
};

// What belongs to one subobject and follows it through gluing and breaking.
struct SubobjectAttributes {
  SurfaceProperties surface;
  // Anything else the user of the model wants to keep, by name and in SI: {"temperature", 300.0}.
  // Limber carries the values and never reads them.
  std::map<std::string, double> values;
};

// What belongs to the object as a whole.
struct ObjectAttributes {
  double friction = 0.5;          // Coulomb coefficient, combined with the partner's by product
  double restitution = 0.0;       // of contacts, 0..1, combined by product as Bullet does
  double internal_damping = 0.0;  // 1/s, draws each connected piece towards its rigid motion
  double softening = 1.0;         // S: real modulus / modulus simulated, for the reports
  // Contact radius of a point as a share of its shortest edge, 0..0.45: two neighbours' spheres
  // must not overlap at rest, or breaking their edge would set free contact energy. 0: points of
  // this object pass through one another and cost no contact.
  double contact_share = 0.45;
  // m, contact radius of a point that has no edge from the start, such as a grain: nothing else says
  // how large it is. 0: it passes through other points.
  double particle_radius = 0.0;
};

// A geometric model with all its physical attributes: what the simulator takes and gives back.
struct PhysicalModel {
  std::string name;
  GeometricModel geometry;
  IdVector<PointId, PointAttributes> points;
  IdVector<EdgeId, EdgeAttributes> edges;
  IdVector<FaceId, FaceAttributes> faces;
  IdVector<CellId, CellAttributes> cells;
  std::vector<SubobjectAttributes> parts;  // one per subobject
  std::vector<Skin> skins;               // what is seen instead of the boundary, where there are any
  ObjectAttributes object;
};

// Default attributes for every element; rest lengths from the geometry.
PhysicalModel with_default_attributes(GeometricModel geometry, std::string name);

// Rigid placement: x -> rotation x + translation, velocities rotated alike.
void place(PhysicalModel& model, const Mat3& rotation, const Vec3& translation_m);

double total_mass(const PhysicalModel& model);  // kg

// m. Throws InputError where there is no mass.
Vec3 centre_of_mass(const PhysicalModel& model);

// Adds v + omega x (x - centre) to every point's velocity; without a centre, the centre of mass.
void set_in_motion(PhysicalModel& model, const Vec3& velocity_m_s, const Vec3& omega_rad_s,
                   const Vec3& centre_m);
void set_in_motion(PhysicalModel& model, const Vec3& velocity_m_s, const Vec3& omega_rad_s);

}  // namespace limber

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/dynamics/rigid_motion.h"
#include "core/model/physical_model.h"
#include "core/operators/breaking_operator.h"

namespace limber {

// What moves a point.
enum class PointRole : std::uint8_t {
  kIdle,     // nothing: its piece is rigid and no flexible piece is near
  kDynamic,  // its springs and the forces on it
  kCarried,  // somebody else (a rigid body near flexible ones); it still takes contact forces
};

struct Spring {
  std::int32_t a, b;       // points
  double stiffness;        // N/m
  double damping;          // N s/m
  double rest_length;      // m
  double break_threshold;  // m of stretch
  double crush_threshold;  // m of shortening

  bool breakable() const {
    return break_threshold < kUnbreakable || crush_threshold < kUnbreakable;
  }
};

// One object's share of the arrays, and what it takes to turn them into a PhysicalModel again.
struct LatticeObject {
  PhysicalModel authored;  // names, geometry and attributes as added
  IdRange<PointId> points;
  IdRange<EdgeId> edges;
  IdRange<FaceId> faces;
  IdRange<CellId> cells;
  double spring_frequency = 0.0;   // rad/s, bound on the highest of its springs at small strains,
                                   // at any strain if it may fold
  double spring_damping = 0.0;     // 1/s, the damping rate 2 zeta omega there
  double contact_frequency = 0.0;  // omega_c of penalty.h, rad/s
  bool has_loose_points = false;   // without a spring: grains, and what broke off before
  double step_strain = 0.0;        // up to which its step holds: see LargestStrain
  bool implicit = false;           // by implicit Euler: forces do not have those of its springs
  double least_mass = 0.0;         // kg, of a point
  double largest_step = 0.0;       // s, stable with its springs and contacts
};

// All simulated objects, compiled into arrays. Topology and constants do not change while they are
// simulated; motion, breaking and roles do. P points, E edges, F faces, C cells.
struct Lattice {
  std::vector<LatticeObject> objects;

  std::vector<PointMotion> motion;         // shape (P), m and m/s
  std::vector<Vec3> force;                 // shape (P), N
  std::vector<double> mass;                // shape (P), kg
  std::vector<double> inverse_mass;        // shape (P), 1/kg: 0 for pinned points
  std::vector<PointRole> role;             // shape (P)
  std::vector<Vec3> authored_position;     // shape (P), m, as added
  std::vector<double> contact_radius;      // shape (P), m
  std::vector<std::int32_t> point_object;  // shape (P)
  std::vector<std::uint8_t> touched;       // shape (P): set by every contact force on the point
  std::vector<double> peak_load;  // shape (P): largest sampled stretch / threshold of its springs

  std::vector<Spring> springs;                 // shape (E), as added
  IndexRows point_edges;                       // point -> edges
  std::vector<std::int32_t> point_neighbours;  // other end of each edge in point_edges.items
  std::vector<std::array<std::int32_t, 3>> face_corners;  // shape (F): points, as authored
  std::vector<std::uint8_t> face_two_sided;  // shape (F): of a sheet, or of a cell that is flat
  BreakingTopology topology;
  BreakingState breaking;

  // The springs that are integrated: unbroken, both ends dynamic. Compact copies, so that the inner
  // loop streams through them; one that breaks goes slack until the next rebuild. First those that
  // cannot break: they skip the check.
  std::vector<Spring> active;  // shape (A)
  std::size_t first_breakable = 0;
  std::vector<std::int32_t> active_edge;     // shape (A) -> edge
  std::vector<std::int32_t> active_of_edge;  // shape (E) -> active or -1
  std::vector<std::int32_t> dynamic_points;
  std::vector<std::int32_t> carried_points;
  std::vector<std::int32_t> carrier;  // shape (P): which body carries it, for carried points
};

// Are the points joined by an unbroken edge?
bool joined(const Lattice& lattice, std::int32_t p, std::int32_t q);

// Of the edge's spring as the points are now, m.
double length_of(const Lattice& lattice, std::int32_t edge);

// Has this edge passed one of its thresholds?
bool is_overstretched(const Lattice& lattice, std::int32_t edge);

inline bool is_implicit(const Lattice& lattice, std::int32_t p) {
  return lattice.objects[lattice.point_object[p]].implicit;
}

// m/s, at the end of a substep of dt (s) by the forces summed so far; of points that are not
// dynamic the present one.
inline Vec3 velocity_after(const Lattice& lattice, std::int32_t p, double dt) {
  const Vec3& velocity = lattice.motion[p].velocity;
  if (lattice.role[p] != PointRole::kDynamic) return velocity;
  return velocity + lattice.force[p] * (dt * lattice.inverse_mass[p]);
}

// Appends a model; all its points start dynamic. Throws InputError where validate() objects.
// Returns the index of the object. Call rebuild_active() afterwards.
std::size_t add_object(Lattice& lattice, PhysicalModel model);

// The object is simulated no more: nothing moves its points, and its authored model goes but for
// the name and the attributes of the whole. Its indices stay, so that those of others do. Call
// rebuild_active() afterwards.
void retire_object(Lattice& lattice, std::size_t object);

// What the springs of an object are about to bear. The bound on its frequencies is that of the
// shape at rest. Strain turns springs: their stiffness counts in new directions, and from a strain
// of kSmallStrain on the vibrations of an undamped lattice feed one another at the full step.
// Damping of kCalmingDampingRatio at the highest frequency keeps most of them stable up to
// kCalmStrain (docs/limits.md has the numbers).
enum class LargestStrain { kSmall, kAny };
inline constexpr double kSmallStrain = 1e-3;
inline constexpr double kCalmStrain = 0.2;
inline constexpr double kCalmingDampingRatio = 0.01;

// No shape has frequencies above this many times those of the shape at rest. k I bounds a spring's
// stiffness in every shape; a mode of that in one direction, tried in three perpendicular ones on
// the shape at rest (k n n^T), meets as much stiffness in all, so a third of it in one.
inline constexpr double kMostGainByTurning = 1.7320508075688772;  // sqrt(3)

// Step of semi-implicit Euler, s, that stays stable when each point is also tied to something by a
// spring (N/m) and a damper (N s/m), such as a penalty ground.
double largest_step(const LatticeObject& object, double stiffness = 0.0, double damping = 0.0,
                    LargestStrain strain = LargestStrain::kSmall);

// The same as if it had no springs: what contacts allow.
double largest_contact_step(const LatticeObject& object);

// Is a spring of this object strained by more than its step_strain, or fast enough to be so within
// a radian of the highest frequency? At the cost of a pass over its springs.
bool is_strained(const Lattice& lattice, std::size_t object);

// Refreshes `active`, `dynamic_points` and `carried_points` after breaks and changes of role.
void rebuild_active(Lattice& lattice);

// Refreshes `carried_points` alone.
void rebuild_carried(Lattice& lattice);

// Makes the active copies of just broken edges slack; they stay in the list until the next rebuild.
void slacken(Lattice& lattice, std::span<const std::int32_t> broken_edges);

// The object as an authored model again: today's positions, velocities and breaks. The paper's
// promise: the output of one simulation is the input of another.
PhysicalModel extract_model(const Lattice& lattice, std::size_t object);

// Elastic energy of the unbroken springs of these points, J (each spring once, by its point a).
double elastic_energy(const Lattice& lattice, std::span<const std::int32_t> points);

// Share of the median k / m that the squared contact frequency gets. Measured on a breaking teapot:
// 10 times more or less moves the first break by less than a millisecond, but the amount of dust by
// a factor of two to three.
inline constexpr double kContactStiffnessShare = 0.1;

// A soft or tall object gets more: standing on the ground it may sink by this share of its spacing
// a. Its lowest points bear columns of H / a points each, so that they sink by g (H / a) /
// omega_c^2.
inline constexpr double kContactSinkShare = 0.05;
// Balls of one size touch at most this many others, and a grain has no other springs. Where
// contacts are as stiff as springs the step is that of so many, also because a contact begins and
// ends within a step: with z = omega_c dt one collision may give back (z/2)^2 / (1 - (z/2)^2) more
// energy than it took, 8 % at this step and 1.7 times on average at the limit.
inline constexpr double kContactsOfAGrain = 12.0;

inline constexpr double kStandardGravity = 9.80665;  // m/s^2

}  // namespace limber

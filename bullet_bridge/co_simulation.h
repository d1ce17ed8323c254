#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bullet_bridge/hand_over.h"
#include "bullet_bridge/precision.h"
#include "bullet_bridge/switch_policy.h"
#include "core/dynamics/spring_precision.h"
#include "core/environment/environment.h"
#include "core/model/errors.h"
#include "core/model/physical_model.h"
#include "core/model/surface_model.h"

class btCollisionObject;
class btDiscreteDynamicsWorld;
class btRigidBody;
class btTypedConstraint;

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

enum class Representation {
  kSwitching,       // rigid until it matters
  kAlwaysFlexible,  // the accuracy reference
  kAlwaysRigid,     // never breaks
};

#ifdef BT_USE_DOUBLE_PRECISION
inline constexpr SpringPrecision kWorldSprings = SpringPrecision::kDouble;
#else
inline constexpr SpringPrecision kWorldSprings = SpringPrecision::kSingle;
#endif

// How lattices are integrated; docs/integrators.md says when each wins.
enum class Integration {
  kExplicit,   // symplectic Euler: what breaks on impact lives on its vibration
  kImplicit,   // implicit Euler: no vibration, any stiffness, substeps for the contacts alone
  kAutomatic,  // explicit; an object that would need more than most_substeps goes implicit, and
               // CoSimulation::notes() says so
};

struct CoSimulationSettings {
  Representation representation = Representation::kSwitching;
  SwitchSettings switching = {};
  double step_scale = 1.0;     // (0, 1]: factor on the automatically chosen substep
  int most_substeps = 100000;  // a tick that would need more is refused by name; see kAutomatic
  Integration integration = Integration::kExplicit;
  // How the forces of springs are summed. At first as precisely as the world: in single precision
  // by vector instructions beside Bullet in float32, several times as fast (docs/performance.md),
  // and in double precision beside float64. Motion is integrated in double precision either way.
  SpringPrecision springs = kWorldSprings;
  // How long particles (points that lost all their edges) live, s: 0 or more, or infinity. Then
  // they stay where they are and nothing moves them any more; their mass is counted as retired.
  double debris_lifetime = std::numeric_limits<double>::infinity();
};

// One change of representation with what decided it.
struct SwitchRecord {
  double time = 0.0;  // s: turning flexible at the start of a tick, rigid at its end
  std::size_t object = 0;
  std::size_t piece = 0;  // counts up over the whole simulation
  std::string cause;      // "touch", "sustained load", "missed touch", "calm", "start"
  std::vector<std::pair<std::string, double>> numbers;
  HandOver books;
};

// A spring that bore too much. What followed from it is in the model.
struct BreakRecord {
  double time = 0.0;  // s
  std::size_t object = 0;
  Vec3 where;                        // m
  std::int32_t edge = 0;             // of the object
  std::int32_t cell = -1;            // of the object: the first one it took with it; -1: none
  std::optional<std::size_t> piece;  // that its first end belongs to after the tick; none: debris
};

// A piece that came apart.
struct SplitRecord {
  double time = 0.0;  // s, end of the tick
  std::size_t object = 0;
  std::size_t piece = 0;                // what it was
  std::vector<std::size_t> parts = {};  // the pieces it became
  std::size_t particles = 0;            // and points that became debris
};

// What lattices of an object and a body of the world did to one another in a step: Bullet's
// manifolds know nothing of it. What two lattices do to one another is not among these.
struct LatticeContact {
  std::size_t object = 0;
  std::optional<std::size_t> other;         // the object whose piece the body stands for
  const btCollisionObject* body = nullptr;  // the game's own; null where `other` says more
  Vec3 at = Vec3::Zero();                   // m, where they pushed hardest
  double impulse = 0.0;                     // N s, the size of all pushes, of all places
};

// One connected piece as it is now.
struct PieceView {
  std::size_t id = 0;  // counts up over the whole simulation; never used again
  std::size_t object = 0;
  bool flexible = false;
  btRigidBody* body = nullptr;  // stands for it in the world, in either representation
  RigidMotion motion;
  std::vector<std::int32_t> points;  // of the object, ascending
};

struct Counters {
  std::uint64_t spring_updates = 0;
  std::size_t broken_edges = 0;
  std::size_t to_flexible = 0;
  std::size_t to_rigid = 0;
  std::size_t missed = 0;    // touches that no prediction foresaw and whose load was over the limit
  std::size_t needless = 0;  // turned flexible and back without having been touched
  std::size_t particles = 0;    // points that lost all their edges, so far
  double retired_mass = 0.0;    // kg, of particles that outlived debris_lifetime
  std::size_t regularised = 0;  // bodies whose points lie on a line and got a moment about it
  double flexible_mass_seconds = 0.0;  // kg s
  double mass_seconds = 0.0;           // kg s, of all pieces
  double stored_J = 0.0;               // elastic energy in rigid pieces now
};

// Flexible, breakable objects in a game's own Bullet world.
//
// Attach it to any btDiscreteDynamicsWorld, add models, and step the world as before. An object is
// a btRigidBody while nothing stresses it, a spring lattice while something does, and several rigid
// bodies after it broke.
//
// Contract. Limber owns the points of its objects and the proxies it adds; Bullet owns every other
// body. A piece has one body in the world for as long as it exists, whichever its representation:
// what the game's queries hit and what it pushes, moves and joins (docs/bridge.md). Within a tick:
// (1) before the solver runs, proxies that are about to be loaded become lattices, and all lattices
// are integrated together with the bodies they may touch; momentum is exchanged in equal and
// opposite amounts; (2) after the solver, impulses of contacts on proxies, and of the game's
// constraints on lattices, are read; (3) after bodies moved, poses are corrected, pieces are split,
// calmed pieces become bodies.
// Momentum, angular momentum and centre of mass of a piece are the same before and after every
// change of representation.
class CoSimulation {
 public:
  // The world must outlive this; it is left as it was found when this is destroyed (but for the
  // bodies of pieces, which go: remove the game's constraints on them before, as with any body).
  // Throws InputError for settings out of range.
  explicit CoSimulation(btDiscreteDynamicsWorld& world, const CoSimulationSettings& settings = {});
  ~CoSimulation();
  CoSimulation(const CoSimulation&) = delete;
  CoSimulation& operator=(const CoSimulation&) = delete;

  // Adds an object where its points are, with their velocities. Not during a step. Returns its
  // index. What holds a pinned point stays flexible, what is under load starts so. Throws
  // InputError naming what is wrong with the model, or that it is pinned and kAlwaysRigid is asked
  // for.
  // `integration`: of this object; none: that of the settings.
  std::size_t add(PhysicalModel model, std::optional<Integration> integration = {});

  // Takes an object out of the world, whatever it is just now: all of its pieces with their bodies,
  // its debris and its contacts. What touched it wakes. Its index is not used again, those of
  // others stay, and so do all records; questions about it throw InputError from now on. Not during
  // a step. Throws InputError, and removes nothing, for an object that is missing and while
  // constraints of the game name its bodies: take constraints_on() out of the world first.
  void remove(std::size_t object);

  // Is the object there: added, and not removed?
  bool has_object(std::size_t object) const;

  // The game's constraints in the world that name bodies of the object, also those that a break
  // disabled, in the order of the world. Constraints of multi-bodies are not among them.
  std::vector<btTypedConstraint*> constraints_on(std::size_t object) const;

  // The air that all faces with a drag coefficient feel, in either representation. None at first.
  // Change the wind between steps; its animation goes by the simulation's time. Throws InputError.
  void set_air(std::optional<Air> air);
  const std::optional<Air>& air() const;

  // An impulse, N s, at a place of the object, m, in either representation: at once on a rigid
  // piece, throughout the next tick on the points around the place of a flexible one, whose body
  // would spread it over all of them. The piece that is nearest gets it; debris takes none. Throws
  // InputError for an object that is missing, and for infinities and NaN.
  void apply_impulse(std::size_t object, const Vec3& impulse, const Vec3& at);

  // The object whose piece a body stands for, such as one that a ray hit.
  std::optional<std::size_t> object_of(const btCollisionObject& body) const;

  // The object as it is now: positions, velocities, breaks. Can be edited, glued and added again.
  PhysicalModel model(std::size_t object) const;

  // What is seen of it: skin_surface() of model(). Which faces these are is kept up to date at the
  // cost of what breaks; putting them together costs the object.
  SurfaceModel surface(std::size_t object) const;

  // Why the simulation of the lattices stopped, if it did; ask after every stepSimulation().
  // (Bullet cannot be left by an exception in the middle of a step.)
  const std::optional<Diagnostic>& failure() const;

  // What was decided on the way that a user should know.
  const std::vector<Diagnostic>& notes() const;

  std::size_t object_count() const;  // that were ever added: indices are below
  std::vector<PieceView> pieces() const;
  double debris_mass(std::size_t object) const;  // kg, points without edges
  // Per point of the object: is it part of a lattice now?
  std::vector<bool> flexible_points(std::size_t object) const;
  // Best rigid fit of the whole object against its shape when it was added, and its centre.
  std::pair<Mat3, Vec3> placement(std::size_t object) const;

  const Counters& counters() const;
  const std::vector<SwitchRecord>& switches() const;
  const std::vector<BreakRecord>& breaks() const;
  const std::vector<LatticeContact>& lattice_contacts() const;  // of the last step
  const std::vector<SplitRecord>& splits() const;

  // Hash of every bit of the points, of what is broken, of the roles, and of the poses and
  // velocities of all of Bullet's bodies.
  std::uint64_t state_hash() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet

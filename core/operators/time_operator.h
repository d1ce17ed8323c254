#pragma once

#include <optional>
#include <vector>

#include "core/contact/cell_contacts.h"
#include "core/contact/point_contacts.h"
#include "core/contact/surface_contacts.h"
#include "core/dynamics/component_tracker.h"
#include "core/dynamics/lattice.h"
#include "core/dynamics/runge_kutta.h"
#include "core/dynamics/spring_forces.h"
#include "core/environment/environment.h"
#include "core/environment/face_forces.h"
#include "core/environment/ground_contact.h"
#include "core/model/errors.h"
#include "core/operators/boundary_tracker.h"
#include "core/operators/implicit_bodies.h"

namespace limber {

// What the world outside of the lattice does in every substep: rigid bodies.
class SubstepCoupling {
 public:
  virtual ~SubstepCoupling() = default;
  // Adds to lattice.force of dynamic and carried points, which has gravity's and the explicit
  // springs' forces already. Once a substep.
  virtual void add_forces(Lattice& lattice, double dt) = 0;
  // Reads lattice.force of carried points and moves them on by dt.
  virtual void advance(Lattice& lattice, double dt) = 0;
};

struct BreakEvent {
  double time = 0.0;       // s, of the operator's clock
  std::int32_t edge = 0;   // the edge that bore too much
  std::int32_t cell = -1;  // the first cell it took with it, if any
  std::int32_t piece = 0;  // label in pieces() of its first end, after the substep
  std::int32_t object = 0;
  Vec3 where;  // m
};

// A piece came off another: labels of pieces(), valid until the next roles_changed().
struct SplitEvent {
  double time = 0.0;  // s, of the operator's clock
  std::int32_t from = 0, to = 0;
};

struct StepReport {
  std::uint64_t spring_updates = 0;
  double damped_J = 0.0;  // taken out by internal damping
  GroundReport ground;
  std::vector<BreakEvent> breaks;  // in order of time
  std::vector<SplitEvent> splits;  // in order of time
  std::size_t broken_edges = 0;    // marked and consequent
};

enum class Integrator {
  kSymplecticEuler,  // v += f/m dt, x += v dt: the default
  kExplicitEuler,    // for comparison only
  kRungeKutta4,      // the accuracy reference
  kImplicitEuler,    // stable at any stiffness and damping; see implicit_euler.h
};

// The time operator (paper, section 5.1): forces of springs and dampers, gravity, point-point
// penalty, air, ground and the coupling are summed at the points and integrated. The breaking
// operator runs inside it, as the paper has it, at the end of each substep. Every
// `kDampingInterval` substeps the internal damping draws each connected piece towards its rigid
// motion, and the load on the springs is sampled into lattice.peak_load.
//
// Objects may be integrated by implicit Euler while the others go by the operator's own method:
// neither their springs nor the stiffness of a penalty ground bound the step then. Contacts with
// points and bodies and the air act on them explicitly, as on the others.
//
// Pinned points stay where they are; lattice.force holds what they carry. Runge-Kutta methods
// evaluate the coupling once a substep, everything else at every stage; they do not know carried
// points.
class TimeOperator {
 public:
  explicit TimeOperator(Lattice& lattice, Integrator integrator = Integrator::kSymplecticEuler,
                        SpringPrecision precision = SpringPrecision::kDouble)
      : lattice_(lattice),
        integrator_(integrator),
        springs_(lattice,
                 integrator == Integrator::kImplicitEuler ? SpringPrecision::kDouble : precision) {}

  // Integrates this object, an index of lattice.objects, by implicit Euler from now on, and sums
  // its springs in double precision: the method has springs of its own, and what two precisions
  // differ by would push a stiff body from outside. Throws InputError in an operator of another
  // method than symplectic or implicit Euler.
  void make_implicit(std::size_t object);
  bool is_implicit(std::size_t object) const;

  // Largest step of symplectic Euler that is stable for every object with a dynamic point in this
  // environment, s; infinity without springs or anything else that pushes. Of implicit objects only
  // contacts with points and bodies count. Drag is left out: it has to be faster than a substep to
  // matter. Goes by the strains of the moment: ask again as a simulation goes on.
  double largest_step(const Environment& environment = kEmptySpace) const;
  double largest_step_of(std::size_t object, const Environment& environment = kEmptySpace) const;

  // Which object that is; none where nothing bounds the step.
  std::optional<std::size_t> hardest_object(const Environment& environment = kEmptySpace) const;

  // The clock that wind and events go by, s. Starts at 0, runs in advance().
  double time() const { return time_; }
  void set_time(double time_s) { time_ = time_s; }

  // Integrates `substeps` of `dt` (s). Throws SimulationError that names the point and its object
  // when a position or velocity is no longer finite, InputError for a step or an environment that
  // makes no sense and for points deep in a hard ground.
  StepReport advance(int substeps, double dt, const Environment& environment,
                     SubstepCoupling* coupling = nullptr);

  // Springs, dampers, break check and integration alone, in free space: what a micro-benchmark
  // measures and every other cost is compared with. Returns the spring updates.
  std::uint64_t advance_springs_only(int substeps, double dt);

  // Pieces as of the last substep.
  const Components& pieces();

  // Has somebody's boundary follow every break from now on; null: nobody's.
  void keep_boundary(BoundaryTracker* tracker) { boundary_ = tracker; }

  // Whether to sample the load on the springs; it costs a tenth of the fast springs.
  void watch_load(bool wanted) { watches_load_ = wanted; }

  // How lattices touch one another, and what their contacts remember. Put aside while those that
  // touch stand still and others are integrated alone, and taken back afterwards together with the
  // contacts of these; roles_changed() has to follow either.
  struct LatticeContacts {
    PointContacts points;
    CellContacts cells;
    SurfaceContacts faces;
  };
  LatticeContacts put_contacts_aside();
  void take_contacts_back(LatticeContacts aside);

  // To be told after rebuild_active(), and after rebuild_carried() alone.
  void roles_changed();
  void carried_changed() { carried_stale_ = true; }

 private:
  void require_sound_step(double dt, const Environment& environment,
                          const SubstepCoupling* coupling) const;
  std::vector<double> leads(double dt) const;  // s, of positions before velocities, each object
  void refresh_contacts();
  void refresh_faces(const Environment& environment);
  bool is_symplectic() const {
    return integrator_ == Integrator::kSymplecticEuler || integrator_ == Integrator::kImplicitEuler;
  }
  void apply_gravity(const Vec3& gravity);
  void sum_forces(const Environment& environment, double time, double dt, double weight);
  void step_symplectic(const Environment& environment, double dt, SubstepCoupling* coupling);
  void step_runge_kutta(const ButcherTableau& tableau, const Environment& environment, double dt,
                        SubstepCoupling* coupling);
  void evaluate_coupling(const Vec3& gravity, double dt, SubstepCoupling* coupling);
  void move_to_stage(const ButcherTableau& tableau, int stage, double dt);
  void complete_stages(const ButcherTableau& tableau, double dt);
  void integrate(double dt);
  void make_all_implicit();
  void break_overstretched(StepReport& report);
  BreakEvent event_of(std::int32_t edge) const;
  void sample_load();
  void require_finite() const;
  SimulationError blown_up(std::int32_t point) const;

  Lattice& lattice_;
  Integrator integrator_;
  double time_ = 0.0;
  LatticeContacts contacts_;
  GroundContact ground_;
  std::vector<DragFace> faces_;  // that feel the air
  ComponentTracker pieces_;
  BoundaryTracker* boundary_ = nullptr;
  BreakingResult broken_;  // of the last substep in which something broke
  bool watches_load_ = true;
  bool pieces_stale_ = true;
  bool contacts_stale_ = true;
  bool carried_stale_ = false;
  bool faces_stale_ = true;
  SpringForces springs_;
  double summed_at_ = 0.0;  // s, when forces were summed last
  std::size_t slack_ = 0;   // active springs that broke since the last rebuild

  ImplicitBodies implicit_;
  std::span<const PointSupport> supports_;  // of ground_, for the present step

  // Runge-Kutta: shape (dynamic points), or (stages, dynamic points)
  std::vector<PointMotion> start_;
  std::vector<PointMotion> slopes_;  // velocity and acceleration
  std::vector<Vec3> coupling_force_;
};

// Substeps between two applications of internal damping. 32 substeps are a small part of its time
// (1/30 s is a thousand substeps of a ceramic) and make its cost a few per cent of the springs'.
inline constexpr int kDampingInterval = 32;

}  // namespace limber

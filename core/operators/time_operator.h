#pragma once

#include <vector>

#include "core/contact/point_contacts.h"
#include "core/dynamics/components.h"
#include "core/dynamics/lattice.h"

namespace limber {

// What the world outside of the lattice does in every substep: the ground, rigid bodies.
class SubstepCoupling {
 public:
  virtual ~SubstepCoupling() = default;
  // Adds to lattice.force of dynamic and carried points.
  virtual void add_forces(Lattice& lattice, double dt) = 0;
  // Reads lattice.force of carried points and moves them on by dt.
  virtual void advance(Lattice& lattice, double dt) = 0;
};

struct BreakEvent {
  double time = 0.0;      // s since the start of the call
  std::int32_t edge = 0;  // the edge that was overstretched; what followed from it is in the state
  Vec3 where;             // m
};

struct StepReport {
  std::uint64_t spring_updates = 0;
  double damped_J = 0.0;           // taken out by internal damping
  std::vector<BreakEvent> breaks;  // in order of time
  std::size_t broken_edges = 0;    // marked and consequent
};

// The time operator (paper, section 5.1): forces of springs and dampers, gravity, point-point
// penalty and the coupling are summed at the points and integrated by semi-implicit Euler,
// v += f/m dt, x += v dt. The breaking operator runs inside it, as the paper has it. Every
// `kDampingInterval` substeps the internal damping draws each connected piece towards its rigid
// motion, and the load on the springs is sampled into lattice.peak_load.
class TimeOperator {
 public:
  explicit TimeOperator(Lattice& lattice) : lattice_(lattice) {}

  // Largest step that is stable for every object with a dynamic point, s; infinity without springs.
  double largest_step() const;

  // Integrates `substeps` of `dt` (s). Throws SimulationError that names the point and its object
  // when a position or velocity is no longer finite.
  StepReport advance(int substeps, double dt, const Vec3& gravity_m_s2,
                     SubstepCoupling* coupling = nullptr);

  // Springs, dampers, break check and integration alone, in free space: what a micro-benchmark
  // measures and every other cost is compared with. Returns the spring updates.
  std::uint64_t advance_springs_only(int substeps, double dt);

  // Pieces as of the last substep.
  const Components& pieces();

  // To be told after rebuild_active(), and after rebuild_carried() alone.
  void roles_changed();
  void carried_changed() { carried_stale_ = true; }

 private:
  void refresh_contacts();
  void apply_gravity(const Vec3& gravity);
  void apply_springs();
  void integrate(double dt);
  void break_overstretched(double time, StepReport& report);
  void sample_load();
  void require_finite() const;

  Lattice& lattice_;
  PointContacts contacts_;
  Components pieces_;
  bool pieces_stale_ = true;
  bool contacts_stale_ = true;
  bool carried_stale_ = false;
  std::vector<std::int32_t> overstretched_;  // active springs of this substep
  std::size_t slack_ = 0;                    // active springs that broke since the last rebuild
};

// Substeps between two applications of internal damping. 32 substeps are a small part of its time
// (1/30 s is a thousand substeps of a ceramic) and make its cost a few per cent of the springs'.
inline constexpr int kDampingInterval = 32;

}  // namespace limber

#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/dynamics/spring_precision.h"
#include "core/model/surface_model.h"
#include "demos/scenes/scene.h"

namespace limber::demos {

enum class Policy { kSwitching, kFlexible, kRigid };

struct RunOptions {
  Policy policy = Policy::kSwitching;
  double seconds = 0.0;     // 0: as the scene says
  double tick = 0.0;        // s; 0: as the scene says
  double step_scale = 1.0;  // (0, 1]: factor on the automatically chosen substep
  std::optional<SpringPrecision> springs = {};  // none: as precise as the world
  // Ways to integrate lattices, as bullet::Integration.
  enum class Integration { kExplicit, kImplicit, kAutomatic };
  Integration integration = Integration::kExplicit;
};

// How one hand-over, or all of them together, changed what must not change.
// Relative to sum m|v| and sum m|r||v| about the centre of mass.
struct LedgerTotals {
  double momentum_rel = 0.0;            // worst of any hand-over
  double angular_momentum_rel = 0.0;    // worst of any hand-over
  double energy_in_J = 0.0;             // kinetic energy that rigid bodies gave to lattices
  double energy_out_J = 0.0;            // kinetic energy that lattices gave to rigid bodies
  double energy_stored_J = 0.0;         // elastic energy kept while rigid, at the end
  double energy_discarded_J = 0.0;      // vibration, all hand-overs together
  double energy_unaccounted_rel = 0.0;  // worst of any hand-over
};

// One change of representation: {"load", {{"approach_m_s", 3.4}, ...}}.
struct SwitchEvent {
  double time_s = 0.0;
  std::string body;
  bool to_flexible = false;
  std::string cause;
  std::vector<std::pair<std::string, double>> numbers;  // what decided
};

// One object at the end of a tick.
struct ObjectSample {
  Vec3 centre_of_mass;  // m
  Mat3 rotation;        // best rigid fit against the authored shape
};

struct TickSample {
  double time_s = 0.0;
  std::vector<ObjectSample> objects;
};

// One object at the end of the run.
struct BodySummary {
  std::string name;
  // "rigid", "flexible", "mixed" (several pieces), or "removed": all else is as it started then.
  std::string representation;
  double mass_kg = 0.0;
  Vec3 centre_of_mass;
  Vec3 velocity;
  std::size_t broken_edges = 0;
  std::size_t fragments = 0;  // connected pieces with at least one edge
  double softening = 1.0;     // S of its material
};

struct RunResult {
  std::string scene;
  double seconds = 0.0, tick = 0.0, wall_s = 0.0;
  std::size_t bodies = 0, points = 0, springs = 0;
  double softening = 1.0;      // largest S of any object; each has its own in `summaries`
  double object_size_m = 0.0;  // largest extent of the largest object, to scale errors
  std::uint64_t spring_updates = 0;
  std::size_t broken_edges = 0;
  std::size_t fragments = 0;
  std::optional<double> first_break_s;
  double flexible_share = 0.0;  // body-seconds flexible / body-seconds, pieces weighed by mass
  std::size_t to_flexible = 0, to_rigid = 0;
  std::optional<std::size_t> missed;    // first touches that detection did not foresee
  std::optional<std::size_t> needless;  // switches to flexible without a touch
  std::vector<double> piece_masses;     // kg, descending, pieces with at least one edge
  double debris_mass = 0.0;             // kg, points without edges
  double total_mass = 0.0;              // kg
  double fastest_piece_m_s = 0.0;       // of any piece over 0.5 % of its object's mass, ever
  double fastest_chip_m_s = 0.0;        // of any smaller one with at least one edge
  double impact_speed_m_s = 0.0;        // of its highest point, had that fallen freely to the floor
  // Speed of a piece (over 0.5 % of the mass) over what falling from its own start to where it is
  // explains, the worst: above 1 it got energy from other pieces, or out of nowhere.
  double fastest_piece_rel = 0.0;
  // Kinetic and gravitational energy of all pieces, relative to the floor, over that at the start,
  // the largest: above 1 something was pumped.
  double highest_energy_rel = 0.0;
  double highest_rise_m = 0.0;  // how far any piece's centre rose above its object's start; <= 0
  std::uint64_t state_hash = 0;
  SpringPrecision spring_precision = SpringPrecision::kDouble;  // the hash depends on it
  LedgerTotals ledger;
  std::vector<SwitchEvent> switches;
  std::vector<BodySummary> summaries;
  std::vector<TickSample> samples;
  std::vector<std::string> notes;  // the scene's, as text
  // Why the scene's behaviour ended the run before its time; all else is of what ran until then.
  std::optional<Diagnostic> failure;
};

// What a picture needs at one instant.
struct Snapshot {
  // A length of rope, or a grain where both ends are the same: strands() as they are.
  struct RopeLength {
    Vec3 a, b;            // m
    double radius = 0.0;  // m
    SurfaceProperties surface;
    bool flexible = false;
  };
  struct Body {
    std::string name;
    SurfaceModel surface;
    std::vector<bool> flexible;  // one per triangle: is it part of a lattice just now
    std::vector<RopeLength> strands = {};
  };
  struct Rigid {
    RigidBody body;
    Vec3 centre;
    Mat3 rotation;
  };
  double time_s = 0.0;
  bool floor = true;
  Camera camera;
  std::vector<Body> bodies;
  std::vector<Rigid> rigid;
  std::vector<Light> lights = {};
};

// What a behaviour throws when it fails: the run ends with what it has.
class BehaviourError : public SimulationError {
 public:
  using SimulationError::SimulationError;
};

// A scene that is running: Bullet's world and Limber in it.
class Simulation {
 public:
  // Throws BehaviourError when the scene's behaviour fails to start.
  Simulation(const Scene& scene, const RunOptions& options);
  ~Simulation();
  Simulation(Simulation&&) noexcept;

  // One tick. Throws SimulationError when a body blows up, naming it, and BehaviourError.
  void advance_tick();
  double time_s() const;
  Snapshot snapshot() const;
  RunResult result() const;  // up to now

  // More things, between ticks; both return the index in scene().
  std::size_t spawn(PhysicalModel model, std::optional<bullet::Integration> integration = {});
  std::size_t add_body(const RigidBody& body);
  // Out of the world, between ticks; it is left out of reports and pictures from then on.
  void remove(std::size_t object);
  void set_camera(const Camera& camera);

  const Scene& scene() const;  // with what was added
  bullet::Stage& stage();
  const bullet::Stage& stage() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Runs a scene to its end, or until its behaviour fails. `progress`, where given, is called after
// every tick with 0..1; where `go_on` is given and says no, the run ends with what it has.
RunResult run(const Scene& scene, const RunOptions& options,
              const std::function<void(double)>& progress = {},
              const std::function<bool()>& go_on = {});

// Spring updates per second of the scene's largest object alone in free space, springs, damping,
// break check and integration only: the micro-benchmark that `baseline_efficiency` divides by.
double spring_rate(const Scene& scene, SpringPrecision precision, double wall_seconds);

}  // namespace limber::demos

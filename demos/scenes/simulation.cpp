#include "demos/scenes/simulation.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/model/validate.h"
#include "core/operators/boundary_operator.h"
#include "core/operators/strands.h"
#include "core/operators/time_operator.h"
#include "demos/scenes/framing.h"

namespace limber::demos {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Pieces below this share of the mass are chips: a shard that turns about an edge flicks them off
// faster than it fell.
constexpr double kNotableShare = 0.005;

bullet::Integration integration_of(RunOptions::Integration integration) {
  switch (integration) {
    case RunOptions::Integration::kImplicit:
      return bullet::Integration::kImplicit;
    case RunOptions::Integration::kAutomatic:
      return bullet::Integration::kAutomatic;
    case RunOptions::Integration::kExplicit:
      break;
  }
  return bullet::Integration::kExplicit;
}

bullet::CoSimulationSettings settings_of(const RunOptions& options, const Scene& scene) {
  bullet::CoSimulationSettings settings;
  if (scene.switching) settings.switching = *scene.switching;
  settings.step_scale = options.step_scale;
  if (options.springs) settings.springs = *options.springs;
  settings.integration = integration_of(options.integration);
  switch (options.policy) {
    case Policy::kSwitching:
      settings.representation = bullet::Representation::kSwitching;
      break;
    case Policy::kFlexible:
      settings.representation = bullet::Representation::kAlwaysFlexible;
      break;
    case Policy::kRigid:
      settings.representation = bullet::Representation::kAlwaysRigid;
      break;
  }
  return settings;
}

double largest_extent(const PhysicalModel& model) {
  Vec3 low = model.geometry.points[PointId(0)], high = low;
  for (const Vec3& p : model.geometry.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).maxCoeff();
}

SwitchEvent event_of(const bullet::SwitchRecord& record, const Scene& scene) {
  SwitchEvent event;
  event.time_s = record.time;
  event.body = scene.objects[record.object].name;
  event.to_flexible = record.books.to_flexible;
  event.cause = record.cause;
  event.numbers = record.numbers;
  event.numbers.emplace_back("piece", static_cast<double>(record.piece));
  return event;
}

bool has_strands(const PhysicalModel& model) {
  return std::any_of(model.parts.begin(), model.parts.end(),
                     [](const auto& part) { return part.surface.strand_radius > 0.0; });
}

// What is seen of the objects: the corners of their triangles and the ends of their strands.
std::vector<Vec3> seen_points(const Snapshot& snapshot) {
  std::vector<Vec3> points;
  for (const Snapshot::Body& body : snapshot.bodies) {
    for (const SurfaceTriangle& triangle : body.surface.triangles)
      for (std::int32_t corner : triangle.corners) points.push_back(body.surface.points[corner]);
    for (const Snapshot::RopeLength& s : body.strands) points.insert(points.end(), {s.a, s.b});
  }
  return points;
}

LedgerTotals totals_of(const bullet::CoSimulation& limber) {
  LedgerTotals totals;
  for (const bullet::SwitchRecord& record : limber.switches()) {
    const bullet::HandOver& books = record.books;
    totals.momentum_rel = std::max(totals.momentum_rel, books.momentum_defect_rel);
    totals.angular_momentum_rel =
        std::max(totals.angular_momentum_rel, books.angular_momentum_defect_rel);
    (books.to_flexible ? totals.energy_in_J : totals.energy_out_J) += books.kinetic_after_J;
    totals.energy_discarded_J += books.discarded_J;
    totals.energy_unaccounted_rel = std::max(totals.energy_unaccounted_rel, books.unaccounted_rel);
  }
  totals.energy_stored_J = limber.counters().stored_J;
  return totals;
}

}  // namespace

struct Simulation::State {
  Scene scene;
  RunOptions options;
  bullet::Stage stage;
  std::unique_ptr<Behaviour> behaviour;
  double time = 0.0;
  double wall = 0.0;
  std::vector<TickSample> samples;
  double fastest_piece = 0.0;  // m/s
  double fastest_chip = 0.0;   // m/s
  double fastest_piece_rel = 0.0;
  double highest_rise = -1e30;
  double start_energy = 0.0;                    // J
  double highest_energy = 0.0;                  // J
  std::vector<Vec3> start_centre;               // of each object
  std::vector<std::vector<PointMotion>> start;  // of each object's points
  std::vector<std::vector<double>> masses;      // likewise, kg

  State(const Scene& s, const RunOptions& o)
      : scene(s), options(o), stage(s.gravity, settings_of(o, s)) {
    if (options.seconds <= 0.0) options.seconds = scene.seconds;
    if (options.tick <= 0.0) options.tick = scene.tick;
    if (scene.floor) stage.add_floor(scene.floor_friction);
    for (const RigidBody& body : scene.bodies) stage.add_body(body);
    for (const bullet::StageJoint& joint : scene.joints) stage.add_joint(joint);
    stage.co_simulation().set_air(scene.air);
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
      remember_start(scene.objects[i]);
      stage.co_simulation().add(scene.objects[i], integration_of_object(i));
    }
    take_sample();
  }

  std::optional<bullet::Integration> integration_of_object(std::size_t object) const {
    const auto own = scene.integration.find(object);
    if (own == scene.integration.end()) return {};
    return own->second;
  }

  void remember_start(const PhysicalModel& model) {
    std::vector<PointMotion> motion;
    std::vector<double> mass;
    for (PointId p : ids_of(model.points)) {
      motion.push_back({model.geometry.points[p], model.points[p].velocity});
      mass.push_back(model.points[p].mass);
    }
    start.push_back(std::move(motion));
    masses.push_back(std::move(mass));
    start_centre.push_back(centre_of_all(start.size() - 1));
  }

  Vec3 centre_of_all(std::size_t object) const {
    Vec3 sum = Vec3::Zero();
    double mass = 0.0;
    for (std::size_t i = 0; i < masses[object].size(); ++i) {
      mass += masses[object][i];
      sum += masses[object][i] * start[object][i].position;
    }
    return sum / mass;
  }

  double mass_of(std::size_t object) const {
    double mass = 0.0;
    for (double m : masses[object]) mass += m;
    return mass;
  }

  bool has_object(std::size_t object) const { return stage.co_simulation().has_object(object); }

  // Where a removed object was in the last sample; one that came and went since was in none.
  ObjectSample last_of(std::size_t object) const {
    const std::vector<ObjectSample>& last = samples.back().objects;
    return object < last.size() ? last[object]
                                : ObjectSample{start_centre[object], Mat3::Identity()};
  }

  void take_sample() {
    TickSample sample;
    sample.time_s = time;
    for (std::size_t o = 0; o < scene.objects.size(); ++o) {
      if (!has_object(o)) {
        sample.objects.push_back(last_of(o));
        continue;
      }
      const auto [rotation, centre] = stage.co_simulation().placement(o);
      sample.objects.push_back({centre, rotation});
    }
    samples.push_back(std::move(sample));
    double energy = 0.0;
    for (const bullet::PieceView& piece : stage.co_simulation().pieces()) {
      watch(piece);
      energy += energy_of(piece.motion);
    }
    if (samples.size() == 1) start_energy = energy;
    highest_energy = std::max(highest_energy, energy);
  }

  // J, without vibration and what springs store: both only ever lower the rest.
  double energy_of(const RigidMotion& piece) const {
    return piece.kinetic_energy() - piece.mass * scene.gravity.dot(piece.centre);
  }

  // Falling from where it was explains v^2 / 2 + g h; what exceeds it came out of nowhere.
  void watch(const bullet::PieceView& piece) {
    const RigidMotion& now = piece.motion;
    highest_rise = std::max(highest_rise, now.centre.y() - start_centre[piece.object].y());
    const bool notable = now.mass >= kNotableShare * mass_of(piece.object);
    double& fastest = notable ? fastest_piece : fastest_chip;
    fastest = std::max(fastest, now.velocity.norm());
    if (!notable) return;
    const RigidMotion then = rigid_motion(start[piece.object], masses[piece.object], piece.points);
    const double fall = scene.gravity.dot(now.centre - then.centre);
    const double explained = then.velocity.squaredNorm() + 2.0 * std::max(0.0, fall);
    if (explained <= 0.0) return;
    fastest_piece_rel =
        std::max(fastest_piece_rel, std::sqrt(now.velocity.squaredNorm() / explained));
  }

  // Of free fall to y = 0, m/s, of the point that starts with the most energy: pieces come from
  // every part of an object.
  double impact_speed() const {
    double squared = 0.0;
    for (const std::vector<PointMotion>& points : start) {
      for (const PointMotion& p : points) {
        const double fall = std::max(0.0, -2.0 * scene.gravity.y() * p.position.y());
        squared = std::max(squared, p.velocity.squaredNorm() + fall);
      }
    }
    return std::sqrt(squared);
  }

  void add_pieces(RunResult& result) const {
    const bullet::CoSimulation& limber = stage.co_simulation();
    for (const bullet::PieceView& piece : limber.pieces()) {
      result.piece_masses.push_back(piece.motion.mass);
    }
    std::sort(result.piece_masses.rbegin(), result.piece_masses.rend());
    result.fragments = result.piece_masses.size();
    for (std::size_t o = 0; o < scene.objects.size(); ++o) {
      if (!has_object(o)) continue;
      result.debris_mass += std::max(0.0, limber.debris_mass(o));
      result.total_mass += mass_of(o);
    }
  }

  BodySummary summary(std::size_t object) const {
    const bullet::CoSimulation& limber = stage.co_simulation();
    BodySummary body;
    body.name = scene.objects[object].name;
    body.mass_kg = mass_of(object);
    body.softening = scene.objects[object].object.softening;
    if (!has_object(object)) {
      body.centre_of_mass = start_centre[object];
      body.velocity = Vec3::Zero();
      body.representation = "removed";
      return body;
    }
    const PhysicalModel model = limber.model(object);
    Vec3 momentum = Vec3::Zero();
    body.centre_of_mass = Vec3::Zero();
    for (PointId p : ids_of(model.points)) {
      momentum += model.points[p].mass * model.points[p].velocity;
      body.centre_of_mass += model.points[p].mass * model.geometry.points[p];
    }
    body.centre_of_mass /= body.mass_kg;
    body.velocity = momentum / body.mass_kg;
    for (const EdgeAttributes& e : model.edges) body.broken_edges += e.broken ? 1 : 0;
    std::size_t flexible = 0;
    for (const bullet::PieceView& piece : limber.pieces()) {
      if (piece.object != object) continue;
      ++body.fragments;
      flexible += piece.flexible ? 1 : 0;
    }
    body.representation = flexible == 0                ? "rigid"
                          : flexible == body.fragments ? "flexible"
                                                       : "mixed";
    return body;
  }
};

Simulation::Simulation(const Scene& scene, const RunOptions& options)
    : state_(std::make_unique<State>(scene, options)) {
  if (!scene.behaviour) return;
  state_->behaviour = scene.behaviour();
  state_->behaviour->start(*this);
}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;

void Simulation::advance_tick() {
  const Clock::time_point start = Clock::now();
  if (state_->behaviour) state_->behaviour->before_tick(*this, state_->options.tick);
  state_->stage.step(state_->options.tick);
  state_->wall += seconds_since(start);
  state_->time += state_->options.tick;
  state_->take_sample();
  if (state_->behaviour) state_->behaviour->after_tick(*this);
}

std::size_t Simulation::spawn(PhysicalModel model, std::optional<bullet::Integration> integration) {
  require_valid(model);
  state_->stage.co_simulation().add(model, integration);
  state_->remember_start(model);
  state_->scene.objects.push_back(std::move(model));
  return state_->scene.objects.size() - 1;
}

std::size_t Simulation::add_body(const RigidBody& body) {
  state_->scene.bodies.push_back(body);
  return state_->stage.add_body(body);
}

void Simulation::remove(std::size_t object) { state_->stage.co_simulation().remove(object); }

void Simulation::set_camera(const Camera& camera) { state_->scene.camera = camera; }

const Scene& Simulation::scene() const { return state_->scene; }
bullet::Stage& Simulation::stage() { return state_->stage; }
const bullet::Stage& Simulation::stage() const { return state_->stage; }

double Simulation::time_s() const { return state_->time; }

Snapshot Simulation::snapshot() const {
  Snapshot snapshot;
  snapshot.time_s = state_->time;
  snapshot.floor = state_->scene.floor;
  snapshot.camera = state_->scene.camera;
  const bullet::CoSimulation& limber = state_->stage.co_simulation();
  for (std::size_t o = 0; o < limber.object_count(); ++o) {
    if (!state_->has_object(o)) continue;
    Snapshot::Body body;
    body.name = state_->scene.objects[o].name;
    body.surface = limber.surface(o);
    const std::vector<bool> flexible = limber.flexible_points(o);
    for (const SurfaceTriangle& triangle : body.surface.triangles) {
      const auto corner = static_cast<std::size_t>(triangle.corners[0]);
      body.flexible.push_back(flexible[body.surface.source_point[corner].index()]);
    }
    if (has_strands(state_->scene.objects[o])) {
      const PhysicalModel model = limber.model(o);
      for (const Strand& strand : strands(model)) {
        body.strands.push_back({model.geometry.points[strand.a], model.geometry.points[strand.b],
                                strand.radius, model.parts[strand.subobject].surface,
                                flexible[strand.a.index()]});
      }
    }
    snapshot.bodies.push_back(std::move(body));
  }
  snapshot.lights = state_->scene.lights;
  for (std::size_t b = 0; b < state_->scene.bodies.size(); ++b) {
    if (!state_->stage.has_body(b)) continue;
    const bullet::StageMotion motion = state_->stage.motion(b);
    snapshot.rigid.push_back({state_->scene.bodies[b], motion.centre, motion.rotation});
  }
  if (const double zoom = snapshot.camera.zoom; zoom > 0.0) {
    const Box3 box = box_of_most(seen_points(snapshot));
    if (!box.isEmpty()) snapshot.camera = framed(snapshot.camera, box, zoom);
  }
  return snapshot;
}

RunResult Simulation::result() const {
  const bullet::CoSimulation& limber = state_->stage.co_simulation();
  const bullet::Counters& counters = limber.counters();
  RunResult result;
  result.scene = state_->scene.name;
  result.seconds = state_->time;
  result.tick = state_->options.tick;
  result.wall_s = state_->wall;
  result.bodies = state_->scene.objects.size();
  for (const PhysicalModel& model : state_->scene.objects) {
    result.points += model.points.size();
    result.springs += model.edges.size();
    result.softening = std::max(result.softening, model.object.softening);
    result.object_size_m = std::max(result.object_size_m, largest_extent(model));
  }
  result.spring_updates = counters.spring_updates;
  result.broken_edges = counters.broken_edges;
  if (!limber.breaks().empty()) result.first_break_s = limber.breaks().front().time;
  if (counters.mass_seconds > 0.0) {
    result.flexible_share = counters.flexible_mass_seconds / counters.mass_seconds;
  }
  result.to_flexible = counters.to_flexible;
  result.to_rigid = counters.to_rigid;
  if (state_->options.policy == Policy::kSwitching) {
    result.missed = counters.missed;
    result.needless = counters.needless;
  }
  state_->add_pieces(result);
  result.fastest_piece_m_s = state_->fastest_piece;
  result.fastest_chip_m_s = state_->fastest_chip;
  result.impact_speed_m_s = state_->impact_speed();
  result.fastest_piece_rel = state_->fastest_piece_rel;
  result.highest_rise_m = state_->highest_rise;
  result.highest_energy_rel =
      state_->start_energy > 0.0 ? state_->highest_energy / state_->start_energy : 0.0;
  result.state_hash = limber.state_hash();
  result.spring_precision = settings_of(state_->options, state_->scene).springs;
  result.ledger = totals_of(limber);
  for (const bullet::SwitchRecord& record : limber.switches()) {
    result.switches.push_back(event_of(record, state_->scene));
  }
  for (std::size_t o = 0; o < state_->scene.objects.size(); ++o) {
    result.summaries.push_back(state_->summary(o));
  }
  result.samples = state_->samples;
  for (const Diagnostic& note : state_->scene.notes) result.notes.push_back(note.text());
  for (const Diagnostic& note : limber.notes()) result.notes.push_back(note.text());
  return result;
}

RunResult run(const Scene& scene, const RunOptions& options,
              const std::function<void(double)>& progress, const std::function<bool()>& go_on) {
  Simulation simulation(scene, options);
  std::optional<Diagnostic> failure;
  const double seconds = options.seconds > 0.0 ? options.seconds : scene.seconds;
  const double tick = options.tick > 0.0 ? options.tick : scene.tick;
  const auto ticks = static_cast<std::int64_t>(std::ceil(seconds / tick - 1e-9));
  for (std::int64_t n = 0; n < ticks && !failure && (!go_on || go_on()); ++n) {
    try {
      simulation.advance_tick();
    } catch (const BehaviourError& error) {
      failure = error.diagnostic;
    }
    if (progress) progress(static_cast<double>(n + 1) / static_cast<double>(ticks));
  }
  RunResult result = simulation.result();
  result.failure = std::move(failure);
  return result;
}

double spring_rate(const Scene& scene, SpringPrecision precision, double wall_seconds) {
  const auto largest = std::max_element(
      scene.objects.begin(), scene.objects.end(),
      [](const auto& a, const auto& b) { return a.edges.size() < b.edges.size(); });
  Lattice lattice;
  add_object(lattice, *largest);
  rebuild_active(lattice);
  TimeOperator time_operator(lattice, Integrator::kSymplecticEuler, precision);
  const double dt = time_operator.largest_step();
  std::uint64_t updates = 0;
  const Clock::time_point start = Clock::now();
  do {
    updates += time_operator.advance_springs_only(100, dt);
  } while (seconds_since(start) < wall_seconds);
  return static_cast<double>(updates) / seconds_since(start);
}

}  // namespace limber::demos

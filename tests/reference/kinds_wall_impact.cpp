// Group 7: a chain that flies end-on into a wall.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/analysis/vibration.h"
#include "tests/reference/build.h"
#include "tests/reference/cubic.h"
#include "tests/reference/edge_recorder.h"
#include "tests/reference/kinds.h"

namespace limber::reference {
namespace {

constexpr double kStepShare = 0.025;       // of the largest stable step
constexpr double kBreakStepShare = 0.004;  // where the time of the first break is read off
constexpr double kFirstStepShare = 1e-6;   // lets a hard wall stop what touches it from the start

struct ChainShape {
  int points;
  double mass, stiffness, spacing, speed;
};

ChainShape chain_shape(const Json& p, double speed) {
  return {p.at("n"), p.at("m"), p.at("k"), p.at("a"), speed};
}

PhysicalModel flying_chain(const ChainShape& shape) {
  std::vector<MassPoint> points;
  for (int i = 0; i < shape.points; ++i) {
    points.push_back({Vec3(i * shape.spacing, 0.0, 0.0), shape.mass, Vec3(-shape.speed, 0.0, 0.0)});
  }
  return network(points, chain_bonds(points.size(), shape.stiffness, shape.spacing));
}

bool is_hard(const Json& p) { return p.at("wall") == "hard"; }

Environment wall(const Json& p) {
  Ground ground{.normal = Vec3::UnitX()};
  if (!is_hard(p)) ground.stiffness = p.at("k_wall");
  return {.ground = ground};
}

// Of one point on a spring whose other end is held, rad/s.
double point_frequency(const ChainShape& shape) {
  return exact_highest_frequency(network(
      {{Vec3::Zero(), shape.mass, Vec3::Zero(), true}, {Vec3(shape.spacing, 0.0, 0.0), shape.mass}},
      {{0, 1, shape.stiffness, shape.spacing}}));
}

// Of long waves along an endless bundle of such chains, m/s.
double wave_speed_of(const ChainShape& shape) {
  CubicLattice bundle;
  bundle.spacing = shape.spacing;
  bundle.mass = shape.mass;
  bundle.springs.axial = shape.stiffness;
  const Bulk bulk = bulk_of(bundle);
  return wave_speed(bulk.stiffness(0, 0), bulk.density);
}

// Follows one impact; steps end where the contact begins and ends.
class WallImpact {
 public:
  WallImpact(const Json& p, const ChainShape& shape)
      : hard_(is_hard(p)), run_(flying_chain(shape), wall(p)), edges_(run_) {
    start_energy_ = energy(run_.lattice());
    read_depth();
    advance_by(kFirstStepShare * run_.stable_step());
  }

  void advance_to(double time) {
    while (time - run_.time() > 1e-12 * time) {
      advance_by(std::min(kStepShare * run_.stable_step(), time - run_.time()));
    }
  }

  const Run& run() const { return run_; }
  const EdgeRecorder& edges() const { return edges_; }
  double deepest() const { return depth_.highest().value; }  // m
  double impulse() const { return impulse_; }                // N s, along x
  double start_energy() const { return start_energy_; }      // J, before the wall took any

  std::vector<std::array<double, 2>> contacts() const {
    auto all = contacts_;
    if (touching_) all.push_back({since_, run_.time()});
    return all;
  }

 private:
  // A hard wall lets go when the net force points away, which is when the first spring pulls; a
  // soft one when the point has left it.
  bool leaves() const {
    return hard_ ? stretch(run_.lattice(), 0) > 0.0 : first_point().position.x() > 0.0;
  }
  const PointMotion& first_point() const { return run_.lattice().motion[0]; }
  void read_depth() {
    depth_.read({run_.time(), -first_point().position.x(), -first_point().velocity.x()});
  }

  void advance_by(double dt) {
    const auto changes = [&] { return touching_ ? leaves() : first_point().position.x() <= 0.0; };
    const double before = momentum();
    const bool changed = run_.step_until(changes, dt);
    impulse_ += momentum() - before;
    edges_.read(run_);
    read_depth();
    if (!changed) return;
    if (touching_) contacts_.push_back({since_, run_.time()});
    since_ = run_.time();
    touching_ = !touching_;
  }
  double momentum() const { return rigid_motion(run_.lattice()).momentum().x(); }

  bool hard_;
  Run run_;
  EdgeRecorder edges_;
  PeakRecorder depth_;
  bool touching_ = true;
  double since_ = 0.0;
  double impulse_ = 0.0;
  double start_energy_ = 0.0;
  std::vector<std::array<double, 2>> contacts_;
};

void add_contacts(const WallImpact& impact, Json& found) {
  const auto contacts = impact.contacts();
  found["contact_intervals"] = contacts;
  found["n_contact_intervals"] = contacts.size();
  found["first_release"] = contacts.front()[1];
  found["last_release"] = contacts.back()[1];
}

void add_rebound(const WallImpact& impact, double speed, Json& found) {
  const double start_energy = impact.start_energy();
  const RigidMotion body = rigid_motion(impact.run().lattice());
  const double of_centre = 0.5 * body.mass * body.velocity.squaredNorm();
  const double now = energy(impact.run().lattice());
  found["rebound_com_speed"] = body.velocity.x();
  found["restitution_com"] = body.velocity.x() / speed;
  found["com_kinetic_fraction"] = of_centre / start_energy;
  found["internal_energy_fraction"] = (now - of_centre) / start_energy;
  found["energy_lost_fraction"] = (start_energy - now) / start_energy;
  found["impulse"] = impact.impulse();
}

void add_elongations(const EdgeRecorder& edges, Json& found) {
  double longest = 0.0, shortest = 0.0;
  for (std::size_t e = 0; e < edges.peaks().size(); ++e) {
    longest = std::max(longest, edges.peaks()[e].highest().value);
    shortest = std::min(shortest, edges.peaks()[e].lowest().value);
    found["max_abs_elongation_per_edge"].push_back(edges.distance(e));
  }
  found["max_tension_elongation"] = longest;
  found["max_compression"] = -shortest;
  found["max_elongation_edge_from_wall"] = edges.farthest();
}

void add_profile(const Lattice& lattice, Json& found) {
  Json displacements = Json::array(), velocities = Json::array();
  for (std::int32_t p : all_points(lattice)) {
    displacements.push_back(lattice.motion[p].position.x() - lattice.authored_position[p].x());
    velocities.push_back(lattice.motion[p].velocity.x());
  }
  found["displacement_profiles"].push_back(displacements);
  found["velocity_profiles"].push_back(velocities);
}

// The first break of the chain at this speed, if there is one before the window ends.
std::optional<BreakEvent> first_break(const Json& p, double speed, double step_share) {
  PhysicalModel model = flying_chain(chain_shape(p, speed));
  break_either_way(model, p.at("break_threshold"));
  Run run(std::move(model), wall(p));
  const double window = p.at("window"), dt = step_share * run.stable_step();
  StepReport report = run.step(kFirstStepShare * run.stable_step());
  while (report.breaks.empty() && run.time() < window) report = run.step(dt);
  if (report.breaks.empty()) return std::nullopt;
  return report.breaks.front();
}

// Elongations are proportional to the speed as long as nothing breaks. Runs just below and just
// above the critical speed have to agree.
double critical_speed(const Json& p, double largest_elongation) {
  constexpr double kMargin = 1e-3;
  const double speed =
      p.at("v").get<double>() * p.at("break_threshold").get<double>() / largest_elongation;
  if (first_break(p, (1.0 - kMargin) * speed, kStepShare)) {
    throw std::runtime_error("something breaks below the critical speed");
  }
  if (!first_break(p, (1.0 + kMargin) * speed, kStepShare)) {
    throw std::runtime_error("nothing breaks above the critical speed");
  }
  return speed;
}

void add_breaking(const Json& p, double largest_elongation, Json& found) {
  const double critical = critical_speed(p, largest_elongation);
  found["critical_speed"] = critical;
  const std::optional<BreakEvent> first = first_break(p, 1.05 * critical, kBreakStepShare);
  if (!first) throw std::runtime_error("nothing breaks at 1.05 of the critical speed");
  found["at_1_05_vcrit_first_break"] = {
      {"time", first->time}, {"edge_from_wall", first->edge}, {"speed", 1.05 * critical}};
}

Json chain_impact(const Case& c) {
  const ChainShape shape = chain_shape(c.params, c.params.at("v"));
  WallImpact impact(c.params, shape);
  Json found;
  for (double t : c.inputs.at("profile_times")) {
    impact.advance_to(t);
    add_profile(impact.run().lattice(), found);
  }
  impact.advance_to(c.params.at("window"));
  add_contacts(impact, found);
  add_rebound(impact, shape.speed, found);
  add_elongations(impact.edges(), found);
  const double largest = impact.edges().distance(impact.edges().farthest());
  found["omega0"] = point_frequency(shape);
  found["wave_speed"] = wave_speed_of(shape);
  found["overshoot_factor"] = largest * point_frequency(shape) / shape.speed;
  if (!is_hard(c.params)) found["max_penetration"] = impact.deepest();
  add_breaking(c.params, largest, found);
  return found;
}

// The chain is twice as long as the way to the last spring asked for: nothing comes back in time.
Json bessel_front(const Case& c) {
  const std::vector<std::size_t> springs = c.params.at("springs");
  const int farthest = static_cast<int>(*std::max_element(springs.begin(), springs.end()));
  const ChainShape shape{2 * farthest + 40, 1.0, 1.0, 1.0, 0.1};
  const double omega0 = point_frequency(shape);
  Run run(flying_chain(shape), {.ground = Ground{.normal = Vec3::UnitX()}});
  run.step(kFirstStepShare * run.stable_step());
  const auto extrema = first_extrema(run, springs, 0.005 / omega0, 0.1 * shape.speed / omega0);
  Json found;
  found["columns"] = {"spring_from_wall", "max_elongation_times_omega0_over_v",
                      "time_times_omega0"};
  for (std::size_t i = 0; i < springs.size(); ++i) {
    found["rows"].push_back({static_cast<double>(springs[i]),
                             std::abs(extrema[i].value) * omega0 / shape.speed,
                             extrema[i].time * omega0});
  }
  return found;
}

}  // namespace

Kinds wall_impact_kinds() {
  return {{"chain_impact", chain_impact}, {"bessel_front", bessel_front}};
}

}  // namespace limber::reference

// Group 8: a chain that flies end-on into a free mass.

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/reference/build.h"
#include "tests/reference/collision.h"
#include "tests/reference/edge_recorder.h"
#include "tests/reference/kinds.h"

namespace limber::reference {
namespace {

constexpr double kStepShare = 0.04;  // of the largest stable step
constexpr double kSpacing = 1.0;     // m
constexpr double kSpeed = 0.01;      // m/s; everything is proportional to it

// Of points of 1 kg on springs of 1 N/m, so that omega0 is 1 rad/s and a wave passes one point a
// second.
struct ChainCase {
  int points;
  double mass;               // kg, of what is hit
  double contact_stiffness;  // N/m
};

// The contact is a spring that is there while the chain's last point and the mass overlap.
class ChainHit {
 public:
  explicit ChainHit(const ChainCase& c) : case_(c) {
    for (int i = 0; i < c.points; ++i) {
      points_.push_back({i * kSpacing * Vec3::UnitX(), 1.0, kSpeed * Vec3::UnitX()});
    }
    points_.push_back({c.points * kSpacing * Vec3::UnitX(), c.mass});
  }

  // To the end of the window, and on as long as the two touch.
  void advance_to(double window) {
    while (time_ < window || (touching_ && time_ < 10.0 * window)) fly(window);
  }

  int contacts() const { return contacts_; }
  double last_release() const { return last_release_; }  // s
  double longest() const { return longest_; }            // m, largest |L - L0| in the chain
  double mass_speed() const { return points_.back().velocity.x(); }
  double chain_speed() const { return chain().velocity.x(); }  // of its centre

  // Kinetic about its centre, and elastic, J.
  double internal_energy() const {
    const Lattice lattice = compiled(network(of_chain(), chain_bonds()));
    return energy_about_centre(lattice);
  }

 private:
  std::vector<MassPoint> of_chain() const { return {points_.begin(), points_.end() - 1}; }
  RigidMotion chain() const { return rigid_motion(compiled(network(of_chain(), chain_bonds()))); }
  std::vector<Bond> chain_bonds() const {
    return reference::chain_bonds(points_.size() - 1, 1.0, kSpacing);
  }

  std::vector<Bond> bonds() const {
    std::vector<Bond> all = chain_bonds();
    if (touching_) {
      all.push_back({case_.points - 1, case_.points, case_.contact_stiffness, kSpacing});
    }
    return all;
  }

  // Until the contact begins or ends, or the window does.
  void fly(double window) {
    Run run(network(points_, bonds()));
    EdgeRecorder edges(run);
    const double start = std::exchange(time_, 0.0);
    const double end = touching_ ? 10.0 * window : window;
    const auto changes = [&] { return touching_ ? lets_go(run) : gap(run) < 0.0; };
    bool changed = false;
    while (!changed && start + run.time() < end) {
      changed = run.step_until(changes, kStepShare * run.stable_step());
      edges.read(run);
    }
    time_ = start + run.time();
    remember(run, edges);
    if (changed) change();
  }

  double gap(const Run& run) const {
    const std::vector<PointMotion>& motion = run.lattice().motion;
    return motion.back().position.x() - motion[motion.size() - 2].position.x() - kSpacing;
  }
  bool lets_go(const Run& run) const {
    const std::vector<PointMotion>& motion = run.lattice().motion;
    return gap(run) >= 0.0 && motion.back().velocity.x() > motion[motion.size() - 2].velocity.x();
  }

  void remember(const Run& run, const EdgeRecorder& edges) {
    for (std::size_t p = 0; p < points_.size(); ++p) {
      points_[p].position = run.lattice().motion[p].position;
      points_[p].velocity = run.lattice().motion[p].velocity;
    }
    for (std::size_t e = 0; e < chain_bonds().size(); ++e) {
      longest_ = std::max(longest_, edges.distance(e));
    }
  }

  void change() {
    if (touching_) last_release_ = time_;
    touching_ = !touching_;
    if (touching_) ++contacts_;
  }

  ChainCase case_;
  std::vector<MassPoint> points_;  // the mass last
  double time_ = 0.0;
  bool touching_ = true;
  int contacts_ = 1;
  double last_release_ = 0.0;
  double longest_ = 0.0;
};

// A wave passes the chain in `points` seconds; six times that is three times there and back.
constexpr double kPasses = 6.0;

Json row_of(const ChainCase& c, double ratio, double& momentum_defect) {
  const double chain_mass = c.points, energy = 0.5 * chain_mass * kSpeed * kSpeed;
  const Colliders two{chain_mass, c.mass, kSpeed, 0.0};
  ChainHit hit(c);
  hit.advance_to(kPasses * c.points);
  const double mass_speed = hit.mass_speed(), chain_speed = hit.chain_speed();
  const double momentum = chain_mass * chain_speed + c.mass * mass_speed;
  momentum_defect = std::max(momentum_defect, std::abs(momentum / (chain_mass * kSpeed) - 1.0));
  return {ratio,
          mass_speed / kSpeed,
          chain_speed / kSpeed,
          (mass_speed - chain_speed) / kSpeed,
          plastic_collision(two).v2 / kSpeed,
          elastic_collision(two).v2 / kSpeed,
          hit.internal_energy() / energy,
          hit.contacts(),
          hit.last_release(),
          hit.longest() / kSpeed};
}

Json chain_vs_free_mass(const Case& c) {
  const int points = c.params.at("n");
  double momentum_defect = 0.0;
  Json rows = Json::array();
  for (double ratio : c.params.at("ratios")) {
    const ChainCase one{points, ratio * points, c.params.at("k_penalty_over_k")};
    rows.push_back(row_of(one, ratio, momentum_defect));
  }
  return {{"columns",
           {"mass_ratio_M_over_chain", "V_box_after/v", "V_chain_com_after/v", "restitution_e",
            "V_box_plastic_limit/v", "V_box_elastic_limit/v", "internal_energy_fraction",
            "n_contact_intervals", "last_release*omega0", "max_|elongation|*omega0/v"}},
          {"rows", rows},
          {"momentum_balance", momentum_defect}};
}

}  // namespace

Kinds chain_collision_kinds() { return {{"chain_vs_free_mass", chain_vs_free_mass}}; }

}  // namespace limber::reference

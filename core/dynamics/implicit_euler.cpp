#include "core/dynamics/implicit_euler.h"

#include <algorithm>
#include <cmath>

#include "core/dynamics/factorised_solver.h"
#include "core/dynamics/implicit_momenta.h"
#include "core/model/errors.h"

namespace limber {
namespace {

// band_multiplications() a spring or point up to which factorising is faster. A rope has 50, a beam
// of 3 x 3 x 100 points 1,000, a sheet of 32 x 32 points 14,000 (about even), a cube of 10 x 10 x
// 10 points 280,000.
constexpr double kMostMultiplications = 10000.0;

constexpr int kMostShortenings = 20;  // of an iteration that climbs: a millionth of it is left
constexpr double kRounding = 1e-12;   // share of an energy that sums of many terms may be off by

}  // namespace

ImplicitEuler::ImplicitEuler(const ImplicitSettings& settings) : settings_(settings) {}
ImplicitEuler::ImplicitEuler(const ImplicitEuler& other) : settings_(other.settings_) {}
ImplicitEuler& ImplicitEuler::operator=(const ImplicitEuler& other) {
  return *this = ImplicitEuler(other);
}
ImplicitEuler::ImplicitEuler(ImplicitEuler&&) noexcept = default;
ImplicitEuler& ImplicitEuler::operator=(ImplicitEuler&&) noexcept = default;
ImplicitEuler::~ImplicitEuler() = default;

ImplicitReport ImplicitEuler::step(Lattice& lattice, std::span<const std::int32_t> points,
                                   double dt, std::span<const PointSupport> supports) {
  if (stale_) rebuild(lattice, points);
  report_ = {};
  if (system_.points().empty()) return report_;
  supports_.assign(supports.begin(), supports.end());
  ImplicitForces forces(lattice, system_, supports);
  step_or_halve(lattice, forces, dt, settings_.most_halvings);
  return report_;
}

void ImplicitEuler::rebuild(const Lattice& lattice, std::span<const std::int32_t> points) {
  system_.rebuild(lattice, points);
  choose_solver();
  free_pieces_ = free_pieces(system_);
  stale_ = false;
}

void ImplicitEuler::choose_solver() {
  const auto links = static_cast<double>(system_.springs().size() + system_.points().size());
  const bool slender = band_multiplications(system_) <= kMostMultiplications * links;
  factorised_ = slender ? std::make_unique<FactorisedSolver>(system_) : nullptr;
}

void ImplicitEuler::step_or_halve(Lattice& lattice, ImplicitForces& forces, double dt,
                                  int halvings) {
  forces.start_step(lattice, dt);
  const bool good = try_step(lattice, forces);
  if (good || halvings == 0) {
    ++report_.parts;
    report_.converged = report_.converged && good;
    return;
  }
  for (std::size_t row = 0; row < forces.start().size(); ++row) {
    lattice.motion[system_.points()[row]] = forces.start()[row];
  }
  step_or_halve(lattice, forces, 0.5 * dt, halvings - 1);
  step_or_halve(lattice, forces, 0.5 * dt, halvings - 1);
}

// Found the end of the step, without a gain of energy.
bool ImplicitEuler::try_step(Lattice& lattice, const ImplicitForces& forces) {
  const StepEnergy before = forces.energy(lattice);
  const bool found = iterate(lattice, forces);
  restore_momenta(lattice, forces, before.sum());
  const StepEnergy after = forces.energy(lattice);
  const double rounding = before.rounding + kRounding * (before.scale() + after.scale());
  return found && after.sum() <= before.sum() + rounding;
}

bool ImplicitEuler::iterate(Lattice& lattice, const ImplicitForces& forces) {
  guess(lattice, forces);
  Eigen::VectorXd impulse = forces.remaining_impulse(lattice);
  for (int i = 0; i < settings_.most_newton_iterations; ++i) {
    system_.linearise(lattice, forces.dt(), forces.start_lengths(), supports_);
    const BlockPreconditioner inverse(system_.diagonal());
    descend(lattice, forces, solve(lattice, inverse, impulse));
    ++report_.newton_iterations;
    impulse = forces.remaining_impulse(lattice);
    const double error = 0.5 * impulse.dot(inverse.apply(impulse));
    if (settled(forces.energy(lattice), error)) return true;
  }
  return false;
}

// Free pieces go on as rigid bodies, what a pin holds stays where it is.
void ImplicitEuler::guess(Lattice& lattice, const ImplicitForces& forces) const {
  const std::vector<PointMotion>& start = forces.start();
  for (std::int32_t p : system_.points()) lattice.motion[p].velocity.setZero();
  for (const auto& piece : free_pieces_) {
    for (std::int32_t p : piece) lattice.motion[p] = start[system_.row(p)];
    move_rigidly(lattice, piece, forces.dt());
  }
}

Eigen::VectorXd ImplicitEuler::solve(const Lattice& lattice, const BlockPreconditioner& inverse,
                                     const Eigen::VectorXd& impulse) {
  const LinearSolution solution =
      factorised_ ? factorised_->solve(system_, impulse)
                  : conjugate_gradients(system_, inverse, impulse, settings_.solver_tolerance,
                                        settings_.most_solver_iterations);
  report_.solver_iterations += solution.iterations;
  if (solution.converged && solution.x.allFinite()) return solution.x;
  const LatticeObject& object = lattice.objects[lattice.point_object[system_.points().front()]];
  throw SimulationError({object.authored.name,
                         impulse.allFinite()
                             ? "its implicit step has no solution within " +
                                   std::to_string(settings_.most_solver_iterations) + " iterations"
                             : "its forces or motion are no longer finite",
                         "use a smaller step, or masses and springs that differ less"});
}

// A direction that rises at first is none: the matrix is definite. One that is too long is halved.
void ImplicitEuler::descend(Lattice& lattice, const ImplicitForces& forces,
                            Eigen::VectorXd change) const {
  const StepEnergy energy = forces.energy(lattice);
  const double before = forces.merit(lattice);
  const double level = before + energy.rounding + kRounding * (energy.scale() + std::abs(before));
  move(lattice, forces, change);
  for (int n = 0; n < kMostShortenings && !(forces.merit(lattice) <= level); ++n) {
    change *= 0.5;
    move(lattice, forces, -change);
  }
}

void ImplicitEuler::move(Lattice& lattice, const ImplicitForces& forces,
                         const Eigen::VectorXd& change) const {
  const std::vector<PointMotion>& start = forces.start();
  for (std::size_t row = 0; row < start.size(); ++row) {
    PointMotion& motion = lattice.motion[system_.points()[row]];
    motion.velocity += change.segment<3>(3 * row);
    motion.position = start[row].position + forces.dt() * motion.velocity;
  }
}

bool ImplicitEuler::settled(const StepEnergy& energy, double error) const {
  const double share = settings_.newton_tolerance;
  return error <= share * energy.kinetic + share * share * energy.elastic + energy.rounding;
}

std::vector<std::size_t> ImplicitEuler::unsupported_pieces() const {
  std::vector<char> supported(system_.points().size(), false);
  for (const PointSupport& s : supports_) {
    if (system_.row(s.point) >= 0) supported[system_.row(s.point)] = true;
  }
  std::vector<std::size_t> pieces;
  for (std::size_t i = 0; i < free_pieces_.size(); ++i) {
    const bool any = std::any_of(free_pieces_[i].begin(), free_pieces_[i].end(),
                                 [&](std::int32_t p) { return supported[system_.row(p)]; });
    if (!any) pieces.push_back(i);
  }
  return pieces;
}

// Supports take momentum; how much is known only as well as the system was solved, times their
// stiffness. Of the other pieces it is known to the last digit. The rotation may take what the step
// has lost of the energy that is allowed, J.
void ImplicitEuler::restore_momenta(Lattice& lattice, const ImplicitForces& forces,
                                    double allowed) const {
  const std::vector<std::size_t> pieces = unsupported_pieces();
  std::vector<Momenta> earned;
  for (std::size_t i : pieces) {
    earned.push_back(earned_momenta(lattice, system_, free_pieces_[i], forces));
    restore_momentum(lattice, free_pieces_[i], earned.back(), forces.dt());
  }
  if (!settings_.restore_spin) return;
  double budget = allowed - forces.energy(lattice).sum();
  for (std::size_t n = 0; n < pieces.size(); ++n) {
    budget -= restore_spin(lattice, free_pieces_[pieces[n]], earned[n], budget);
  }
}

}  // namespace limber

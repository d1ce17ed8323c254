// TimeOperator::largest_step(): stable on random lattices, whatever they are made of; near the true
// limit where they are regular.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/dynamics/may_fold.h"
#include "core/dynamics/stable_step.h"
#include "core/modeller/cubic_lattice.h"
#include "core/modeller/rope.h"
#include "core/modeller/voxel_lattice.h"
#include "core/operators/breaking_operator.h"
#include "core/operators/time_operator.h"
#include "tests/property/generators.h"
#include "tests/support/dense.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

using test::uniform;

double log_uniform(double low, double high) {
  return std::exp(uniform(std::log(low), std::log(high)));
}

// ---- random lattices, with all edges of one length or of many

PhysicalModel voxel_subset() {
  const VoxelGrid grid{.origin = Vec3::Zero(), .spacing = 0.2, .cells = {3, 2, 3}};
  std::vector<std::int32_t> kept = {*rc::gen::inRange(0, 18)};
  for (std::int32_t i = 0; i < 18; ++i) {
    if (i != kept[0] && test::coin()) kept.push_back(i);
  }
  std::sort(kept.begin(), kept.end());
  return test::with_plausible_attributes(voxel_lattice(grid, kept, {}, "voxels").geometry,
                                         "voxels");
}

PhysicalModel random_rope() {
  std::vector<Vec3> points = {Vec3::Zero()};
  const int segments = *rc::gen::inRange(1, 30);
  for (int i = 0; i < segments; ++i) {
    const Vec3 step(uniform(0.1, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0));
    points.push_back(points.back() + step);
  }
  return test::with_plausible_attributes(rope(points, "rope"), "rope");
}

// Points of a jittered grid, so that none coincide; a spring from each to one before it, and more.
PhysicalModel random_springs() {
  GeometricModelBuilder builder;
  builder.begin_subobject("springs");
  const int count = *rc::gen::inRange(2, 25);
  std::vector<PointId> points;
  for (int i = 0; i < count; ++i) {
    points.push_back(
        builder.add_point(0.3 * Vec3(i % 3, i / 3 % 3, i / 9) + test::random_vector(0.1)));
    if (i > 0) builder.edge(points[*rc::gen::inRange(0, i)], points[i]);
  }
  for (int n = 0; n < 3 * count; ++n) {
    const int a = *rc::gen::inRange(0, count), b = *rc::gen::inRange(0, count);
    if (a != b) builder.edge(points[a], points[b]);
  }
  return test::with_plausible_attributes(builder.finish(), "springs");
}

PhysicalModel random_lattice() {
  switch (*rc::gen::inRange(0, 5)) {
    case 0:
      return test::block(test::random_shape(3));
    case 1:
      return voxel_subset();
    case 2:
      return random_rope();
    case 3:
      return test::sheet(*rc::gen::inRange(1, 5), test::coin());
    default:
      return random_springs();
  }
}

// ---- random constants

void set_masses(PhysicalModel& model) {
  const double light = log_uniform(1e-3, 1e3), ratio = log_uniform(1.0, 1e6);
  const bool two_kinds = test::coin();
  for (PointAttributes& p : model.points) {
    p.mass = light * (two_kinds ? (test::coin() ? 1.0 : ratio) : log_uniform(1.0, ratio));
  }
}

void set_springs(PhysicalModel& model) {
  const double stiffness = log_uniform(1e-2, 1e12), spread = test::coin() ? 1.0 : 1e3;
  for (EdgeAttributes& e : model.edges) {
    e.stiffness = std::min(1e12, stiffness * log_uniform(1.0, spread));
    e.break_threshold = kUnbreakable;
    e.damping = 0.0;
  }
}

// None, c proportional to k, or a damping ratio of its own for every spring.
void set_damping(PhysicalModel& model) {
  const int kind = *rc::gen::inRange(0, 3);
  const double ratio = log_uniform(1e-3, 100.0);
  double per_stiffness = -1.0;
  for (EdgeId e : ids_of(model.edges)) {
    if (kind == 0) break;
    EdgeAttributes& edge = model.edges[e];
    const auto [a, b] = model.geometry.edges[e];
    const double mass = std::min(model.points[a].mass, model.points[b].mass);
    const double own = kind == 1 ? ratio : log_uniform(1e-3, ratio);
    edge.damping = 2.0 * own * std::sqrt(edge.stiffness * mass);
    if (per_stiffness < 0.0) per_stiffness = edge.damping / edge.stiffness;
    if (kind == 1) edge.damping = per_stiffness * edge.stiffness;
  }
  if (test::coin()) model.object.internal_damping = log_uniform(1e-2, 1e4);
}

PhysicalModel random_model() {
  PhysicalModel model = random_lattice();
  set_masses(model);
  set_springs(model);
  set_damping(model);
  return model;
}

// ---- free runs

// Points of equal energies, that strain the stiffest part by about `strain`.
void set_in_motion(Lattice& lattice, double strain) {
  double shortest = kUnbreakable, lightest = kUnbreakable, omega = 0.0;
  for (const Spring& s : lattice.springs) shortest = std::min(shortest, s.rest_length);
  for (double m : lattice.mass) lightest = std::min(lightest, m);
  for (const LatticeObject& o : lattice.objects) omega = std::max(omega, o.spring_frequency);
  std::mt19937 random(1);
  for (std::size_t p = 0; p < lattice.motion.size(); ++p) {
    const double speed = strain * shortest * omega * std::sqrt(lightest / lattice.mass[p]);
    lattice.motion[p].velocity = test::random_vector(random, speed);
  }
}

// The largest energy of a run over that of its start; infinite where it stopped or is no number.
double growth_of(Lattice lattice, SpringPrecision precision, double dt, int steps) {
  const double start = test::totals(lattice).energy();
  TimeOperator time(lattice, Integrator::kSymplecticEuler, precision);
  double most = 1.0;
  try {
    for (int n = 0; n < steps; n += 100) {
      time.advance(100, dt, kEmptySpace);
      const double now = test::totals(lattice).energy() / start;
      if (!std::isfinite(now)) return kUnbreakable;
      most = std::max(most, now);
    }
  } catch (const SimulationError&) {
    return kUnbreakable;
  }
  return most;
}

// From rest lengths, v.Mv + x.Kx - dt v.Kx = v.Mv stays, which bounds the energy by 1 / (1 - z/2),
// z = omega dt <= 2 x 0.92: 12.5, and a little for what is not linear.
constexpr double kMostGrowth = 13.0;
// From lengths that are strained already it is (1 + z/2) / (1 - z/2): 24.
constexpr double kMostGrowthOfStrained = 25.0;

// Single precision needs motion enough to stand out of its rounding, so that its run is shorter;
// one that is 1 % beyond the limit would grow by e^80 in it.
void assert_stable(Lattice lattice, double most_growth = kMostGrowth, double strain = 1e-4) {
  set_in_motion(lattice, 0.1 * strain);
  double dt = TimeOperator(lattice).largest_step();
  RC_ASSERT(growth_of(lattice, SpringPrecision::kDouble, dt, 3000) <= most_growth);
  set_in_motion(lattice, strain);
  dt = TimeOperator(lattice).largest_step();
  RC_ASSERT(growth_of(lattice, SpringPrecision::kSingle, dt, 600) <= most_growth);
}

RC_GTEST_PROP(AutomaticStep, IsStableOnAnyLattice, ()) {
  assert_stable(test::lattice_of({random_model()}));
}

// Strains by which what is floppy changes its shape. Equal energies strain soft springs more.
RC_GTEST_PROP(AutomaticStep, IsStableOnAnyLatticeThatMovesFar, ()) {
  PhysicalModel model = random_model();
  double softest = kUnbreakable, stiffest = 0.0;
  for (const EdgeAttributes& e : model.edges) {
    softest = std::min(softest, e.stiffness);
    stiffest = std::max(stiffest, e.stiffness);
  }
  RC_CLASSIFY(may_fold(model), "may fold");
  const double strain = log_uniform(1e-3, 0.1) * std::sqrt(softest / stiffest);
  assert_stable(test::lattice_of({model}), kMostGrowth, strain);
}

double exact_frequency(const PhysicalModel& model) {
  const Eigen::MatrixXd K = test::dense_matrix(model, &EdgeAttributes::stiffness);
  const Eigen::VectorXd scale = test::dense_masses(model).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * K * scale.asDiagonal();
  return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly)
                       .eigenvalues()
                       .maxCoeff());
}

// Of springs with their stiffness in all directions, by definition.
double exact_frequency_of_any_shape(const PhysicalModel& model) {
  const auto count = static_cast<Eigen::Index>(model.points.size());
  Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(count, count);
  for (EdgeId e : ids_of(model.edges)) {
    const auto [a, b] = model.geometry.edges[e];
    const double k = model.edges[e].stiffness;
    const double mass_a = model.points[a].mass, mass_b = model.points[b].mass;
    laplacian(a.value, a.value) += k / mass_a;
    laplacian(b.value, b.value) += k / mass_b;
    laplacian(a.value, b.value) -= k / std::sqrt(mass_a * mass_b);
    laplacian(b.value, a.value) -= k / std::sqrt(mass_a * mass_b);
  }
  return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(laplacian, Eigen::EigenvaluesOnly)
                       .eigenvalues()
                       .maxCoeff());
}

// What the step has to bear.
double frequency_to_bear(const PhysicalModel& model) {
  return may_fold(model) ? exact_frequency_of_any_shape(model) : exact_frequency(model);
}

RC_GTEST_PROP(AutomaticStep, OfAnyShapeIsBoundedByThatOfRest, ()) {
  const PhysicalModel model = random_model();
  const double rest = exact_frequency(model), any = exact_frequency_of_any_shape(model);
  RC_ASSERT(rest <= any * (1.0 + 1e-9));
  RC_ASSERT(any <= kMostGainByTurning * rest * (1.0 + 1e-9));
  const double bound = large_strain_bound(model).omega_max;
  RC_ASSERT(bound >= any);
  RC_ASSERT(bound <= 1.04 * any);
}

Eigen::Index pieces_of(const PhysicalModel& model) {
  Lattice lattice = test::lattice_of({model});
  return static_cast<Eigen::Index>(TimeOperator(lattice).pieces().count);
}

// What cannot fold has no way to move at next to no strain but the six of a rigid body.
RC_GTEST_PROP(AutomaticStep, KnowsWhatMayFold, ()) {
  const PhysicalModel model = random_model();
  if (may_fold(model)) return;
  RC_TAG("rigid");
  PhysicalModel plain = model;  // masses and stiffnesses that differ by 1e6 would hide zeros
  for (PointAttributes& p : plain.points) p.mass = 1.0;
  for (EdgeAttributes& e : plain.edges) e.stiffness = 1.0;
  const Eigen::MatrixXd K = test::dense_matrix(plain, &EdgeAttributes::stiffness);
  const Eigen::VectorXd squares =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues();
  const Eigen::Index rigid = 6 * pieces_of(model);
  RC_ASSERT(std::abs(squares[rigid - 1]) < 1e-9 * squares[squares.size() - 1]);
  RC_ASSERT(squares[rigid] > 1e-6 * squares[squares.size() - 1]);
}

// These runs would show a step that is 2 % too long.
RC_GTEST_PROP(AutomaticStep, IsBelowALimitThatTheseRunsShow, ()) {
  PhysicalModel model = random_model();
  for (EdgeAttributes& e : model.edges) e.damping = 0.0;
  model.object.internal_damping = 0.0;
  const double limit = 2.0 / exact_frequency(model);
  Lattice lattice = test::lattice_of({model});
  RC_ASSERT(TimeOperator(lattice).largest_step() < limit);
  set_in_motion(lattice, 1e-5);
  RC_ASSERT(growth_of(lattice, SpringPrecision::kDouble, 1.02 * limit, 3000) > 100.0);
}

// ---- what breaks and what is glued

// Without contact between the loose points, whose energy is not counted.
RC_GTEST_PROP(AutomaticStep, IsStableAfterBreaking, ()) {
  PhysicalModel model = random_model();
  model.object.contact_share = 0.0;
  Lattice lattice = test::lattice_of({model});
  set_in_motion(lattice, 1e-5);
  std::mt19937 random(*rc::gen::arbitrary<unsigned>());
  for (Spring& s : lattice.springs) {
    if (random() % 16 == 0) s.break_threshold = 1e-6 * s.rest_length;
  }
  rebuild_active(lattice);
  TimeOperator time(lattice);
  const StepReport report = time.advance(300, time.largest_step(), kEmptySpace);
  const bool some = report.broken_edges > 0 && report.broken_edges < lattice.springs.size();
  RC_CLASSIFY(some, "broke in part");
  Lattice rest = test::lattice_of({extract_model(lattice, 0)});
  if (rest.objects[0].spring_frequency > 0.0) {
    assert_stable(std::move(rest), kMostGrowthOfStrained);
  }
}

RC_GTEST_PROP(AutomaticStep, IsNoShorterAfterBreakingByItself, ()) {
  PhysicalModel model = random_model();
  const double before = highest_frequency(model).omega_max;
  break_edges(model, test::ids(test::random_edges(model)));
  // 0.5 and 3.5 % are what the proof may add
  RC_ASSERT(highest_frequency(model).omega_max <= 1.04 * before);
}

RC_GTEST_PROP(AutomaticStep, IsStableAfterGluing, ()) {
  PhysicalModel a = random_model(), b = random_model();
  place(b, Mat3::Identity(), test::random_vector(1.0));
  GlueBond bond{.distance = uniform(0.1, 0.8), .stiffness = log_uniform(1e-2, 1e12)};
  bond.damping = test::coin() ? 0.0 : log_uniform(1e-6, 1e-2) * bond.stiffness;
  auto glued = test::try_to_glue(a, b, bond);
  RC_CLASSIFY(glued.has_value(), "glued");
  if (!glued) return;
  glued->model.object.contact_share = 0.0;  // one may have begun in the other
  assert_stable(test::lattice_of({glued->model}));
}

// ---- how near to the limit

PhysicalModel random_regular_lattice() {
  CubicLattice shape;
  for (int& n : shape.points) n = *rc::gen::inRange(1, 6);
  shape.points[0] = std::max(2, shape.points[0]);
  shape.spacing = log_uniform(1e-3, 10.0);
  const double k = log_uniform(1e-2, 1e12);
  shape.springs = {k, test::coin() ? uniform(0.0, k) : 0.0, test::coin() ? uniform(0.0, k) : 0.0};
  if (test::coin()) shape.surface = CubicSurface::kShared;
  shape.mass = log_uniform(1e-6, 1e3);
  if (test::coin())
    shape.damping_per_stiffness = log_uniform(1e-3, 100.0) * std::sqrt(shape.mass / k);
  return cubic_lattice(shape);
}

double damping_per_stiffness(const PhysicalModel& model) {
  return model.edges[EdgeId(0)].damping / model.edges[EdgeId(0)].stiffness;
}

// The proof tries 0.5 % above the estimate and then 3 % more: about one lattice in a thousand needs
// the second try. The limit falls with omega to omega squared, by damping.
constexpr double kSecondTry = 1.005 * 1.03 * 1.001;
constexpr double kLeastShare = 1.0 / (kSecondTry * kSecondTry);

// The bound alone, before the safety of 0.92: (2 / omega) (sqrt(1 + zeta^2) - zeta) with
// zeta = (c / k) omega / 2.
RC_GTEST_PROP(AutomaticStep, OfTheSpringsOfARegularLatticeIsNearItsLimit, ()) {
  const PhysicalModel model = random_regular_lattice();
  const double exact = frequency_to_bear(model);
  const double limit = stable_step(exact, 0.5 * damping_per_stiffness(model) * exact);
  const LatticeObject object = test::lattice_of({model}).objects[0];
  const double bound =
      stable_step(object.spring_frequency, 0.5 * object.spring_damping / object.spring_frequency);
  RC_CLASSIFY(bound >= 0.985 * limit, "within 1.5 %");
  RC_ASSERT(bound <= limit * (1.0 + 1e-9));
  RC_ASSERT(bound >= kLeastShare * limit);
}

// The step as chosen, with its safety, beside the limit of the lattice with a contact at every
// point: K + omega_c^2 M, which shifts every eigenvalue by omega_c^2; or that of contacts alone.
double share_of_limit(const PhysicalModel& model) {
  const LatticeObject object = test::lattice_of({model}).objects[0];
  const double springs = frequency_to_bear(model);
  const double omega = std::max(std::hypot(springs, object.contact_frequency),
                                std::sqrt(kContactsOfAGrain) * object.contact_frequency);
  const double rate = damping_per_stiffness(model) * springs * springs;
  return object.largest_step / stable_step(omega, 0.5 * rate / omega);
}

RC_GTEST_PROP(AutomaticStep, OfARegularLatticeIsNearItsLimitWithContacts, ()) {
  const double share = share_of_limit(random_regular_lattice());
  RC_CLASSIFY(share >= 0.9, "at least 0.9");
  RC_ASSERT(share >= 0.92 * kLeastShare);
  RC_ASSERT(share <= 0.92 * (1.0 + 1e-9));
}

// Lattices such as the reference's.
TEST(AutomaticStep, OfUsualCubesIsAtLeastNineTenthsOfTheirLimitWithContacts) {
  const CubicSprings kinds[] = {
      {1e6, 1e6, 0.0}, {1e6, 1e6, 1e6}, {1e6, 0.0, 0.0}, {1e6, 0.0, 0.375e6}};
  for (const CubicSprings& springs : kinds) {
    for (int n : {2, 3, 4, 5, 6}) {
      for (CubicSurface surface : {CubicSurface::kUniform, CubicSurface::kShared}) {
        const double share = share_of_limit(
            cubic_lattice({.points = {n, n, n}, .springs = springs, .surface = surface}));
        EXPECT_GE(share, 0.9) << n << " points a side, k2 " << springs.face_diagonal;
        EXPECT_LE(share, 0.92) << n << " points a side, k2 " << springs.face_diagonal;
      }
    }
  }
}

// ---- large deformations, without breaking and contact

PhysicalModel cube(int points, const CubicSprings& springs, double damping_ratio) {
  PhysicalModel model = cubic_lattice({.points = {points, points, points}, .springs = springs});
  const double omega = exact_frequency(model);
  for (EdgeAttributes& e : model.edges) e.damping = 2.0 * damping_ratio / omega * e.stiffness;
  model.object.contact_share = 0.0;
  return model;
}

constexpr CubicSprings kFloppy[] = {{1e6, 0.0, 0.0}, {1e6, 0.0, 0.375e6}, {0.0, 0.0, 1e6}};
constexpr CubicSprings kBraced[] = {{1e6, 1e6, 0.0}, {1e6, 1e6, 1e6}};

double growth_at(const PhysicalModel& model, double strain, double step_scale = 1.0) {
  Lattice lattice = test::lattice_of({model});
  set_in_motion(lattice, strain);
  const double dt = step_scale * TimeOperator(lattice).largest_step();
  return growth_of(lattice, SpringPrecision::kDouble, dt, 6000);
}

// At the step of their shape at rest they end at infinity from 0.3 % on.
TEST(AutomaticStep, KeepsFloppyCubesStable) {
  for (const CubicSprings& springs : kFloppy) {
    for (int points : {2, 3, 4, 6}) {
      for (double strain : {0.01, 0.03, 0.1}) {
        EXPECT_LE(growth_at(cube(points, springs, 0.0), strain), kMostGrowth) << points;
      }
      EXPECT_LE(growth_at(cube(points, springs, 0.01), 0.1), 1.0 + 1e-9) << points;
      for (double strain : {0.3, 1.0}) {
        EXPECT_LE(growth_at(cube(points, springs, 0.01), strain), kMostGrowthOfStrained) << points;
      }
    }
  }
}

// A spring whose ends pass each other turns round within a step: only a smaller one follows.
TEST(AutomaticStep, NeedsAFourthWhereUndampedSpringsTurnInsideOut) {
  for (const CubicSprings& springs : kFloppy) {
    EXPECT_LE(growth_at(cube(4, springs, 0.0), 1.0, 0.25), 1.2);
  }
}

// Undamped they get the step of any shape when strained, damped they do with that at rest.
TEST(AutomaticStep, KeepsBracedCubesStable) {
  for (const CubicSprings& springs : kBraced) {
    for (int points : {2, 3, 5}) {
      for (double strain : {1e-4, 1e-3, 0.01, 0.1}) {
        EXPECT_LE(growth_at(cube(points, springs, 0.0), strain), kMostGrowth) << points;
        EXPECT_LE(growth_at(cube(points, springs, 0.01), strain), 1.0 + 1e-9) << points;
      }
    }
  }
}

// Restitution 1 at the full step: points of rubble, whose springs are all broken, by twos. A
// contact begins and ends within a step; at the limit of one contact energy grew by 73 % on
// average.
TEST(AutomaticStep, GainsHardlyAnyEnergyInPerfectCollisions) {
  double sum = 0.0, most = 0.0;
  constexpr int kCollisions = 1000;
  std::mt19937 random(3);
  for (int i = 0; i < kCollisions; ++i) {
    PhysicalModel rubble = test::chain({.stiffness = 1e4, .spacing = 0.1});
    rubble.edges[EdgeId(0)].broken = true;
    rubble.object.restitution = 1.0;
    rubble.points[PointId(0)].velocity = Vec3(1.0, 0.0, 0.0) + test::random_vector(random, 0.1);
    Lattice lattice = test::lattice_of({rubble});
    const double before = test::totals(lattice).kinetic;
    TimeOperator time(lattice);
    const double dt = time.largest_step();
    time.advance(static_cast<int>(0.5 / dt), dt, kEmptySpace);
    const double share = test::totals(lattice).kinetic / before;
    sum += share;
    most = std::max(most, share);
  }
  EXPECT_NEAR(sum / kCollisions, 1.0, 0.02);
  EXPECT_LT(most, 1.08);  // z^2/4 / (1 - z^2/4), z = 2 x 0.92 / sqrt(12)
}

}  // namespace
}  // namespace limber

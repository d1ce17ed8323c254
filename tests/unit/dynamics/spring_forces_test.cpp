#include "core/dynamics/spring_forces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "core/modeller/box_lattice.h"
#include "core/modeller/rope.h"
#include "core/modeller/round_solids.h"
#include "core/operators/time_operator.h"
#include "core/threads/parallel_for.h"
#include "tests/support/blocks.h"
#include "tests/support/lattices.h"
#include "tests/support/spring_sums.h"

namespace limber {
namespace {

using testing::Each;
using testing::IsEmpty;

constexpr double kSpacing = 0.02;  // m

PhysicalModel box(std::array<int, 3> cells, const Vec3& origin = Vec3::Zero()) {
  return test::with_plausible_attributes(
      box_lattice(cells, Vec3::Constant(kSpacing), origin, "box"), "box");
}

// On no grid: layers around a middle block.
PhysicalModel ball(const Vec3& centre) {
  return test::with_plausible_attributes(
      solid_sphere({.centre = centre, .radius = 0.1, .cells_across = 6}, "ball"), "ball");
}

PhysicalModel cord(const Vec3& from) {
  std::vector<Vec3> points;
  for (int i = 0; i < 40; ++i) points.push_back(from + Vec3(0.01 * i, 0.0, 0.0));
  return test::with_plausible_attributes(rope(points, "cord"), "cord");
}

// Points a tenth of the spacing off, at 1 m/s.
void disturb(Lattice& lattice, unsigned seed) {
  std::mt19937 random(seed);
  for (PointMotion& m : lattice.motion) m.position += test::random_vector(random, 0.1 * kSpacing);
  test::shake(lattice, seed + 1, 1.0);
}

Lattice disturbed(std::vector<PhysicalModel> models, unsigned seed) {
  Lattice lattice = test::lattice_of(std::move(models));
  disturb(lattice, seed);
  return lattice;
}

bool same_bits(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

// Forces of k = 100 N/m at strains of up to a third, c = 1 N s/m at 2 m/s: some newtons each.
void expect_close(const std::vector<Vec3>& fast, const std::vector<Vec3>& exact) {
  ASSERT_EQ(fast.size(), exact.size());
  for (std::size_t p = 0; p < fast.size(); ++p)
    EXPECT_LT((fast[p] - exact[p]).norm(), 1e-3 * (1.0 + exact[p].norm())) << "point " << p;
}

TEST(SpringForces, InDoubleAreTheSpringsOneByOne) {
  const Lattice lattice = disturbed({box({4, 4, 4}), cord({0.0, 1.0, 0.0})}, 1);
  std::vector<Vec3> expected(lattice.motion.size(), Vec3::Zero());
  for (const Spring& s : lattice.springs) {
    const Vec3 d = lattice.motion[s.b].position - lattice.motion[s.a].position;
    const Vec3 w = lattice.motion[s.b].velocity - lattice.motion[s.a].velocity;
    const double tension =
        s.stiffness * (d.norm() - s.rest_length) + s.damping * w.dot(d.normalized());
    expected[s.a] += tension * d.normalized();
    expected[s.b] -= tension * d.normalized();
  }
  const test::SpringSums sums = test::in_double(lattice);
  EXPECT_EQ(sums.paths.scalar, lattice.active.size());
  for (std::size_t p = 0; p < expected.size(); ++p)
    EXPECT_LT((sums.force[p] - expected[p]).norm(), 1e-12);
}

test::SpringSums in_single(Lattice lattice) {
  SpringForces springs(lattice, SpringPrecision::kSingle);
  return test::added_by(springs, lattice);
}

TEST(SpringForces, InSingleTakeGridsAndEdges) {
  const Lattice lattice =
      disturbed({ball({0.5, 0.0, 0.0}), box({4, 4, 4}), cord({0.0, 1.0, 0.0})}, 2);
  const test::SpringSums sums = in_single(lattice);
  EXPECT_EQ(sums.paths.grids, lattice.objects[1].edges.size());
  EXPECT_EQ(sums.paths.edges, lattice.active.size() - sums.paths.grids);
  EXPECT_EQ(sums.paths.scalar, 0u);
  const test::SpringSums exact = test::in_double(lattice);
  expect_close(sums.force, exact.force);
  EXPECT_EQ(sums.overstretched, exact.overstretched);
}

// Constants that single precision cannot hold.
TEST(SpringForces, LeaveWhatIsBeyondSinglePrecisionToDouble) {
  PhysicalModel hard = box({4, 4, 4});
  for (EdgeAttributes& e : hard.edges) e.stiffness = 1e30;
  PhysicalModel uneven = cord({0.0, 1.0, 0.0});
  uneven.edges[EdgeId(0)].rest_length *= 1e6;
  const Lattice lattice = disturbed({hard, uneven}, 3);
  const test::SpringSums sums = in_single(lattice), exact = test::in_double(lattice);
  EXPECT_EQ(sums.paths.scalar, lattice.active.size());
  EXPECT_TRUE(same_bits(sums.force, exact.force));
  EXPECT_EQ(sums.overstretched, exact.overstretched);
}

// ---------------------------------------------------------------------------------------------

class Precisions : public testing::TestWithParam<SpringPrecision> {};
INSTANTIATE_TEST_SUITE_P(SpringForces, Precisions,
                         testing::Values(SpringPrecision::kDouble, SpringPrecision::kSingle),
                         [](const auto& tested) {
                           return tested.param == SpringPrecision::kDouble ? "Double" : "Single";
                         });

// Breaks every 37th edge after the other, as the time operator does.
TEST_P(Precisions, EdgesThatBreakAreGoneAsAfterARebuild) {
  Lattice lattice = disturbed({box({5, 4, 4}), cord({0.0, 1.0, 0.0}), ball({0.5, 0.0, 0.0})}, 4);
  SpringForces springs(lattice, GetParam());
  springs.add(0.0);
  for (std::int32_t e = 5; e < static_cast<std::int32_t>(lattice.springs.size()); e += 37) {
    BreakingResult broken;
    break_edges(lattice.topology, lattice.breaking, std::vector<std::int32_t>{e}, broken);
    slacken(lattice, broken.broken_edges);
    springs.remove(broken.broken_edges);
    if (e % 3 != 0) continue;
    const test::SpringSums now = test::added_by(springs, lattice);
    Lattice anew = lattice;
    rebuild_active(anew);
    ASSERT_LT(anew.active.size(), lattice.active.size());
    SpringForces rebuilt(anew, GetParam());
    const test::SpringSums expected = test::added_by(rebuilt, anew);
    ASSERT_TRUE(same_bits(now.force, expected.force)) << "edge " << e;
    ASSERT_EQ(now.overstretched, expected.overstretched) << "edge " << e;
  }
}

// Half of the box and all of the cord idle: their points feel nothing.
TEST_P(Precisions, LeaveIdlePointsAlone) {
  Lattice lattice = disturbed({box({5, 5, 5}), cord({0.0, 1.0, 0.0})}, 5);
  SpringForces springs(lattice, GetParam());
  springs.add(0.0);
  const auto idle = [&](std::size_t p) { return p % 216 < 100 || p >= 216; };
  for (std::size_t p = 0; p < lattice.role.size(); ++p)
    if (idle(p)) lattice.role[p] = PointRole::kIdle;
  rebuild_active(lattice);
  springs.active_changed();
  const test::SpringSums sums = test::added_by(springs, lattice);
  expect_close(sums.force, test::in_double(lattice).force);
  for (std::size_t p = 0; p < lattice.role.size(); ++p)
    EXPECT_TRUE(!idle(p) || sums.force[p] == Vec3::Zero()) << "point " << p;
  for (std::int32_t e : sums.overstretched) EXPECT_GE(lattice.active_of_edge[e], 0);
  const SpringForces::Paths paths = springs.paths();
  EXPECT_EQ(paths.grids + paths.edges + paths.scalar, lattice.active.size());

  std::fill(lattice.role.begin(), lattice.role.end(), PointRole::kDynamic);
  rebuild_active(lattice);
  springs.active_changed();
  SpringForces fresh(lattice, GetParam());
  const test::SpringSums awake = test::added_by(springs, lattice);
  EXPECT_TRUE(same_bits(awake.force, test::added_by(fresh, lattice).force));
}

TEST_P(Precisions, TakeObjectsThatAreAddedLater) {
  Lattice lattice = disturbed({box({4, 4, 4})}, 6);
  SpringForces springs(lattice, GetParam());
  springs.add(0.0);
  for (PhysicalModel& model :
       std::vector<PhysicalModel>{cord({0.0, 1.0, 0.0}), box({3, 6, 3}, {1.0, 0.0, 0.0})})
    add_object(lattice, model);
  rebuild_active(lattice);
  springs.active_changed();
  disturb(lattice, 7);
  const test::SpringSums sums = test::added_by(springs, lattice);
  SpringForces fresh(lattice, GetParam());
  const test::SpringSums expected = test::added_by(fresh, lattice);
  EXPECT_TRUE(same_bits(sums.force, expected.force));
  EXPECT_EQ(sums.overstretched, expected.overstretched);
  EXPECT_EQ(sums.paths.grids, expected.paths.grids);
  expect_close(sums.force, test::in_double(lattice).force);
}

TEST_P(Precisions, ChangeOnlyWhatSpringsPull) {
  Lattice lattice = disturbed({box({4, 4, 4})}, 8);
  const std::vector<Vec3> springs_alone = [&] {
    SpringForces springs(lattice, GetParam());
    return test::added_by(springs, lattice).force;
  }();
  SpringForces springs(lattice, GetParam());
  const Vec3 weight(0.0, -1024.0, 0.0);
  std::fill(lattice.force.begin(), lattice.force.end(), weight);
  springs.add(0.0);
  for (std::size_t p = 0; p < springs_alone.size(); ++p)
    EXPECT_LT((lattice.force[p] - weight - springs_alone[p]).norm(), 1e-11);
}

// Breaking on the way.
std::vector<double> run(SpringPrecision precision) {
  PhysicalModel breakable = box({5, 5, 5});
  for (EdgeAttributes& e : breakable.edges) e.break_threshold = 0.3 * kSpacing;
  Lattice lattice = disturbed({breakable, cord({0.0, 1.0, 0.0}), ball({0.5, 0.0, 0.0})}, 9);
  TimeOperator time(lattice, Integrator::kSymplecticEuler, precision);
  const StepReport report = time.advance(300, 0.1 * time.largest_step(), kEmptySpace);
  EXPECT_GT(report.broken_edges, 0u);
  std::vector<double> state = {static_cast<double>(report.broken_edges)};
  for (const PointMotion& m : lattice.motion) {
    state.insert(state.end(), m.position.begin(), m.position.end());
    state.insert(state.end(), m.velocity.begin(), m.velocity.end());
  }
  return state;
}

TEST_P(Precisions, TwoRunsGiveTheSameBits) { EXPECT_EQ(run(GetParam()), run(GetParam())); }

// Large enough for parallel loops on either path.
TEST_P(Precisions, AnyNumberOfThreadsGivesTheSameBits) {
  const PhysicalModel large_ball = test::with_plausible_attributes(
      solid_sphere({.radius = 0.1, .cells_across = 18}, "ball"), "ball");
  std::vector<PhysicalModel> models = {box({16, 17, 15}, {1.0, 0.0, 0.0}), large_ball};
  for (PhysicalModel& model : models)
    for (EdgeAttributes& e : model.edges) e.break_threshold = 0.15 * e.rest_length;
  const Lattice lattice = disturbed(std::move(models), 10);
  const auto sums = [&](int count) {
    set_threads(count);
    Lattice copy = lattice;
    SpringForces springs(copy, GetParam());
    const test::SpringSums added = test::added_by(springs, copy);
    set_threads(1);
    return added;
  };
  const test::SpringSums alone = sums(1);
  EXPECT_GT(alone.overstretched.size(), 0u);
  for (int count : {2, 3}) {
    const test::SpringSums shared = sums(count);
    EXPECT_TRUE(same_bits(shared.force, alone.force)) << count << " threads";
    EXPECT_EQ(shared.overstretched, alone.overstretched);
  }
}

TEST_P(Precisions, AnEmptyLatticeHasNone) {
  Lattice lattice;
  SpringForces springs(lattice, GetParam());
  springs.add(0.0);
  EXPECT_THAT(springs.overstretched_edges(), IsEmpty());
}

TEST_P(Precisions, PointsWithoutEdgesFeelNothing) {
  Lattice lattice = test::lattice_of({test::chain({.points = 1})});
  SpringForces springs(lattice, GetParam());
  EXPECT_THAT(test::added_by(springs, lattice).force, Each(Vec3::Zero()));
}

// A strut as long as 40 cells is longer than the grid's own units can measure.
TEST(SpringForces, FlagsOfAGridDoNotConcernOtherSpringsOfItsPoints) {
  GeometricModel geometry = box({5, 5, 5}).geometry;
  const PointId far = geometry.points.push_back({40.0 * kSpacing, 0.0, 0.0});
  const EdgeId strut = geometry.edges.push_back({PointId(std::size_t{0}), far});
  geometry.subobjects[0].points.end += 1;
  geometry.subobjects[0].edges.end += 1;
  PhysicalModel model = test::with_plausible_attributes(std::move(geometry), "box");
  for (EdgeAttributes& edge : model.edges) edge.break_threshold = 0.02 * kSpacing;
  model.edges[strut].break_threshold = kUnbreakable;
  Lattice lattice = test::lattice_of({model});
  lattice.motion[0].position -= Vec3(0.0, 0.1 * kSpacing, 0.0);
  SpringForces springs(lattice, SpringPrecision::kSingle);
  const test::SpringSums single = test::added_by(springs, lattice);
  const test::SpringSums reference = test::in_double(lattice);
  EXPECT_GT(single.paths.grids, 0u);
  EXPECT_FALSE(reference.overstretched.empty());
  EXPECT_EQ(single.overstretched, reference.overstretched);
}

// make_implicit() has the paths built anew without rebuild_active().
TEST(SpringForces, BrokenSpringsStayBrokenWhenAnotherObjectChangesItsPath) {
  Lattice lattice = disturbed({box({5, 5, 5}), ball({1.0, 0.0, 0.0})}, 5);
  SpringForces springs(lattice, SpringPrecision::kSingle);
  test::added_by(springs, lattice);
  std::vector<std::int32_t> broken;
  for (std::int32_t e = 0; e < static_cast<std::int32_t>(lattice.springs.size()); e += 7) {
    broken.push_back(e);
    lattice.breaking.edge_broken[e] = true;
  }
  slacken(lattice, broken);
  springs.remove(broken);
  const test::SpringSums before = test::added_by(springs, lattice);
  springs.keep_in_double(1);
  const test::SpringSums after = test::added_by(springs, lattice);
  for (std::size_t p = 0; p < before.force.size(); ++p) {
    EXPECT_LT((after.force[p] - before.force[p]).norm(), 0.05) << "point " << p;
  }
}

// Broken springs take no path, however they did before; keep_in_double() changes paths at once.
TEST_P(Precisions, CountTheSpringsThatAreLeft) {
  Lattice lattice = disturbed({box({5, 5, 5})}, 3);
  SpringForces springs(lattice, GetParam());
  const auto sum = [](const SpringForces::Paths& p) { return p.grids + p.edges + p.scalar; };
  EXPECT_EQ(sum(springs.paths()), lattice.active.size());
  const std::vector<std::int32_t> edges = {0, 7, 20};
  for (std::int32_t e : edges) lattice.breaking.edge_broken[e] = true;
  slacken(lattice, edges);
  springs.remove(edges);
  EXPECT_EQ(sum(springs.paths()), lattice.active.size() - edges.size());
  springs.keep_in_double(0);
  EXPECT_EQ(springs.paths().scalar, lattice.active.size() - edges.size());
}

}  // namespace
}  // namespace limber

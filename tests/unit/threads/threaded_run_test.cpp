// A whole run, with breaking, on any number of threads: the same bits.

#include <gtest/gtest.h>

#include <cstring>

#include "core/modeller/box_lattice.h"
#include "core/modeller/round_solids.h"
#include "core/operators/time_operator.h"
#include "core/threads/parallel_for.h"
#include "tests/support/blocks.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

constexpr double kSpacing = 0.02;  // m

PhysicalModel breakable(GeometricModel geometry, const std::string& name, double strain) {
  PhysicalModel model = test::with_plausible_attributes(std::move(geometry), name);
  for (EdgeAttributes& e : model.edges) e.break_threshold = strain * e.rest_length;
  return model;
}

// Two cubes of 20^3 points on grids and a ball of 2,273 on none: parallel loops over points and
// over springs on every path have more than two ranges.
Lattice start() {
  const Vec3 spacing = Vec3::Constant(kSpacing);
  Lattice lattice = test::lattice_of(
      {breakable(box_lattice({19, 19, 19}, spacing, Vec3::Zero(), "left"), "left", 0.28),
       breakable(box_lattice({19, 19, 19}, spacing, {0.4, 0.01, 0.0}, "right"), "right", 0.28),
       breakable(
           solid_sphere({.centre = {0.0, -0.5, 0.0}, .radius = 0.16, .cells_across = 16}, "ball"),
           "ball", 0.11)});
  std::mt19937 random(3);
  for (PointMotion& m : lattice.motion) m.position += test::random_vector(random, 0.05 * kSpacing);
  test::shake(lattice, 4, 0.02);
  for (std::int32_t p = 0; p < lattice.objects[0].points.end; ++p) {
    lattice.motion[p].velocity.x() += 0.6;  // into the other cube
  }
  return lattice;
}

struct Outcome {
  Lattice lattice;
  StepReport report;
};

Outcome run(const Lattice& start, SpringPrecision precision, int thread_count) {
  set_threads(thread_count);
  Outcome outcome{start, {}};
  TimeOperator time(outcome.lattice, Integrator::kSymplecticEuler, precision);
  const double dt = 0.5 * time.largest_step();
  outcome.report = time.advance(60, dt, {.gravity = {0.0, -9.8, 0.0}});
  set_threads(1);
  return outcome;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

void expect_same(const Outcome& found, const Outcome& wanted) {
  EXPECT_TRUE(same_bits(found.lattice.motion, wanted.lattice.motion));
  EXPECT_TRUE(same_bits(found.lattice.force, wanted.lattice.force));
  EXPECT_TRUE(same_bits(found.lattice.peak_load, wanted.lattice.peak_load));
  EXPECT_EQ(found.lattice.breaking.edge_broken, wanted.lattice.breaking.edge_broken);
  EXPECT_EQ(found.report.broken_edges, wanted.report.broken_edges);
  ASSERT_EQ(found.report.breaks.size(), wanted.report.breaks.size());
  for (std::size_t i = 0; i < wanted.report.breaks.size(); ++i) {
    const BreakEvent &a = found.report.breaks[i], &b = wanted.report.breaks[i];
    EXPECT_TRUE(a.edge == b.edge && a.time == b.time && a.where == b.where && a.piece == b.piece);
  }
}

class ThreadedRun : public testing::TestWithParam<SpringPrecision> {};
INSTANTIATE_TEST_SUITE_P(Precisions, ThreadedRun,
                         testing::Values(SpringPrecision::kDouble, SpringPrecision::kSingle),
                         [](const auto& tested) {
                           return tested.param == SpringPrecision::kDouble ? "Double" : "Single";
                         });

TEST_P(ThreadedRun, GivesTheBitsOfOneThread) {
  const Lattice lattice = start();
  ASSERT_GT(lattice.dynamic_points.size(), 2u * 8192u);
  ASSERT_GT(lattice.objects[2].points.size(), 2u * 1024u);
  const Outcome alone = run(lattice, GetParam(), 1);
  for (const LatticeObject& object : lattice.objects) {
    std::size_t broken = 0;
    for (std::int32_t e = object.edges.begin; e < object.edges.end; ++e) {
      broken += alone.lattice.breaking.edge_broken[e];
    }
    EXPECT_GT(broken, 10u) << object.authored.name;
    EXPECT_LT(broken, object.edges.size() / 2) << object.authored.name;
  }
  for (int count : {2, 4}) {
    SCOPED_TRACE(count);
    expect_same(run(lattice, GetParam(), count), alone);
  }
}

}  // namespace
}  // namespace limber

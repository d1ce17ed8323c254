#include "core/dynamics/edge_kernel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <numbers>

#include "core/dynamics/quanta.h"
#include "core/dynamics/spring_precision.h"
#include "core/model/errors.h"
#include "core/modeller/rope.h"
#include "core/modeller/sheet.h"
#include "core/operators/time_operator.h"
#include "tests/support/blocks.h"
#include "tests/support/instruction_sets.h"
#include "tests/support/lattices.h"
#include "tests/support/spring_sums.h"

// The general path through SpringForces, on every instruction set that this machine has, against
// the double path. What it shares with stencil_kernel_test.cpp is the spring, not how it is fed.

namespace limber {
namespace {

using test::kReciprocalError;
using test::on_every_target;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kSize = 0.3;  // m, of all models here

// ---- models on no grid

PhysicalModel bent_shell() {
  const ParametricSurface barrel = [](double u, double v) {
    const double angle = 2.0 * u;
    return Vec3(kSize * std::cos(angle), kSize * std::sin(angle), kSize * v);
  };
  return test::with_plausible_attributes(sheet(barrel, {.cells_u = 12, .cells_v = 7}, "shell"),
                                         "shell");
}

PhysicalModel coiled_rope() {
  const Curve helix = [](double t) {
    const double angle = 20.0 * t;
    return Vec3(0.1 * std::cos(angle), 0.1 * std::sin(angle), kSize * t);
  };
  return test::with_plausible_attributes(rope(points_along(helix, 90), "rope"), "rope");
}

// A random tree; lengths from the shortest, the first, to `spread` times that, the second.
PhysicalModel random_graph(int springs, double spread, unsigned seed) {
  std::mt19937 random(seed);
  GeometricModelBuilder builder;
  builder.begin_subobject("graph");
  PointId last = builder.add_point(Vec3::Zero());
  Vec3 at = Vec3::Zero();
  for (int i = 0; i < springs; ++i) {
    const Vec3 direction = test::random_vector(random, 1.0).normalized();
    const double share = i == 0 ? 0.0 : i == 1 ? 1.0 : random() / 4294967296.0;
    const double length = 1e-3 * std::pow(spread, share);  // m
    const Vec3 next = at + length * direction;
    const PointId p = builder.add_point(next);
    builder.edge(last, p);
    if (random() % 3 > 0) last = p, at = next;  // else a star
  }
  return test::with_plausible_attributes(builder.finish(), "graph");
}

PhysicalModel graph() { return random_graph(500, 8.0, 1); }

const std::vector<std::function<PhysicalModel()>>& models() {
  static const std::vector<std::function<PhysicalModel()>> all = {bent_shell, coiled_rope, graph};
  return all;
}

void set_constants(Lattice& lattice, std::mt19937& random) {
  for (Spring& s : lattice.springs) {
    s.stiffness = 100.0 * (1 + random() % 5);
    s.damping = 0.1 * (random() % 3);
    s.break_threshold = kUnbreakable;
  }
  rebuild_active(lattice);
}

// Each point off its place by `share` of the shortest of its springs.
Lattice strained(const PhysicalModel& model, double share, unsigned seed) {
  std::mt19937 random(seed);
  Lattice lattice = test::lattice_of({model});
  set_constants(lattice, random);
  for (std::size_t p = 0; p < lattice.motion.size(); ++p) {
    double shortest = kSize;
    for (std::int32_t e : lattice.point_edges[p]) {
      shortest = std::min(shortest, lattice.springs[e].rest_length);
    }
    lattice.motion[p].position += test::random_vector(random, share * shortest);
  }
  return lattice;
}

// Fails the test where springs go any other way.
test::SpringSums by_edges(Lattice lattice) {
  SpringForces springs(lattice, SpringPrecision::kSingle);
  const test::SpringSums sums = test::added_by(springs, lattice);
  EXPECT_EQ(sums.paths.edges, lattice.active.size());
  return sums;
}

// ---- how far single precision may be off

double quantum_of(const Lattice& lattice) {
  double shortest = kUnbreakable, longest = 0.0;
  for (const Spring& s : lattice.springs) {
    shortest = std::min(shortest, s.rest_length);
    longest = std::max(longest, s.rest_length);
  }
  return Quanta(shortest, longest).quantum();
}

// Of the force on each point, N. Positions are rounded to half a quantum at both ends, in three
// components: up to sqrt(3) quanta of length, and as much of direction. Squares are summed in
// single precision, half a unit in the last place (2^-24) each of d^2, three sums and L0^2: a
// length is off by 2^-23 of the longer of L and L0. Velocities relative to the object's point are
// rounded to 2^-24.
std::vector<double> bounds_of_error(const Lattice& lattice) {
  const double quantum = quantum_of(lattice);
  std::vector<double> bound(lattice.motion.size(), 0.0);
  for (const Spring& s : lattice.springs) {
    const Vec3 d = lattice.motion[s.b].position - lattice.motion[s.a].position;
    const Vec3 w = lattice.motion[s.b].velocity - lattice.motion[s.a].velocity;
    const double length = d.norm(), stretch = std::abs(length - s.rest_length);
    const double rounded = std::sqrt(3.0) * quantum + 0x1p-23 * std::max(length, s.rest_length);
    const double force = s.stiffness * stretch + s.damping * w.norm();
    const double error = kReciprocalError * force + s.stiffness * rounded +
                         (force + s.damping * w.norm()) * rounded / length +
                         0x1p-22 * s.damping * w.norm();
    bound[s.a] += error;
    bound[s.b] += error;
  }
  return bound;
}

// Of both paths, as a share of its bound.
double worst_error(const Lattice& lattice) {
  return test::worst_error(by_edges(lattice).force, test::in_double(lattice).force,
                           bounds_of_error(lattice));
}

// Relative to the sum of the magnitudes of forces at the point.
double worst_relative_error(const Lattice& lattice) {
  return test::worst_error(by_edges(lattice).force, test::in_double(lattice).force,
                           test::force_scales(lattice));
}

TEST(EdgeKernel, ForcesAreThoseOfTheDoublePath) {
  on_every_target([] {
    for (const auto& model : models()) {
      for (double share : {0.0, 1e-4, 1e-3, 0.1, 0.5}) {
        for (unsigned seed = 0; seed < 5; ++seed) {
          Lattice lattice = strained(model(), share, seed);
          test::shake(lattice, seed, share * kSize);
          EXPECT_LT(worst_error(lattice), 1.0) << model().name << ", share " << share;
        }
      }
    }
  });
}

// Lengths near enough to each other, moderately strained: what reciprocals leave is all.
TEST(EdgeKernel, ForcesAreWithinAThousandthAtAStrainOfOneInTenThousand) {
  on_every_target([] {
    for (const auto& model : {bent_shell, coiled_rope}) {
      std::mt19937 random(2);
      Lattice lattice = test::lattice_of({model()});
      set_constants(lattice, random);
      for (Spring& s : lattice.springs) {
        s.damping = 0.0;
        s.rest_length *= random() % 2 == 0 ? 1.0 - 1e-4 : 1.0 + 1e-4;
      }
      rebuild_active(lattice);
      EXPECT_LT(worst_relative_error(lattice), 1e-3) << lattice.objects[0].authored.name;
    }
  });
}

TEST(EdgeKernel, IsNoWorseFarFromTheOriginAndAtSpeed) {
  on_every_target([] {
    for (const auto& model : models()) {
      Lattice lattice = strained(model(), 0.1, 3);
      test::shake(lattice, 4, 0.1);
      for (PointMotion& m : lattice.motion) {
        m.position += Vec3(1e6, -7e5, 3e5);
        m.velocity += Vec3(600.0, -800.0, 5.0);
      }
      EXPECT_LT(worst_error(lattice), 1.0) << lattice.objects[0].authored.name;
    }
  });
}

// Springs of very different length in one object: the quantum is that of the longest.
TEST(EdgeKernel, ForcesAreThoseOfTheDoublePathUpToASpreadOf256) {
  on_every_target([] {
    for (double spread : {1.0, 4.0, 16.0, 64.0, 255.0}) {
      for (unsigned seed = 0; seed < 5; ++seed) {
        Lattice lattice = strained(random_graph(200, spread, seed), 0.1, seed);
        test::shake(lattice, seed, 0.01);
        EXPECT_LT(worst_error(lattice), 1.0) << "spread " << spread;
      }
    }
  });
}

TEST(EdgeKernel, LeavesLargerSpreadsToTheDoublePath) {
  for (const auto& [spread, edges] : {std::pair(255.0, 50u), {260.0, 0u}}) {
    Lattice lattice = strained(random_graph(50, spread, 1), 0.1, 1);
    SpringForces springs(lattice, SpringPrecision::kSingle);
    EXPECT_EQ(test::added_by(springs, lattice).paths.edges, edges) << spread;
  }
}

// ---- thresholds

TEST(EdgeKernel, OverstretchedEdgesAreThoseOfTheDoublePath) {
  on_every_target([] {
    for (const auto& model : models()) {
      for (unsigned seed = 0; seed < 10; ++seed) {
        Lattice lattice = strained(model(), 0.03, seed);
        std::mt19937 random(seed);
        for (Spring& s : lattice.springs) {
          const auto threshold = [&] {
            return random() % 4 > 0 ? 1e-3 * (1 + random() % 50) * s.rest_length : kUnbreakable;
          };
          s.break_threshold = threshold();
          s.crush_threshold = threshold();
        }
        rebuild_active(lattice);
        const auto expected = test::in_double(lattice).overstretched;
        EXPECT_GT(expected.size(), 0u);
        EXPECT_LT(expected.size(), lattice.springs.size());
        EXPECT_EQ(by_edges(lattice).overstretched, expected);
      }
    }
  });
}

// One edge as long as its threshold allows, times 1 + past; in the direction that it has.
std::vector<std::int32_t> overstretched_at(const PhysicalModel& model, std::size_t edge,
                                           double share, double past) {
  std::mt19937 random(edge);
  Lattice lattice = test::lattice_of({model});
  set_constants(lattice, random);
  Spring& s = lattice.springs[edge];
  const double change = share * s.rest_length;
  if (change > 0.0) s.break_threshold = change;
  if (change < 0.0) s.crush_threshold = -change;
  rebuild_active(lattice);
  Vec3& x = lattice.motion[s.b].position;
  const Vec3 n = (x - lattice.motion[s.a].position).normalized();
  x = lattice.motion[s.a].position + n * (s.rest_length + change) * (1.0 + past);
  const auto fast = by_edges(lattice).overstretched;
  EXPECT_EQ(fast, test::in_double(lattice).overstretched) << "edge " << edge;
  return fast;
}

void expect_threshold_seen(const PhysicalModel& model, std::size_t edge) {
  for (double share : {1e-4, 0.01, 0.5, 2.0, -1e-4, -0.01, -0.5, -0.9}) {
    const double past = share > 0.0 ? 1e-9 : -1e-9;
    EXPECT_THAT(overstretched_at(model, edge, share, past),
                ElementsAre(static_cast<std::int32_t>(edge)))
        << "threshold " << share;
    EXPECT_THAT(overstretched_at(model, edge, share, -past), IsEmpty()) << "threshold " << share;
  }
}

TEST(EdgeKernel, SeesAThresholdPassedByOnePartInABillion) {
  on_every_target([] {
    for (const auto& model : models()) {
      for (std::size_t edge = 3; edge < 90; edge += 29) expect_threshold_seen(model(), edge);
    }
  });
}

// The shortest spring, of which a quantum is the largest share.
TEST(EdgeKernel, SeesItAlsoInTheShortestOfManyLengths) {
  on_every_target([] {
    for (double spread : {16.0, 64.0, 255.0}) {
      for (unsigned seed = 0; seed < 20; ++seed) {
        expect_threshold_seen(random_graph(3, spread, seed), 0);
      }
    }
  });
}

// ---- removal

bool same_bits(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

TEST(EdgeKernel, SpringsThatWereRemovedAreGoneAsAfterARebuild) {
  on_every_target([] {
    for (const auto& model : models()) {
      Lattice lattice = strained(model(), 0.1, 5);
      for (Spring& s : lattice.springs) s.break_threshold = 0.01 * s.rest_length;
      rebuild_active(lattice);
      SpringForces springs(lattice, SpringPrecision::kSingle);
      const auto before = test::added_by(springs, lattice).overstretched;
      BreakingResult broken;
      break_edges(lattice.topology, lattice.breaking, before, broken);
      slacken(lattice, broken.broken_edges);
      springs.remove(broken.broken_edges);
      const test::SpringSums after = test::added_by(springs, lattice);
      EXPECT_GT(before.size(), 10u);
      EXPECT_THAT(after.overstretched, IsEmpty());
      rebuild_active(lattice);
      EXPECT_TRUE(same_bits(after.force, by_edges(lattice).force));
    }
  });
}

// ---- batches of 64 springs

// A star: every spring at point 0, which is also where the springs that fill a batch are.
Lattice star(int springs) {
  GeometricModelBuilder builder;
  builder.begin_subobject("star");
  const PointId centre = builder.add_point(Vec3::Zero());
  std::mt19937 random(6);
  for (int i = 0; i < springs; ++i) {
    const Vec3 at = kSize * test::random_vector(random, 1.0).normalized();
    builder.edge(centre, builder.add_point(at));
  }
  PhysicalModel model = test::with_plausible_attributes(builder.finish(), "star");
  for (EdgeAttributes& e : model.edges) e.break_threshold = 0.01 * kSize;
  Lattice lattice = test::lattice_of({model});
  test::shake(lattice, 7, 0.1);
  return lattice;
}

TEST(EdgeKernel, PadsBatches) {
  on_every_target([] {
    for (int springs : {1, 2, 15, 16, 17, 63, 64, 65, 127, 128, 129}) {
      SCOPED_TRACE(springs);
      Lattice lattice = star(springs);
      EXPECT_LT(worst_error(lattice), 1.0);
      EXPECT_THAT(by_edges(lattice).overstretched, IsEmpty());
      lattice.motion.back().position *= 1.02;
      EXPECT_THAT(by_edges(lattice).overstretched, ElementsAre(springs - 1));
      for (PointMotion& m : lattice.motion) m.position *= 1.02;
      std::vector<std::int32_t> all(springs);
      for (int i = 0; i < springs; ++i) all[i] = i;
      EXPECT_EQ(by_edges(lattice).overstretched, all);
    }
  });
}

// ---- one spring in the middle of others

struct OneForce {
  double exact = 0.0, fast = 0.0;  // N
};

// The only spring that pushes, at `length` of its rest length, its ends moving at up to `speed`.
OneForce force_of(const PhysicalModel& model, std::size_t edge, double stiffness, double damping,
                  double length, double speed) {
  Lattice lattice = test::lattice_of({model});
  for (Spring& s : lattice.springs) s.stiffness = s.damping = 0.0;
  Spring& s = lattice.springs[edge];
  s.stiffness = stiffness;
  s.damping = damping;
  rebuild_active(lattice);
  std::mt19937 random(edge);
  const Vec3 direction = test::random_vector(random, 1.0).normalized();
  lattice.motion[s.b].position = lattice.motion[s.a].position + length * s.rest_length * direction;
  test::shake(lattice, 8, speed);
  const auto fast = by_edges(lattice).force;
  EXPECT_EQ(fast[s.a], -fast[s.b]);
  for (std::int32_t p = 0; p < static_cast<std::int32_t>(fast.size()); ++p) {
    EXPECT_TRUE(p == s.a || p == s.b || fast[p] == Vec3::Zero()) << "point " << p;
  }
  return {test::in_double(lattice).force[s.a].norm(), fast[s.a].norm()};
}

// Springs much shorter than at rest have no direction that single precision would know: they may
// push less than they should, never more.
TEST(EdgeKernel, NearlyCoincidentPointsAreNotThrownApart) {
  on_every_target([] {
    for (const auto& model : models()) {
      for (double length : {1e-2, 1e-3, 3e-4, 1e-4, 1e-5, 1e-6, 1e-7, 1e-9, 0.0}) {
        for (std::size_t edge = 1; edge < 90; edge += 29) {
          const OneForce push = force_of(model(), edge, 300.0, 0.0, length, 0.0);
          const double wanted = 300.0 * kSize;  // coincident points: bounded
          EXPECT_LE(push.fast, 1.1 * (length > 0.0 ? push.exact : wanted)) << length;
        }
      }
    }
  });
}

TEST(EdgeKernel, NearlyCoincidentPointsAreNotDampedMoreThanTheyMove) {
  on_every_target([] {
    for (const auto& model : models()) {
      for (double length : {1e-2, 1e-3, 3e-4, 1e-4, 1e-5, 1e-6, 1e-7, 1e-9, 0.0}) {
        const OneForce pull = force_of(model(), 7, 0.0, 2.0, length, 1.0);
        // 2 sqrt(3) m/s between two points of up to 1 m/s a component
        EXPECT_LE(pull.fast, 1.1 * 2.0 * 2.0 * std::numbers::sqrt3) << length;
      }
    }
  });
}

TEST(EdgeKernel, CoincidentPointsFeelNothing) {
  on_every_target([] {
    const OneForce none = force_of(coiled_rope(), 5, 300.0, 2.0, 0.0, 0.0);
    EXPECT_EQ(none.exact, 0.0);
    EXPECT_EQ(none.fast, 0.0);
  });
}

// ---- what stops a run

void expect_stopped(Lattice lattice, double dt, const std::string& where) {
  TimeOperator time(lattice, Integrator::kSymplecticEuler, SpringPrecision::kSingle);
  try {
    for (int n = 0; n < 100; ++n) time.advance(100, dt, kEmptySpace);
    ADD_FAILURE() << "no SimulationError";
  } catch (const SimulationError& error) {
    EXPECT_THAT(error.diagnostic.where, testing::StartsWith(where));
    EXPECT_FALSE(error.diagnostic.remedy.empty());
  }
}

TEST(EdgeKernel, APointThatIsNoNumberStopsTheSimulation) {
  on_every_target([] {
    for (double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      for (std::size_t p : {0u, 20u, 90u}) {
        Lattice lattice = test::lattice_of({coiled_rope()});
        lattice.motion[p].position.y() = bad;
        expect_stopped(lattice, 1e-3, "rope: ");
        lattice.motion[p] = {Vec3::Zero(), Vec3(0.0, bad, 0.0)};
        expect_stopped(lattice, 1e-3, "rope: ");
      }
    }
  });
}

// Differences of positions wrap round at some times the longest rest length: never silently.
TEST(EdgeKernel, ASpringTornBeyondItsMeasureStopsTheSimulation) {
  on_every_target([] {
    PhysicalModel model = coiled_rope();
    for (EdgeAttributes& e : model.edges) e.break_threshold = kUnbreakable, e.stiffness = 1e-3;
    Lattice lattice = test::lattice_of({model});
    lattice.motion.back().velocity = {3.0, 0.0, 0.0};
    expect_stopped(lattice, 1e-3, "rope: edge 89");
    lattice.motion.back().velocity = {3e5, 0.0, 0.0};  // past where it wraps in one step
    expect_stopped(lattice, 1e-3, "rope: edge 89");
  });
}

}  // namespace
}  // namespace limber

#include "core/dynamics/stencil_kernel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>

#include "core/dynamics/stable_step.h"
#include "core/model/errors.h"
#include "core/modeller/box_lattice.h"
#include "core/operators/time_operator.h"
#include "tests/support/blocks.h"
#include "tests/support/instruction_sets.h"
#include "tests/support/lattices.h"
#include "tests/support/spring_sums.h"

// The kernel through SpringForces, on every instruction set that this machine has, against the
// double path.

namespace limber {
namespace {

using test::kReciprocalError;
using test::on_every_target;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAreArray;

constexpr double kSpacing = 0.013;  // m

TEST(StencilKernel, RunsOnEveryInstructionSetOfTheMachine) {
  int run = 0;
  on_every_target([&] { ++run, std::cout << "tested: " << vector_instructions() << '\n'; });
  EXPECT_GE(run, 1);
  for (std::int64_t target : {HWY_AVX3, HWY_AVX2, HWY_SSE4, HWY_SSSE3}) {
    if ((HWY_TARGETS & target) == 0) continue;
    if ((hwy::SupportedTargets() & target) == 0)
      std::cout << "skipped, not on this machine: " << hwy::TargetName(target) << '\n';
  }
}

// 64 points, 13 directions; at the origin and along the axes unless it is placed.
PhysicalModel cube(double spacing = kSpacing) {
  PhysicalModel model = test::with_plausible_attributes(
      box_lattice({3, 3, 3}, Vec3::Constant(spacing), Vec3::Zero(), "cube"), "cube");
  for (EdgeAttributes& e : model.edges) e.break_threshold = kUnbreakable;
  return model;
}

PhysicalModel turned_cube(std::mt19937& random, double spacing) {
  PhysicalModel model = cube(spacing);
  const Vec3 axis = test::random_vector(random, 1.0).normalized();
  place(model, Eigen::AngleAxisd(random() % 7, axis).toRotationMatrix(), axis);
  return model;
}

// Constants of the lattice and of the model that grids are found in.
void set_constants(Lattice& lattice, std::size_t edge, double stiffness, double damping) {
  lattice.springs[edge].stiffness = stiffness;
  lattice.springs[edge].damping = damping;
  EdgeAttributes& authored = lattice.objects[0].authored.edges[EdgeId(edge)];
  authored.stiffness = stiffness;
  authored.damping = damping;
}

void set_thresholds(Lattice& lattice, std::size_t edge, double stretch, double crush) {
  lattice.springs[edge].break_threshold = stretch;
  lattice.springs[edge].crush_threshold = crush;
  EdgeAttributes& authored = lattice.objects[0].authored.edges[EdgeId(edge)];
  authored.break_threshold = stretch;
  authored.crush_threshold = crush;
}

// A lattice in which one spring alone pushes.
class OneSpring {
 public:
  OneSpring(Lattice all, std::size_t edge, double stiffness, double damping)
      : lattice_(std::move(all)),
        exact_(lattice_, SpringPrecision::kDouble),
        fast_(lattice_, SpringPrecision::kSingle) {
    for (std::size_t e = 0; e < lattice_.springs.size(); ++e) set_constants(lattice_, e, 0.0, 0.0);
    set_constants(lattice_, edge, stiffness, damping);
    rebuild_active(lattice_);
    spring_ = lattice_.springs[edge];
    along_ = lattice_.motion[spring_.b].position - lattice_.motion[spring_.a].position;
  }

  // At another place, in the direction that it had.
  void strain(double strain, std::mt19937& random) {
    PointMotion &a = lattice_.motion[spring_.a], &b = lattice_.motion[spring_.b];
    a.position += test::random_vector(random, 0.1 * kSpacing);
    b.position = a.position + along_ * (1.0 + strain);
  }

  void move(const Vec3& base, double speed, std::mt19937& random) {
    for (PointMotion& m : lattice_.motion) m.velocity = base + test::random_vector(random, speed);
  }

  struct Forces {
    Vec3 exact, fast;  // on the first end, N
    double relative_error() const { return (fast - exact).norm() / exact.norm(); }
  };

  // Fails the test where the other end does not feel the same to the bit, or another point
  // anything.
  Forces forces() {
    const test::SpringSums fast = test::added_by(fast_, lattice_);
    EXPECT_EQ(fast.paths.grids, lattice_.active.size());
    for (std::int32_t p = 0; p < static_cast<std::int32_t>(lattice_.motion.size()); ++p) {
      const bool at_spring = p == spring_.a || p == spring_.b;
      EXPECT_TRUE(at_spring || fast.force[p] == Vec3::Zero()) << "point " << p;
    }
    EXPECT_EQ(fast.force[spring_.a], -fast.force[spring_.b]);
    return {test::added_by(exact_, lattice_).force[spring_.a], fast.force[spring_.a]};
  }

  double relative_speed() const {
    return (lattice_.motion[spring_.b].velocity - lattice_.motion[spring_.a].velocity).norm();
  }

 private:
  Lattice lattice_;
  SpringForces exact_, fast_;
  Spring spring_ = {};
  Vec3 along_;
};

// Some edges of every direction, along the axes and turned, near both ends of a power of two.
void for_springs(double stiffness, double damping,
                 const std::function<void(OneSpring&, std::mt19937&)>& test) {
  std::mt19937 random(5);
  for (double spacing : {kSpacing, 0.6 * kSpacing}) {
    for (bool turned : {false, true}) {
      const Lattice all = test::lattice_of({turned ? turned_cube(random, spacing) : cube(spacing)});
      for (std::size_t e = random() % 9; e < all.springs.size(); e += 9) {
        OneSpring one(all, e, stiffness, damping);
        test(one, random);
      }
    }
  }
}

double worst_elastic_error(double strain) {
  double worst = 0.0;
  for_springs(300.0, 0.0, [&](OneSpring& one, std::mt19937& random) {
    for (int i = 0; i < 10; ++i) {
      one.strain(i % 2 == 0 ? strain : -strain, random);
      worst = std::max(worst, one.forces().relative_error());
    }
  });
  return worst;
}

TEST(StencilKernel, ElasticForcesAreWithinAThousandthAtAStrainOfOneInTenThousand) {
  on_every_target([] { EXPECT_LT(worst_elastic_error(1e-4), 1e-3); });
}

// At small strains, what rounding of positions and squares leaves of it; at large ones,
// reciprocals.
TEST(StencilKernel, ElasticForcesAreThoseOfTheDoublePath) {
  on_every_target([] {
    EXPECT_LT(worst_elastic_error(1e-3), 1.5e-4 + kReciprocalError);
    EXPECT_LT(worst_elastic_error(1e-2), 1.5e-5 + kReciprocalError);
    EXPECT_LT(worst_elastic_error(0.3), kReciprocalError);
    EXPECT_LT(worst_elastic_error(0.9), kReciprocalError);
  });
}

TEST(StencilKernel, DampingForcesAreThoseOfTheDoublePath) {
  on_every_target([] {
    double worst = 0.0;
    for_springs(0.0, 2.0, [&](OneSpring& one, std::mt19937& random) {
      one.strain(0.05, random);
      for (double speed : {1e-3, 1.0, 100.0}) {
        one.move(Vec3::Zero(), speed, random);
        const auto [exact, fast] = one.forces();
        worst = std::max(worst, (fast - exact).norm() / (2.0 * one.relative_speed()));
      }
    });
    EXPECT_LT(worst, kReciprocalError);
  });
}

// Springs much shorter than at rest have no direction that single precision would know: they may
// push less than they should, never the other way and never more.
TEST(StencilKernel, NearlyCoincidentPointsAreNotThrownApart) {
  on_every_target([] {
    for (double length : {1e-2, 1e-3, 3e-4, 1e-4, 1e-5, 1e-6, 1e-7, 1e-9}) {
      double worst = 0.0;
      for_springs(300.0, 0.0, [&](OneSpring& one, std::mt19937& random) {
        one.strain(length - 1.0, random);
        const auto [exact, fast] = one.forces();
        worst = std::max(worst, fast.norm() / exact.norm());
      });
      EXPECT_LT(worst, 1.1) << "at " << length << " of the rest length";
    }
  });
}

TEST(StencilKernel, NearlyCoincidentPointsAreNotDampedMoreThanTheyMove) {
  on_every_target([] {
    for (double length : {1e-2, 1e-3, 3e-4, 1e-4, 1e-5, 1e-6, 1e-7, 1e-9}) {
      double worst = 0.0;
      for_springs(0.0, 2.0, [&](OneSpring& one, std::mt19937& random) {
        one.strain(length - 1.0, random);
        one.move(Vec3::Zero(), 1.0, random);
        worst = std::max(worst, one.forces().fast.norm() / (2.0 * one.relative_speed()));
      });
      EXPECT_LT(worst, 1.1) << "at " << length << " of the rest length";
    }
  });
}

// ---------------------------------------------------------------------------------------------

double worst_sum_error(const Lattice& lattice) {
  return test::worst_error(test::in_single(lattice).force, test::in_double(lattice).force,
                           test::force_scales(lattice));
}

// Points off their places by `share` of the spacing.
Lattice strained(double share, unsigned seed) {
  std::mt19937 random(seed);
  Lattice lattice = test::lattice_of({turned_cube(random, kSpacing)});
  for (std::size_t e = 0; e < lattice.springs.size(); ++e)
    set_constants(lattice, e, 100.0 * (1 + e % 5), 0.1 * (e % 3));
  rebuild_active(lattice);
  for (PointMotion& m : lattice.motion) m.position += test::random_vector(random, share * kSpacing);
  return lattice;
}

TEST(StencilKernel, SumsAreThoseOfTheDoublePath) {
  on_every_target([] {
    for (unsigned seed = 0; seed < 10; ++seed) {
      EXPECT_LT(worst_sum_error(strained(1e-3, seed)), kReciprocalError + 3e-4);
      Lattice lattice = strained(0.1, seed);
      test::shake(lattice, seed, 1.0);
      EXPECT_LT(worst_sum_error(lattice), kReciprocalError);
    }
  });
}

// Both paths see the positions that double precision has left of it: 1e-10 m, a strain of 1e-8.
TEST(StencilKernel, IsNoWorseFarFromTheOriginAndAtSpeed) {
  on_every_target([] {
    for (unsigned seed = 0; seed < 10; ++seed) {
      Lattice lattice = strained(0.01, seed);
      test::shake(lattice, seed, 0.1);
      const double near = worst_sum_error(lattice);
      for (PointMotion& m : lattice.motion) {
        m.position += Vec3(1e6, -7e5, 3e5);
        m.velocity += Vec3(600.0, -800.0, 5.0);
      }
      EXPECT_LT(near, kReciprocalError);
      EXPECT_LT(worst_sum_error(lattice), kReciprocalError);
    }
  });
}

void expect_same_as_double(const Lattice& lattice) {
  EXPECT_LT(worst_sum_error(lattice), kReciprocalError);
  EXPECT_EQ(test::in_single(lattice).overstretched, test::in_double(lattice).overstretched);
}

TEST(StencilKernel, CollapsedLatticesPushAsInTheDoublePath) {
  const auto collapsed = [](const Vec3& scale) {
    Lattice lattice = test::lattice_of({cube()});
    for (PointMotion& m : lattice.motion) m.position = m.position.cwiseProduct(scale);
    test::shake(lattice, 3, 1.0);
    return lattice;
  };
  on_every_target([&] {
    expect_same_as_double(collapsed({0.0, 0.0, 0.0}));    // coincident points
    expect_same_as_double(collapsed({1.0, 1.0, 0.0}));    // no volume
    expect_same_as_double(collapsed({-1.0, 1.0, 1.0}));   // inside out
    expect_same_as_double(collapsed({10.0, 0.1, -0.5}));  // drawn out
  });
}

TEST(StencilKernel, ACornerPushedThroughItsCellPushesAsInTheDoublePath) {
  on_every_target([] {
    Lattice lattice = strained(0.01, 4);
    std::mt19937 random(1);
    for (int i = 0; i < 6; ++i) {
      const std::size_t p = random() % 64;
      lattice.motion[p].position += test::random_vector(random, 3.0 * kSpacing);
    }
    expect_same_as_double(lattice);
  });
}

// ---------------------------------------------------------------------------------------------

void set_random_thresholds(Lattice& lattice, std::mt19937& random, bool stretch, bool crush) {
  for (std::size_t e = 0; e < lattice.springs.size(); ++e) {
    const auto threshold = [&](bool wanted) {
      return wanted && random() % 4 > 0 ? 1e-3 * (1 + random() % 100) * kSpacing : kUnbreakable;
    };
    const double longer = threshold(stretch);
    set_thresholds(lattice, e, longer, threshold(crush));
  }
  rebuild_active(lattice);
}

TEST(StencilKernel, OverstretchedEdgesAreThoseOfTheDoublePath) {
  on_every_target([] {
    for (const auto& [stretch, crush] : {std::pair(true, false), {false, true}, {true, true}}) {
      for (unsigned seed = 0; seed < 10; ++seed) {
        Lattice lattice = strained(0.03, seed);
        std::mt19937 random(seed);
        set_random_thresholds(lattice, random, stretch, crush);
        const auto expected = test::in_double(lattice).overstretched;
        EXPECT_GT(expected.size(), 0u);
        EXPECT_LT(expected.size(), lattice.springs.size());
        EXPECT_EQ(test::in_single(lattice).overstretched, expected);
      }
    }
  });
}

// The edge as long as its threshold allows, times 1 + past.
std::vector<std::int32_t> overstretched_at(double threshold_share, double past, std::size_t edge,
                                           unsigned seed) {
  Lattice lattice = strained(0.0, seed);
  Spring& s = lattice.springs[edge];
  const double change = threshold_share * s.rest_length;
  set_thresholds(lattice, edge, change > 0.0 ? change : kUnbreakable,
                 change < 0.0 ? -change : kUnbreakable);
  rebuild_active(lattice);
  Vec3& x = lattice.motion[s.b].position;
  const Vec3 n = (x - lattice.motion[s.a].position).normalized();
  x = lattice.motion[s.a].position + n * (s.rest_length + change) * (1.0 + past);
  const auto fast = test::in_single(lattice).overstretched;
  EXPECT_EQ(fast, test::in_double(lattice).overstretched);
  return fast;
}

TEST(StencilKernel, SeesAThresholdPassedByOnePartInABillion) {
  on_every_target([] {
    for (double share : {1e-4, 0.01, 0.5, 4.0, -1e-4, -0.01, -0.5, -0.9}) {
      for (unsigned seed = 0; seed < 8; ++seed) {
        const std::size_t edge = 17 * seed + 3;
        const double past = share > 0.0 ? 1e-9 : -1e-9;
        EXPECT_THAT(overstretched_at(share, past, edge, seed),
                    ElementsAre(static_cast<std::int32_t>(edge)));
        EXPECT_THAT(overstretched_at(share, -past, edge, seed), IsEmpty());
      }
    }
  });
}

// ---------------------------------------------------------------------------------------------

void expect_stopped(Lattice lattice, double dt, SpringPrecision precision) {
  TimeOperator time(lattice, Integrator::kSymplecticEuler, precision);
  try {
    for (int n = 0; n < 100; ++n) time.advance(100, dt, kEmptySpace);
    ADD_FAILURE() << "no SimulationError";
  } catch (const SimulationError& error) {
    EXPECT_THAT(error.diagnostic.where, testing::MatchesRegex("cube: (point|edge) .*"));
  }
}

TEST(StencilKernel, APointThatIsNoNumberStopsTheSimulation) {
  on_every_target([] {
    for (double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      for (std::size_t p : {0u, 21u, 63u}) {
        Lattice lattice = test::lattice_of({cube()});
        lattice.motion[p].position.y() = bad;
        expect_stopped(lattice, 1e-3, SpringPrecision::kSingle);
        lattice.motion[p] = {Vec3::Zero(), Vec3(0.0, bad, 0.0)};
        expect_stopped(lattice, 1e-3, SpringPrecision::kSingle);
      }
    }
  });
}

// As in double precision: an unstable step ends in what is not finite, and that is reported.
TEST(StencilKernel, ABlowUpStopsTheSimulation) {
  on_every_target([] {
    PhysicalModel undamped = cube();
    for (EdgeAttributes& e : undamped.edges) e.damping = 0.0;
    Lattice lattice = test::lattice_of({undamped});
    test::shake(lattice, 9, 0.1);
    const double limit = 2.0 / highest_frequency(undamped).omega_max;
    expect_stopped(lattice, 1.3 * limit, SpringPrecision::kDouble);
    expect_stopped(lattice, 1.3 * limit, SpringPrecision::kSingle);
  });
}

}  // namespace
}  // namespace limber

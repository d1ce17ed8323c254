#include "core/environment/flow_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "tests/support/lattices.h"

namespace limber {
namespace {

using std::numbers::pi;
using test::random_vector;

constexpr FlowKind kWithPole[] = {FlowKind::kLineSource, FlowKind::kPointSource,
                                  FlowKind::kLineVortex, FlowKind::kLineDoublet,
                                  FlowKind::kPointDoublet};

FlowPrimitive primitive(FlowKind kind, double strength, const Vec3& position = Vec3::Zero()) {
  FlowPrimitive flow;
  flow.kind = kind;
  flow.strength = strength;
  flow.position = position;
  return flow;
}

void expect_near(const Vec3& found, const Vec3& wanted, double tolerance) {
  EXPECT_LE((found - wanted).norm(), tolerance)
      << found.transpose() << " instead of " << wanted.transpose();
}

// ---- against numbers computed elsewhere --------------------------------------------------------

struct Sample {
  Vec3 at, velocity;
};

void expect_samples(const FlowField& field, const std::vector<Sample>& samples) {
  for (const Sample& s : samples) {
    expect_near(flow_velocity(field, s.at, 0.0), s.velocity, 1e-12 * s.velocity.norm());
  }
}

TEST(FlowField, OfALineSinkAndAVortexInAStreamHasTheReferenceVelocities) {
  FlowField field{{uniform_flow({1, 0, 0}), primitive(FlowKind::kLineSource, -3.0, {0.1, -0.2, 0}),
                   primitive(FlowKind::kLineVortex, 2.0, {0.1, 0.2, 0.3})}};
  field.primitives[1].axis = {0, 1, 1};
  field.primitives[2].axis = {1, 1, 1};
  expect_samples(
      field, {{{1, 0, 0}, {0.46154040238880295, 0.19119391940065786, -0.1704672691968311}},
              {{0, 1, 0.5}, {0.9247035402714046, -0.7866126679438055, 1.0491502371922774}},
              {{-1.2, 0.7, 2}, {1.318821564226529, -0.00648033703795374, -0.04188184677097559}},
              {{0.3, -0.4, -1}, {0.620561221041539, -0.2858438902473369, 0.40002443071930605}},
              {{2.5, 2.0, 0.1}, {0.7569712516113813, 0.06596520239928942, 0.03319467087801132}}});
}

TEST(FlowField, OfAPointSourceAndSinkHasTheReferenceVelocities) {
  const FlowField field{{primitive(FlowKind::kPointSource, 8.0),
                         primitive(FlowKind::kPointSource, -6.0, {0.5, 0.1, 0})}};
  expect_samples(
      field, {{{1, 0, 0}, {-1.1641217080547341, 0.3601482960844631, 0.0}},
              {{0, 1, 0.5}, {0.15922250314928885, 0.1689275221182734, 0.0685415107442078}},
              {{-1.2, 0.7, 2}, {-0.011322995308719365, 0.01618476029371814, 0.039253956075451096}},
              {{0.3, -0.4, -1}, {0.20183427526235956, -0.01927154379914342, -0.1296486931556855}}});
}

TEST(FlowField, OfALineDoubletInAStreamHasTheReferenceVelocities) {
  const FlowField field{{uniform_flow({2, 0, 0}), primitive(FlowKind::kLineDoublet, -pi)}};
  expect_samples(field, {{{1, 0, 0}, {1.5, 0, 0}},
                         {{0, 1, 0.5}, {2.5, 0, 0}},
                         {{-1.2, 0.7, 2}, {1.8724797981153856, 0.22550940964858118, 0}},
                         {{0.3, -0.4, -1}, {2.56, 1.92, 0}},
                         {{2.5, 2.0, 0.1}, {1.9892920880428318, -0.04759071980963712, 0}}});
}

// Stream U and line source Q: stagnation at -Q / (2 pi U); on the dividing streamline beside the
// source, at y = Q / (4 U), the speed is U sqrt(1 + 4 / pi^2) (Rankine's half body).
TEST(FlowField, OfAStreamAndASourceIsRankinesHalfBody) {
  constexpr double U = 2.0, Q = 5.0;
  const FlowField field{{uniform_flow({U, 0, 0}), primitive(FlowKind::kLineSource, Q)}};
  expect_near(flow_velocity(field, {-Q / (2.0 * pi * U), 0, 0}, 0.0), Vec3::Zero(), 2e-15);
  for (double side : {-1.0, 1.0}) {
    const double speed = flow_velocity(field, {0, side * Q / (4.0 * U), 3.0}, 0.0).norm();
    EXPECT_NEAR(speed, U * std::sqrt(1.0 + 4.0 / (pi * pi)), 1e-15 * U);
  }
}

// u - i v of plane flow with z = x + i y: source Q / (2 pi z), vortex -i Gamma / (2 pi z), doublet
// of moment K at the angle alpha to x: K exp(i alpha) / (2 pi z^2).
TEST(FlowField, AcrossALineIsTheComplexVelocity) {
  using Complex = std::complex<double>;
  const Complex i(0.0, 1.0);
  constexpr double alpha = 0.7;
  FlowPrimitive doublet = primitive(FlowKind::kLineDoublet, 1.3);
  doublet.direction = 4.0 * Vec3(std::cos(alpha), std::sin(alpha), 0.0);
  const FlowField field{
      {primitive(FlowKind::kLineSource, -0.8), primitive(FlowKind::kLineVortex, 2.5), doublet}};
  std::mt19937 random(1);
  for (int n = 0; n < 100; ++n) {
    const Vec3 at = random_vector(random, 2.0);
    const Complex z(at.x(), at.y());
    if (std::abs(z) < 0.1) continue;
    const Complex w =
        (-0.8 - i * 2.5) / (2.0 * pi * z) + 1.3 * std::exp(i * alpha) / (2.0 * pi * z * z);
    expect_near(flow_velocity(field, at, 0.0), {w.real(), -w.imag(), 0.0}, 1e-14 * std::abs(w));
  }
}

// ---- what each primitive is defined by ---------------------------------------------------------

// Source and sink h apart, strength 1/h: differs from the limit by (h/r)^2 / 24 times a number of
// the order of one.
void expect_limit_of_a_pair(FlowKind doublet_kind, FlowKind source_kind) {
  constexpr double h = 1e-3;
  FlowPrimitive doublet = primitive(doublet_kind, 1.0);
  doublet.direction = {1, 2, -2};
  const Vec3 half = 0.5 * h * doublet.direction.normalized();
  const FlowField pair{
      {primitive(source_kind, 1.0 / h, half), primitive(source_kind, -1.0 / h, -half)}};
  for (const Vec3& at : {Vec3(1, 0, 0), Vec3(-0.5, 0.7, 0.3), Vec3(0.2, -0.9, 1.0)}) {
    const Vec3 wanted = flow_velocity(doublet, at, 0.0);
    expect_near(flow_velocity(pair, at, 0.0), wanted, 1e-6 * wanted.norm());
  }
}

// The direction has a part along the line's axis, which must not count.
TEST(FlowField, DoubletsAreTheLimitOfASourceAndASink) {
  expect_limit_of_a_pair(FlowKind::kLineDoublet, FlowKind::kLineSource);
  expect_limit_of_a_pair(FlowKind::kPointDoublet, FlowKind::kPointSource);
}

// Central differences, m/s per m.
Mat3 gradient(const FlowPrimitive& flow, const Vec3& at) {
  constexpr double h = 1e-4;
  Mat3 g;
  for (int j = 0; j < 3; ++j) {
    const Vec3 d = h * Vec3::Unit(j);
    g.col(j) = (flow_velocity(flow, at + d, 0.0) - flow_velocity(flow, at - d, 0.0)) / (2.0 * h);
  }
  return g;
}

TEST(FlowField, HasNeitherDivergenceNorCurlOutsideOfTheCores) {
  std::mt19937 random(2);
  for (FlowKind kind : kWithPole) {
    FlowPrimitive flow = primitive(kind, 3.0);
    flow.axis = random_vector(random, 1.0);
    flow.direction = random_vector(random, 1.0);
    for (int n = 0; n < 20; ++n) {
      Vec3 at = random_vector(random, 1.0);
      at += flow.axis.unitOrthogonal() * (at.dot(flow.axis.unitOrthogonal()) > 0.0 ? 1.0 : -1.0);
      const Mat3 g = gradient(flow, at);  // at least 1 m from the axis
      EXPECT_NEAR(g.trace(), 0.0, 1e-6);
      EXPECT_LE((g - g.transpose()).norm(), 1e-6);
    }
  }
}

// Mean over a circle of radius r about `centre` across the z axis of the velocity along the
// outward normal (x) and along the circle (y), times its length. The trapezoidal rule converges
// exponentially here.
Eigen::Vector2d flux_and_circulation(const FlowPrimitive& flow, const Vec3& centre, double r) {
  constexpr int kPoints = 200;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2.0 * pi * i / kPoints;
    const Vec3 n(std::cos(angle), std::sin(angle), 0.0);
    const Vec3 v = flow_velocity(flow, centre + r * n, 0.0);
    sum += Eigen::Vector2d(v.dot(n), v.dot(Vec3::UnitZ().cross(n)));
  }
  return sum * (2.0 * pi * r / kPoints);
}

TEST(FlowField, LinesEmitAndCirculateTheirStrength) {
  for (const Vec3& off_centre : {Vec3(0, 0, 0), Vec3(0.3, -0.4, 7.0)}) {
    const auto source =
        flux_and_circulation(primitive(FlowKind::kLineSource, -3.0), off_centre, 1.0);
    EXPECT_NEAR(source.x(), -3.0, 1e-13);
    EXPECT_NEAR(source.y(), 0.0, 1e-13);
    const auto vortex =
        flux_and_circulation(primitive(FlowKind::kLineVortex, 2.0), off_centre, 1.0);
    EXPECT_NEAR(vortex.x(), 0.0, 1e-13);
    EXPECT_NEAR(vortex.y(), 2.0, 1e-13);
  }
}

// The flow integrated with RK4 follows r^2 - r0^2 = Q t / pi.
TEST(FlowField, CarriesATracerAwayFromALineSource) {
  const FlowPrimitive flow = primitive(FlowKind::kLineSource, 2.0);
  const auto v = [&](const Vec3& x) { return flow_velocity(flow, x, 0.0); };
  constexpr int kSteps = 2000;
  constexpr double dt = 10.0 / kSteps;
  Vec3 x(1, 0, 0);
  for (int n = 0; n < kSteps; ++n) {
    const Vec3 k1 = v(x), k2 = v(x + 0.5 * dt * k1), k3 = v(x + 0.5 * dt * k2), k4 = v(x + dt * k3);
    x += dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  expect_near(x, {std::sqrt(1.0 + 2.0 * 10.0 / pi), 0, 0}, 1e-11);
}

// ---- the core ----------------------------------------------------------------------------------

TEST(FlowField, DoesNotDependOnTheCoreOutsideOfIt) {
  std::mt19937 random(3);
  for (FlowKind kind : kWithPole) {
    FlowPrimitive thin = primitive(kind, 2.0), thick = thin;
    thin.core_radius = 1e-6;
    thick.core_radius = 0.5;
    for (int n = 0; n < 20; ++n) {
      Vec3 at = random_vector(random, 3.0);
      at.x() = std::copysign(0.5 + std::abs(at.x()), at.x());
      EXPECT_EQ(flow_velocity(thin, at, 0.0), flow_velocity(thick, at, 0.0));
    }
    EXPECT_EQ(flow_velocity(thick, Vec3::Zero(), 0.0), Vec3::Zero());
  }
}

// Twice as far from the centre: twice the velocity of a source or vortex, four times a doublet's.
TEST(FlowField, FallsToZeroInTheCoreWithoutAKink) {
  const Vec3 near(3e-6, -2e-6, 1e-6);
  for (FlowKind kind : kWithPole) {
    const FlowPrimitive flow = primitive(kind, 2.0);
    const bool is_doublet = kind == FlowKind::kLineDoublet || kind == FlowKind::kPointDoublet;
    const Vec3 wanted = (is_doublet ? 4.0 : 2.0) * flow_velocity(flow, near, 0.0);
    expect_near(flow_velocity(flow, 2.0 * near, 0.0), wanted, 1e-6 * wanted.norm());
    EXPECT_GT(wanted.norm(), 0.0);
  }
}

// A density proportional to 1 - s^2: within s there is 2 s^2 - s^4 of all.
TEST(FlowField, SpreadsASourceOverTheCoreWithAFallingDensity) {
  FlowPrimitive flow = primitive(FlowKind::kLineSource, 3.0);
  flow.core_radius = 0.4;
  for (double s : {0.1, 0.5, 0.9}) {
    const double inside = 3.0 * (2.0 * s * s - s * s * s * s);
    EXPECT_NEAR(flux_and_circulation(flow, Vec3::Zero(), s * 0.4).x(), inside, 1e-13);
  }
}

// ---- bounds and animation ----------------------------------------------------------------------

TEST(FlowBounds, FadeSmoothlyFromAllToNothing) {
  const FlowBounds bounds{.centre = {1, 2, 3}, .radius = 2.0, .fade = 0.5};
  const auto share = [&](double distance) {
    return share_within(bounds, bounds.centre + distance * Vec3(2, -1, 2) / 3.0);
  };
  EXPECT_EQ(share(0.0), 1.0);
  EXPECT_EQ(share(1.99), 1.0);
  EXPECT_NEAR(share(2.125), 1.0 - (3.0 / 16.0 - 2.0 / 64.0), 1e-14);  // smoothstep of 1/4
  EXPECT_NEAR(share(2.25), 0.5, 1e-14);
  EXPECT_EQ(share(2.51), 0.0);
  constexpr double h = 1e-6;  // the slope vanishes at both ends: share - 1 = 3 (h / fade)^2
  EXPECT_NEAR(share(2.0 + h), 1.0, 2e-11);
  EXPECT_NEAR(share(2.5 - h), 0.0, 2e-11);
}

TEST(FlowBounds, WithoutFadeEndAtOnce) {
  FlowPrimitive flow = uniform_flow({0, 3, 4});
  flow.bounds = {.centre = Vec3::Zero(), .radius = 1.0, .fade = 0.0};
  expect_near(flow_velocity(flow, {0.999, 0, 0}, 0.0), {0, 3, 4}, 1e-15);
  EXPECT_EQ(flow_velocity(flow, {1.001, 0, 0}, 0.0), Vec3::Zero());
}

// A vortex that travels takes its flow with it; one that grows grows everywhere.
TEST(FlowField, FollowsTheTracksOfItsPrimitives) {
  const Vec3 to(4, -2, 1), at(0.3, 0.5, -0.2);
  FlowPrimitive flow = primitive(FlowKind::kLineVortex, 2.0);
  const Vec3 still = flow_velocity(flow, at, 0.0);
  flow.position = Track<Vec3>({{0.0, Vec3::Zero()}, {2.0, to}});
  flow.strength = Track<double>({{0.0, 2.0}, {1.0, 6.0}});
  expect_near(flow_velocity(flow, at + 0.25 * to, 0.5), 2.0 * still, 1e-14);
  expect_near(flow_velocity(flow, at + to, 9.0), 3.0 * still, 1e-14);
}

TEST(UniformFlow, IsTheVelocityItWasMadeFrom) {
  expect_near(flow_velocity(uniform_flow({3, -1, 0.5}), {5, 6, 7}, 1.0), {3, -1, 0.5}, 1e-15);
  EXPECT_EQ(flow_velocity(uniform_flow(Vec3::Zero()), {5, 6, 7}, 1.0), Vec3::Zero());
  EXPECT_EQ(flow_velocity(FlowField{}, {5, 6, 7}, 1.0), Vec3::Zero());
}

}  // namespace
}  // namespace limber

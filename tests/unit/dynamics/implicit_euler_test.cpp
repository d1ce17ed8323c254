// One step of ImplicitEuler: against the equation it solves, and what it refuses.

#include "core/dynamics/implicit_euler.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cstring>
#include <limits>

#include "core/model/errors.h"
#include "tests/support/blocks.h"
#include "tests/support/implicit_run.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

// Damped, pinned at one end, stretched all along, in motion.
Lattice hanging_chain() {
  PhysicalModel model = test::chain({.points = 5, .stiffness = 2e4});
  model.points[PointId(0)].pinned = true;
  for (EdgeAttributes& e : model.edges) e.rest_length = 0.8, e.damping = 30.0;
  Lattice lattice = test::lattice_of({model});
  test::shake(lattice, 5, 1.0);
  lattice.motion[0].velocity.setZero();
  return lattice;
}

// dF/dx and dF/dv of all points, by central differences of their definition.
Eigen::MatrixXd jacobian(Lattice lattice, Vec3 PointMotion::*of) {
  constexpr double kStep = 1e-6;
  const Eigen::Index size = 3 * static_cast<Eigen::Index>(lattice.motion.size());
  Eigen::MatrixXd matrix(size, size);
  const auto forces = [&] {
    test::take_forces(lattice);
    return Eigen::VectorXd(Eigen::Map<Eigen::VectorXd>(lattice.force[0].data(), size));
  };
  for (Eigen::Index i = 0; i < size; ++i) {
    double& x = (lattice.motion[i / 3].*of)[i % 3];
    const double before = x;
    x = before + kStep;
    const Eigen::VectorXd forward = forces();
    x = before - kStep;
    matrix.col(i) = (forward - forces()) / (2.0 * kStep);
    x = before;
  }
  return matrix;
}

// (M - dt D - dt^2 K) dv = dt (F + dt K v), with K of the springs alone: how dampers turn is no
// part of it (Baraff and Witkin 1998).
TEST(ImplicitEuler, OfOneIterationSolvesTheLinearisedEquation) {
  constexpr double kDt = 1.0 / 60;
  Lattice lattice = hanging_chain();
  Lattice undamped = lattice;
  for (Spring& s : undamped.active) s.damping = 0.0;
  const Eigen::Index size = 12;  // without the pinned point
  const Eigen::MatrixXd k =
      jacobian(undamped, &PointMotion::position).bottomRightCorner(size, size);
  const Eigen::MatrixXd d = jacobian(lattice, &PointMotion::velocity).bottomRightCorner(size, size);
  test::take_forces(lattice, {0.0, -9.8, 0.0});
  Eigen::VectorXd f(size), v(size);
  for (int p = 1; p < 5; ++p) {
    f.segment<3>(3 * p - 3) = lattice.force[p];
    v.segment<3>(3 * p - 3) = lattice.motion[p].velocity;
  }
  const Eigen::MatrixXd a = Eigen::MatrixXd::Identity(size, size) - kDt * d - kDt * kDt * k;
  const Eigen::VectorXd wanted = v + a.partialPivLu().solve(kDt * (f + kDt * k * v));
  ImplicitEuler(test::kTextbook).step(lattice, lattice.dynamic_points, kDt);
  for (int p = 1; p < 5; ++p) {
    EXPECT_LT((lattice.motion[p].velocity - wanted.segment<3>(3 * p - 3)).norm(), 1e-7);
  }
}

// m dv = dt (F - k dt v1 - d (v1 - v0)) along the normal, m dv = dt F across it.
TEST(ImplicitEuler, LetsASupportPushBack) {
  constexpr double kDt = 0.1, kStiffness = 1e5, kDamping = 50.0;
  Lattice lattice = test::lattice_of({test::chain({.points = 2, .stiffness = 0.0})});
  lattice.motion[0].velocity = {3.0, -2.0, 0.0};
  test::take_forces(lattice, {0.0, -9.8, 1.0});
  const PointSupport support{0, Vec3::UnitY(), kStiffness, kDamping};
  ImplicitEuler().step(lattice, lattice.dynamic_points, kDt, std::span(&support, 1));
  const double y = -2.0 + kDt * (-9.8 + kStiffness * kDt * 2.0) /
                              (1.0 + kDt * kDamping + kDt * kDt * kStiffness);
  EXPECT_LT((lattice.motion[0].velocity - Vec3(3.0, y, 0.1)).norm(), 1e-12);
  EXPECT_LT((lattice.motion[1].velocity - Vec3(0.0, -0.98, 0.1)).norm(), 1e-12);
}

TEST(ImplicitEuler, NeedsOneIterationForWhatMovesAsARigidBody) {
  PhysicalModel model = test::block({.cells = {3, 3, 3}});
  for (EdgeAttributes& e : model.edges) e.stiffness = 1e12, e.damping = 0.0;
  set_in_motion(model, {300.0, 0.0, 0.0}, {0.0, 3.0, 1.0});
  Lattice lattice = test::lattice_of({model});
  test::take_forces(lattice);
  const ImplicitReport report = ImplicitEuler().step(lattice, lattice.dynamic_points, 1.0 / 60);
  EXPECT_EQ(report.newton_iterations, 1);
  EXPECT_EQ(report.parts, 1);
  EXPECT_TRUE(report.converged);
}

TEST(ImplicitEuler, TakesAStepInPartsWhereItHasTo) {
  Lattice lattice = test::lattice_of({test::block({.cells = {2, 2, 3}})});
  for (Spring& s : lattice.active) s.stiffness = 1.0, s.damping = 0.0;
  test::shake(lattice, 3, 1000.0);  // 17 spacings a step
  test::take_forces(lattice);
  const ImplicitReport report = ImplicitEuler().step(lattice, lattice.dynamic_points, 1.0 / 60);
  EXPECT_GT(report.parts, 1);
  EXPECT_TRUE(report.converged);
}

TEST(ImplicitEuler, ForgetsSpringsThatBroke) {
  Lattice lattice = test::lattice_of({test::chain({.points = 3, .stiffness = 1e9})});
  lattice.motion[2].velocity = {1.0, 0.0, 0.0};
  ImplicitEuler euler;
  test::take_forces(lattice);
  euler.step(lattice, lattice.dynamic_points, 0.01);
  EXPECT_NEAR(lattice.motion[0].velocity.x(), 1.0 / 3.0, 1e-4);
  lattice.breaking.edge_broken[1] = true;
  rebuild_active(lattice);
  euler.topology_changed();
  lattice.motion[2].velocity = {5.0, 0.0, 0.0};
  test::take_forces(lattice);
  euler.step(lattice, lattice.dynamic_points, 0.01);
  EXPECT_DOUBLE_EQ(lattice.motion[2].velocity.x(), 5.0);
}

TEST(ImplicitEuler, RepeatsItselfToTheBit) {
  for (std::array<int, 3> cells : {std::array{1, 1, 12}, std::array{6, 6, 6}}) {
    Lattice first = test::lattice_of({test::uneven_block(cells)});
    test::shake(first, 9, 2.0);
    Lattice second = first;
    const ImplicitReport report = test::run_implicit(first, 10, 0.05);
    test::run_implicit(second, 10, 0.05);
    EXPECT_EQ(report.solver_iterations > 0, cells[0] == 6) << "both solvers are meant";
    EXPECT_EQ(std::memcmp(first.motion.data(), second.motion.data(),
                          first.motion.size() * sizeof(PointMotion)),
              0);
  }
}

std::string message_of(Lattice& lattice, const ImplicitSettings& settings) {
  test::take_forces(lattice);
  try {
    ImplicitEuler(settings).step(lattice, lattice.dynamic_points, 0.05);
  } catch (const SimulationError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ImplicitEuler, NamesABodyItCannotSolveFor) {
  PhysicalModel model = test::block({.cells = {6, 6, 6}});
  model.name = "jelly";
  Lattice lattice = test::lattice_of({model});
  test::shake(lattice, 3, 1.0);
  EXPECT_THAT(
      message_of(lattice, {.most_solver_iterations = 2}),
      testing::StartsWith("jelly: its implicit step has no solution within 2 iterations; "));
}

TEST(ImplicitEuler, RefusesWhatIsNotFinite) {
  for (double bad : {std::numeric_limits<double>::quiet_NaN(), 1e200, 1e308}) {
    Lattice lattice = hanging_chain();
    lattice.motion[2].velocity.x() = bad;
    EXPECT_THAT(message_of(lattice, {}), testing::StartsWith("chain: ")) << bad;
  }
}

}  // namespace
}  // namespace limber

// The matrix of the implicit step against differences of its forces, and its two solvers against
// each other and a dense one.

#include "core/dynamics/implicit_system.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/dynamics/factorised_solver.h"
#include "core/dynamics/implicit_forces.h"
#include "core/dynamics/implicit_momenta.h"
#include "core/dynamics/implicit_solver.h"
#include "tests/support/blocks.h"
#include "tests/support/implicit_run.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

constexpr double kDt = 0.02;

// Force of a step's spring on its end a when b is at d.
Vec3 pull(const StepSpring& spring, const Vec3& d) {
  return spring.tension(d.norm()) * d / d.norm();
}

Mat3 matrix(const LinkTangent& t) {
  const Vec3& n = t.direction;
  return t.across * Mat3::Identity() + (t.along - t.across) * n * n.transpose();
}

TEST(LinkTangent, IsTheDerivativeOfTheForceUnderTension) {
  constexpr double kStep = 1e-6;
  const StepSpring spring{100.0, 1.5, 40.0, 1.7};
  const Vec3 d(1.0, -2.0, 0.5);
  Mat3 difference;
  for (int i = 0; i < 3; ++i) {
    const Vec3 e = kStep * Vec3::Unit(i);
    difference.col(i) = (pull(spring, d + e) - pull(spring, d - e)) / (2.0 * kStep);
  }
  EXPECT_LT((matrix(link_tangent(spring, d)) - difference).norm(), 1e-7);
}

// The exact one of a spring under pressure has 100 (1 - 3 / 2) = -50 N/m across.
TEST(LinkTangent, LeavesPressureOut) {
  const Mat3 found = matrix(link_tangent({100.0, 3.0, 0.0, 0.0}, {2.0, 0.0, 0.0}));
  EXPECT_EQ(found, Mat3(Vec3(100.0, 0.0, 0.0).asDiagonal()));
}

TEST(LinkTangent, OfCoincidentPointsIsThatOfTheirForce) {
  EXPECT_EQ(matrix(link_tangent({100.0, 1.0, 30.0, 1.0}, Vec3::Zero())), Mat3::Zero());
  EXPECT_EQ(matrix(link_tangent({100.0, 0.0, 30.0, 0.0}, Vec3::Zero())), 100.0 * Mat3::Identity());
}

// A block with one pinned point, all springs stretched, one point on a support.
struct Stretched {
  Lattice lattice;
  ImplicitSystem system;
  std::vector<PointSupport> supports{{2, Vec3(0.6, 0.8, 0.0), 300.0, 7.0}};

  Stretched() {
    PhysicalModel model = test::uneven_block({2, 1, 1});
    for (EdgeAttributes& e : model.edges) e.rest_length *= 0.6;
    model.points[PointId(3)].pinned = true;
    lattice = test::lattice_of({model});
    test::shake(lattice, 3, 0.5);
    lattice.motion[3].velocity.setZero();
    test::take_forces(lattice, {0.0, -9.8, 0.0});
    system.rebuild(lattice, lattice.dynamic_points);
  }
  ImplicitForces started() const {
    ImplicitForces forces(lattice, system, supports);
    forces.start_step(lattice, kDt);
    return forces;
  }
  // Velocities v of the rows, positions x0 + dt v.
  void set_end(const ImplicitForces& forces, const Eigen::VectorXd& v) {
    for (std::size_t row = 0; row < forces.start().size(); ++row) {
      PointMotion& motion = lattice.motion[system.points()[row]];
      motion.velocity = v.segment<3>(3 * row);
      motion.position = forces.start()[row].position + kDt * motion.velocity;
    }
  }
  Eigen::VectorXd velocities() const {
    Eigen::VectorXd v(system.size());
    for (std::size_t row = 0; row < system.points().size(); ++row) {
      v.segment<3>(3 * row) = lattice.motion[system.points()[row]].velocity;
    }
    return v;
  }
};

Eigen::MatrixXd dense(const ImplicitSystem& system) {
  Eigen::MatrixXd matrix(system.size(), system.size());
  Eigen::VectorXd column;
  for (Eigen::Index i = 0; i < system.size(); ++i) {
    system.multiply(Eigen::VectorXd::Unit(system.size(), i), column);
    matrix.col(i) = column;
  }
  return matrix;
}

TEST(ImplicitSystem, IsTheDerivativeOfWhatRemains) {
  constexpr double kStep = 1e-5;  // m/s
  Stretched s;
  const ImplicitForces forces = s.started();
  const Eigen::VectorXd end = 1.1 * s.velocities();
  s.set_end(forces, end);
  s.system.linearise(s.lattice, kDt, forces.start_lengths(), s.supports);
  const Eigen::MatrixXd found = dense(s.system);
  for (Eigen::Index i = 0; i < end.size(); ++i) {
    const Eigen::VectorXd e = kStep * Eigen::VectorXd::Unit(end.size(), i);
    s.set_end(forces, end + e);
    const Eigen::VectorXd forward = forces.remaining_impulse(s.lattice);
    s.set_end(forces, end - e);
    const Eigen::VectorXd backward = forces.remaining_impulse(s.lattice);
    const Eigen::VectorXd difference = (backward - forward) / (2.0 * kStep);
    EXPECT_LT((found.col(i) - difference).norm(), 1e-8 * found.norm()) << "row " << i;
  }
}

TEST(ImplicitForces, RemainAsTheSlopeOfTheMerit) {
  constexpr double kStep = 1e-5;
  Stretched s;
  const ImplicitForces forces = s.started();
  const Eigen::VectorXd end = 1.1 * s.velocities();
  s.set_end(forces, end);
  const Eigen::VectorXd remaining = forces.remaining_impulse(s.lattice);
  for (Eigen::Index i = 0; i < end.size(); ++i) {
    const Eigen::VectorXd e = kStep * Eigen::VectorXd::Unit(end.size(), i);
    s.set_end(forces, end + e);
    const double forward = forces.merit(s.lattice);
    s.set_end(forces, end - e);
    const double backward = forces.merit(s.lattice);
    EXPECT_NEAR((backward - forward) / (2.0 * kStep), remaining[i], 1e-6) << "row " << i;
  }
}

// Springs and dampers are taken out of the sum that was given.
TEST(ImplicitForces, LeaveTheWeight) {
  Stretched s;
  const ImplicitForces forces = s.started();
  for (std::size_t row = 0; row < s.system.points().size(); ++row) {
    const double weight = -9.8 * s.lattice.mass[s.system.points()[row]];
    EXPECT_LT((forces.constant().segment<3>(3 * row) - Vec3(0.0, weight, 0.0)).norm(), 1e-11);
  }
}

TEST(ImplicitSolvers, AgreeWithADenseOne) {
  Stretched s;
  const ImplicitForces forces = s.started();
  s.system.linearise(s.lattice, kDt, forces.start_lengths(), s.supports);
  const Eigen::VectorXd b = forces.remaining_impulse(s.lattice);
  const Eigen::VectorXd wanted = dense(s.system).ldlt().solve(b);
  FactorisedSolver factorised(s.system);
  const BlockPreconditioner inverse(s.system.diagonal());
  const LinearSolution direct = factorised.solve(s.system, b);
  const LinearSolution iterated = conjugate_gradients(s.system, inverse, b, 1e-13, 1000);
  EXPECT_LT((direct.x - wanted).norm(), 1e-12 * wanted.norm());
  EXPECT_LT((iterated.x - wanted).norm(), 1e-11 * wanted.norm());
  EXPECT_GT(iterated.iterations, 0);
  EXPECT_LE(iterated.iterations, s.system.size() + 3);  // exact after as many as rows
  EXPECT_FALSE(conjugate_gradients(s.system, inverse, b, 1e-13, 3).converged);
}

// The ordering is that of the springs; a second system of them uses it.
TEST(ImplicitSolvers, RefillWhatTheyOrdered) {
  Stretched s;
  const ImplicitForces forces = s.started();
  FactorisedSolver factorised(s.system);
  for (double dt : {0.5, 1e-3}) {
    s.system.linearise(s.lattice, dt, forces.start_lengths(), {});
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(s.system.size(), -1.0, 2.0);
    const Eigen::VectorXd wanted = dense(s.system).ldlt().solve(b);
    EXPECT_LT((factorised.solve(s.system, b).x - wanted).norm(), 1e-11 * wanted.norm());
  }
}

// A chain has levels of one point, three rows: 3 * 3^2 for the first, 3 * (3 + 3)^2 for the others.
// A ring of six points has levels of 1, 2, 2 and 1.
TEST(BandMultiplications, CountTheLevels) {
  const auto count = [](PhysicalModel model) {
    const Lattice lattice = test::lattice_of({std::move(model)});
    ImplicitSystem system;
    system.rebuild(lattice, lattice.dynamic_points);
    return band_multiplications(system);
  };
  EXPECT_EQ(count(test::chain({.points = 4})), 27.0 + 3 * 108.0);
  GeometricModelBuilder builder;
  builder.begin_subobject("ring");
  std::vector<PointId> ring;
  for (int i = 0; i < 6; ++i) {
    ring.push_back(builder.add_point({std::cos(i * M_PI / 3), std::sin(i * M_PI / 3), 0.0}));
  }
  for (int i = 0; i < 6; ++i) builder.edge(ring[i], ring[(i + 1) % 6]);
  const PhysicalModel model = test::with_plausible_attributes(builder.finish(), "ring");
  EXPECT_EQ(count(model), 27.0 + 6 * 81.0 + 6 * 144.0 + 3 * 81.0);
}

TEST(FreePieces, AreThoseWithoutPins) {
  PhysicalModel held = test::chain({.points = 3});
  held.points[PointId(0)].pinned = true;
  const PhysicalModel loose = test::chain({.points = 3, .origin = {0.0, 5.0, 0.0}});
  Lattice lattice = test::lattice_of({held, loose});
  lattice.breaking.edge_broken[lattice.active_edge.back()] = true;
  rebuild_active(lattice);
  ImplicitSystem system;
  system.rebuild(lattice, lattice.dynamic_points);
  const std::vector<std::vector<std::int32_t>> wanted{{3, 4}, {5}};
  EXPECT_EQ(free_pieces(system), wanted);
}

}  // namespace
}  // namespace limber

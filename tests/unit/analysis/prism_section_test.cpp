#include "core/analysis/prism_section.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/analysis/equilibrium.h"
#include "core/model/errors.h"
#include "core/modeller/cubic_lattice.h"

namespace limber {
namespace {

constexpr double kSpacing = 0.1;  // m

CubicLattice bar_of(int width, int length) {
  return {.points = {width, width, length}, .spacing = kSpacing, .springs = {1000.0, 1000.0, 0.0}};
}

TEST(PrismSection, OfUncoupledColumnsIsTheirSum) {
  CubicLattice bar = bar_of(3, 3);
  bar.springs = {700.0, 0.0, 0.0};
  const PrismSection section = prism_section(cubic_lattice(bar), kSpacing);
  EXPECT_NEAR(section.axial, 9 * 700.0 * kSpacing, 1e-10);
  EXPECT_NEAR(section.bending, 6 * 700.0 * std::pow(kSpacing, 3), 1e-12);
  EXPECT_NEAR(section.torsion, 0.0, 1e-12);
  EXPECT_NEAR(section.poisson_ratio, 0.0, 1e-12);
}

TEST(PrismSection, OfSharedSpringsIsThatOfElasticityTheory) {
  for (int width : {2, 3, 5}) {
    CubicLattice bar = bar_of(width, 4);
    bar.surface = CubicSurface::kShared;
    const PrismSection section = prism_section(cubic_lattice(bar), kSpacing);
    const double side = (width - 1) * kSpacing;
    EXPECT_NEAR(section.axial / (2.5 * 1000.0 / kSpacing * side * side), 1.0, 1e-12);
    EXPECT_NEAR(section.poisson_ratio, 0.25, 1e-12);
  }
}

// A bar with both end layers pinned and the upper one moved as a rigid body about its centre.
struct Held {
  Vec3 force, torque;  // N, N m about the centre of the upper end
};

Held hold(int width, int length, const Vec3& shift, const Vec3& turn) {
  PhysicalModel bar = cubic_lattice(bar_of(width, length));
  const double half = 0.5 * (width - 1) * kSpacing;
  const Vec3 centre(half, half, (length - 1) * kSpacing);
  const Mat3 rotation =
      Eigen::AngleAxisd(turn.norm(), turn.isZero() ? Vec3(Vec3::UnitX()) : turn.normalized())
          .toRotationMatrix();
  const std::size_t layer = width * width;
  const std::size_t first_upper = bar.points.size() - layer;
  for (PointId p : ids_of(bar.points)) {
    bar.points[p].pinned = p.index() < layer || p.index() >= first_upper;
    Vec3& x = bar.geometry.points[p];
    if (p.index() >= first_upper) x = centre + rotation * (x - centre) + shift;
  }
  EXPECT_TRUE(settle(bar, Vec3::Zero()).converged);
  Held held{Vec3::Zero(), Vec3::Zero()};
  const auto support = support_forces(bar, Vec3::Zero());
  for (std::size_t i = first_upper; i < bar.points.size(); ++i) {
    held.force += support[PointId(i)];
    held.torque += (bar.geometry.points[PointId(i)] - centre).cross(support[PointId(i)]);
  }
  return held;
}

// One layer more adds a / stiffness to the compliance: what the ends do cancels in the difference.
double stiffness_of_a_layer(double longer_compliance, double compliance) {
  return kSpacing / (longer_compliance - compliance);
}

TEST(PrismSection, IsWhatOneLayerMoreAddsToALongBar) {
  constexpr double kSmall = 1e-6;  // m or rad: what is not linear is as small relatively
  for (int width : {2, 3}) {
    const PrismSection section = prism_section(cubic_lattice(bar_of(width, 4)), kSpacing);
    const auto stretch = [&](int n) {
      return kSmall / hold(width, n, {0.0, 0.0, kSmall}, Vec3::Zero()).force.z();
    };
    const auto twist = [&](int n) {
      return kSmall / hold(width, n, Vec3::Zero(), {0.0, 0.0, kSmall}).torque.z();
    };
    // Ends turned about y and moved as a circle does: no shear force, the same moment everywhere.
    const auto bend = [&](int n) {
      const double along = 0.5 * (n - 1) * kSpacing * kSmall;
      return kSmall / hold(width, n, {along, 0.0, 0.0}, {0.0, kSmall, 0.0}).torque.y();
    };
    EXPECT_NEAR(stiffness_of_a_layer(stretch(24), stretch(23)) / section.axial, 1.0, 1e-5);
    EXPECT_NEAR(stiffness_of_a_layer(twist(24), twist(23)) / section.torsion, 1.0, 1e-5);
    EXPECT_NEAR(stiffness_of_a_layer(bend(24), bend(23)) / section.bending, 1.0, 1e-5);
  }
}

TEST(PrismSection, RefusesWhatIsNoPrism) {
  EXPECT_THROW(prism_section(cubic_lattice(bar_of(3, 2)), kSpacing), InputError);
  EXPECT_THROW(prism_section(cubic_lattice(bar_of(3, 5)), 2.5 * kSpacing), InputError);
  EXPECT_THROW(prism_section(PhysicalModel{}, kSpacing), InputError);
  for (double spacing : {0.0, -kSpacing, std::nan("")}) {
    EXPECT_THROW(prism_section(cubic_lattice(bar_of(3, 5)), spacing), InputError);
  }
  PhysicalModel bent = cubic_lattice(bar_of(3, 5));
  for (Vec3& p : bent.geometry.points) p.x() += p.z() * p.z();
  EXPECT_THROW(prism_section(bent, kSpacing), InputError);
}

}  // namespace
}  // namespace limber

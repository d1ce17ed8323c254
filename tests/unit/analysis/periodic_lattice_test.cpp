#include "core/analysis/periodic_lattice.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "core/analysis/vibration.h"
#include "core/model/errors.h"
#include "core/modeller/cubic_lattice.h"

namespace limber {
namespace {

using std::numbers::pi;

constexpr double kSpacing = 0.1;  // m

PeriodicLattice inside_of(const CubicSprings& springs) {
  const CubicLattice block{.points = {3, 3, 3}, .spacing = kSpacing, .springs = springs};
  return lattice_around(cubic_lattice(block), PointId(13), std::pow(kSpacing, 3));
}

// No symmetry but that of the lattice itself.
PeriodicLattice skew_lattice() {
  PeriodicLattice lattice{0.001, {}};
  const Vec3 offsets[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, -2, 1}, {0, 1, 2}};
  double stiffness = 300.0;
  for (const Vec3& offset : offsets) {
    lattice.bonds.push_back({kSpacing * offset, stiffness});
    stiffness *= 1.3;
  }
  return lattice;
}

TEST(LatticeAround, HasEachPairOfDirectionsOnce) {
  const PeriodicLattice lattice = inside_of({1000.0, 500.0, 200.0});
  double sum = 0.0;
  for (const PeriodicLattice::Bond& bond : lattice.bonds) sum += bond.stiffness;
  EXPECT_EQ(lattice.bonds.size(), 13u);
  EXPECT_DOUBLE_EQ(sum, 3 * 1000.0 + 6 * 500.0 + 4 * 200.0);
}

TEST(LatticeAround, RefusesPointsOfTheSurface) {
  const CubicLattice block{.points = {3, 3, 3}, .springs = {1.0, 1.0, 0.0}};
  EXPECT_THROW(lattice_around(cubic_lattice(block), PointId(0), 1.0), InputError);
}

TEST(Elasticity, IsIsotropicWhenAxialSpringsAreAsStiffAsTheOthersWant) {
  // k1 = k2 + 8 k3 / 3: Poisson's ratio 1/4, Young's modulus 2.5 C12.
  for (const CubicSprings& springs : {CubicSprings{1000.0, 1000.0, 0.0}, {1800.0, 1000.0, 300.0}}) {
    const ElasticityMatrix C = elasticity(inside_of(springs));
    const ElasticityMatrix compliance = C.inverse();
    EXPECT_NEAR(1.0 / compliance(0, 0), 2.5 * C(0, 1), 1e-9 * C(0, 1));
    EXPECT_NEAR(-compliance(0, 1) / compliance(0, 0), 0.25, 1e-12);
    EXPECT_NEAR(C(3, 3), 0.5 * (C(0, 0) - C(0, 1)), 1e-9 * C(0, 1));
  }
}

// Energy of a homogeneously strained cell, spring by spring, J.
double strained_energy(const PeriodicLattice& lattice, const Mat3& strain) {
  double energy = 0.0;
  for (const PeriodicLattice::Bond& bond : lattice.bonds) {
    const double longer = ((Mat3::Identity() + strain) * bond.offset).norm() - bond.offset.norm();
    energy += 0.5 * bond.stiffness * longer * longer;
  }
  return energy;
}

TEST(Elasticity, GivesTheEnergyOfSmallStrains) {
  constexpr double kSmall = 1e-6;
  const PeriodicLattice lattice = skew_lattice();
  Eigen::Vector<double, 6> voigt(0.3, -0.2, 0.7, 0.4, -0.6, 0.5);
  Mat3 strain;
  strain << voigt[0], voigt[5] / 2, voigt[4] / 2,  //
      voigt[5] / 2, voigt[1], voigt[3] / 2,        //
      voigt[4] / 2, voigt[3] / 2, voigt[2];
  const double expected = strained_energy(lattice, kSmall * strain) / (kSmall * kSmall);
  const double energy = 0.5 * lattice.cell_volume * voigt.dot(elasticity(lattice) * voigt);
  EXPECT_NEAR(energy, expected, 1e-5 * expected);
}

TEST(DynamicalMatrix, OfPlaneWavesAlongAnAxisIsThatOfAChainOfLayers) {
  const PeriodicLattice lattice = inside_of({1000.0, 500.0, 300.0});
  const ElasticityMatrix C = elasticity(lattice);
  for (double qa : {0.1, 1.0, 3.0}) {
    const Mat3 D = dynamical_matrix(lattice, {qa / kSpacing, 0.0, 0.0});
    const double chain = 4.0 * std::pow(std::sin(qa / 2.0), 2) * kSpacing;
    EXPECT_NEAR(D(0, 0), C(0, 0) * chain, 1e-12 * D(0, 0));
    EXPECT_NEAR(D(1, 1), C(5, 5) * chain, 1e-12 * D(0, 0));
    EXPECT_NEAR(D(0, 1), 0.0, 1e-12 * D(0, 0));
  }
}

TEST(HighestBulkFrequency, OfSimpleLattices) {
  // Layers move against each other: 4 k1 / m; (4 k1 + 16 k2 / 2) / m.
  EXPECT_NEAR(highest_bulk_frequency(inside_of({9.0, 0.0, 0.0}), 1.0, kSpacing).omega, 6.0, 1e-14);
  const PlaneWave wave = highest_bulk_frequency(inside_of({1.0, 1.0, 0.0}), 0.25, kSpacing);
  EXPECT_NEAR(wave.omega, std::sqrt(12.0 / 0.25), 1e-13);
  EXPECT_NEAR(wave.wave_vector.cwiseAbs().maxCoeff() * kSpacing, pi, 1e-6);
}

double largest_eigenvalue(const PeriodicLattice& lattice, const Vec3& wave_vector) {
  const Mat3 D = dynamical_matrix(lattice, wave_vector);
  return Eigen::SelfAdjointEigenSolver<Mat3>(D).eigenvalues()[2];
}

TEST(HighestBulkFrequency, IsNotBeatenByAFineGrid) {
  const PeriodicLattice lattice = skew_lattice();
  const PlaneWave wave = highest_bulk_frequency(lattice, 2.0, kSpacing);
  double best = 0.0;
  for (int i = 0; i <= 30; ++i) {
    for (int j = -30; j < 30; ++j) {
      for (int k = -30; k < 30; ++k) {
        const Vec3 q = Vec3(i, j, k) * (pi / 30.0 / kSpacing);
        best = std::max(best, largest_eigenvalue(lattice, q));
      }
    }
  }
  EXPECT_GE(wave.omega, std::sqrt(best / 2.0));
  EXPECT_LT(wave.omega, 1.01 * std::sqrt(best / 2.0));
  EXPECT_DOUBLE_EQ(wave.omega, std::sqrt(largest_eigenvalue(lattice, wave.wave_vector) / 2.0));
}

TEST(HighestBulkFrequency, IsApproachedByFreeBlocksFromBelow) {
  const CubicLattice block{.points = {9, 9, 9}, .spacing = kSpacing, .springs = {1.0, 1.0, 1.0}};
  const double bulk = highest_bulk_frequency(inside_of(block.springs), 1.0, kSpacing).omega;
  const double finite = exact_highest_frequency(cubic_lattice(block));
  EXPECT_LT(finite, bulk);
  EXPECT_GT(finite, 0.95 * bulk);
}

}  // namespace
}  // namespace limber

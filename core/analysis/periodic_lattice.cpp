#include "core/analysis/periodic_lattice.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "core/model/errors.h"

namespace limber {
namespace {

using Bond = PeriodicLattice::Bond;

std::vector<Bond> springs_of_point(const PhysicalModel& model, PointId p) {
  std::vector<Bond> springs;
  for (EdgeId e : ids_of(model.edges)) {
    if (model.edges[e].broken) continue;
    const auto [a, b] = model.geometry.edges[e];
    if (a != p && b != p) continue;
    const PointId other = a == p ? b : a;
    springs.push_back(
        {model.geometry.points[other] - model.geometry.points[p], model.edges[e].stiffness});
  }
  return springs;
}

bool opposite(const Bond& s, const Bond& t) {
  constexpr double kSame = 1e-9;
  return (s.offset + t.offset).norm() <= kSame * s.offset.norm() &&
         std::abs(s.stiffness - t.stiffness) <= kSame * s.stiffness;
}

double largest_stiffness(const PeriodicLattice& lattice, const Vec3& wave_vector) {
  const Mat3 stiffness = dynamical_matrix(lattice, wave_vector);
  return Eigen::SelfAdjointEigenSolver<Mat3>(stiffness, Eigen::EigenvaluesOnly).eigenvalues()[2];
}

// A wave vector in units of 1 / spacing, and the largest eigenvalue there.
struct Candidate {
  Vec3 qa;
  double stiffness;  // N/m
};

// The best of the 26 neighbours at this distance along each axis, or the same.
Candidate best_neighbour(const PeriodicLattice& lattice, double spacing, const Candidate& from,
                         double distance) {
  Candidate best = from;
  for (int direction = 0; direction < 27; ++direction) {
    const Vec3 way(direction / 9 - 1, direction / 3 % 3 - 1, direction % 3 - 1);
    const Vec3 qa = from.qa + distance * way;
    const double stiffness = largest_stiffness(lattice, qa / spacing);
    if (stiffness > best.stiffness) best = {qa, stiffness};
  }
  return best;
}

// Half the Brillouin zone, -pi to pi a side: D(-q) = D(q). Only the points that no neighbour beats.
std::vector<Candidate> hills(const PeriodicLattice& lattice, double spacing) {
  constexpr int kHalf = 8;
  constexpr double kGrid = std::numbers::pi / kHalf;
  std::vector<Candidate> candidates;
  for (int i = 0; i <= kHalf; ++i) {
    for (int j = -kHalf; j <= kHalf; ++j) {
      for (int k = -kHalf; k <= kHalf; ++k) {
        const Vec3 qa = kGrid * Vec3(i, j, k);
        const Candidate here{qa, largest_stiffness(lattice, qa / spacing)};
        const Candidate beside = best_neighbour(lattice, spacing, here, kGrid);
        if (beside.stiffness == here.stiffness) candidates.push_back(here);
      }
    }
  }
  return candidates;
}

// Compass search. It does not stall where eigenvalues cross: the largest of several smooth
// functions has kinks in its valleys only.
Candidate climb(const PeriodicLattice& lattice, double spacing, Candidate at) {
  constexpr double kFinest = 1e-7;  // its square is what the eigenvalue may lack
  for (double distance = 0.2; distance > kFinest; distance *= 0.5) {
    for (Candidate next = best_neighbour(lattice, spacing, at, distance);
         next.stiffness > at.stiffness; next = best_neighbour(lattice, spacing, at, distance)) {
      at = next;
    }
  }
  return at;
}

// The direction pairs of Voigt's notation.
constexpr std::array<std::array<int, 2>, 6> kVoigt{
    {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};

}  // namespace

PeriodicLattice lattice_around(const PhysicalModel& block, PointId inner, double cell_volume_m3) {
  std::vector<Bond> springs = springs_of_point(block, inner);
  PeriodicLattice lattice{cell_volume_m3, {}};
  while (!springs.empty()) {
    const Bond bond = springs.back();
    springs.pop_back();
    const auto partner = std::find_if(springs.begin(), springs.end(),
                                      [&](const Bond& s) { return opposite(bond, s); });
    if (partner == springs.end()) {
      throw InputError({block.name + ": point " + std::to_string(inner.value),
                        "has a spring without an equal one opposite",
                        "choose a point inside of a regular block"});
    }
    lattice.bonds.push_back(bond);
    springs.erase(partner);
  }
  return lattice;
}

ElasticityMatrix elasticity(const PeriodicLattice& lattice) {
  ElasticityMatrix C = ElasticityMatrix::Zero();
  for (const Bond& bond : lattice.bonds) {
    const Vec3 n = bond.offset.normalized();
    Eigen::Matrix<double, 6, 1> nn;
    for (int i = 0; i < 6; ++i) nn[i] = n[kVoigt[i][0]] * n[kVoigt[i][1]];
    C += bond.stiffness * bond.offset.squaredNorm() / lattice.cell_volume * nn * nn.transpose();
  }
  return C;
}

Mat3 dynamical_matrix(const PeriodicLattice& lattice, const Vec3& wave_vector) {
  Mat3 D = Mat3::Zero();
  for (const Bond& bond : lattice.bonds) {
    const Vec3 n = bond.offset.normalized();
    const double phase = wave_vector.dot(bond.offset);
    D += 2.0 * bond.stiffness * (1.0 - std::cos(phase)) * n * n.transpose();
  }
  return D;
}

PlaneWave highest_bulk_frequency(const PeriodicLattice& lattice, double mass_kg, double spacing_m) {
  Candidate best{Vec3::Zero(), 0.0};
  for (const Candidate& hill : hills(lattice, spacing_m)) {
    const Candidate top = climb(lattice, spacing_m, hill);
    if (top.stiffness > best.stiffness) best = top;
  }
  return {std::sqrt(best.stiffness / mass_kg), best.qa / spacing_m};
}

}  // namespace limber

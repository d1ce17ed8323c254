#include "core/modeller/cell_stiffness.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/modeller/nonnegative_least_squares.h"

namespace limber {
namespace {

// A fully symmetric tensor of rank four has 15 different components, one per monomial
// x^p y^q z^r of degree four. Each is weighted with the root of how often it occurs among the 81,
// so that the norm of the 15 is the norm of the tensor.
using SymmetricTensor = Eigen::Matrix<double, 15, 1>;

struct Monomial {
  int p, q, r;
  double weight;
};

std::array<Monomial, 15> make_monomials() {
  constexpr std::array<double, 5> factorial = {1, 1, 2, 6, 24};
  std::array<Monomial, 15> all;
  std::size_t i = 0;
  for (int p = 0; p <= 4; ++p) {
    for (int q = 0; p + q <= 4; ++q) {
      const int r = 4 - p - q;
      all[i++] = {p, q, r, std::sqrt(24.0 / (factorial[p] * factorial[q] * factorial[r]))};
    }
  }
  return all;
}

const std::array<Monomial, 15>& monomials() {
  static const std::array<Monomial, 15> all = make_monomials();
  return all;
}

double power(double x, int exponent) {
  double product = 1.0;
  for (int i = 0; i < exponent; ++i) product *= x;
  return product;
}

// n_i n_j n_k n_l
SymmetricTensor fourth_power(const Vec3& n) {
  SymmetricTensor t;
  Eigen::Index i = 0;
  for (const auto& [p, q, r, weight] : monomials())
    t[i++] = weight * power(n.x(), p) * power(n.y(), q) * power(n.z(), r);
  return t;
}

// (2/5) (d_ij d_kl + d_ik d_jl + d_il d_jk): 3 at iiii, 1 at iijj, else 0. This is the elasticity
// tensor of Young's modulus 1 and Poisson ratio 1/4, lambda = mu = 2/5.
SymmetricTensor isotropic_tensor() {
  SymmetricTensor t;
  Eigen::Index i = 0;
  for (const auto& [p, q, r, weight] : monomials()) {
    const bool even = p % 2 == 0 && q % 2 == 0 && r % 2 == 0;
    const bool one_axis = std::max({p, q, r}) == 4;
    t[i++] = weight * 0.4 * (one_axis ? 3.0 : even ? 1.0 : 0.0);
  }
  return t;
}

double mean_square_length(std::span<const Vec3> edges_m) {
  double sum = 0.0;
  for (const Vec3& e : edges_m) sum += e.squaredNorm();
  return sum / static_cast<double>(edges_m.size());
}

// Column e: the elasticity tensor that edge e adds per x_e = k_e L^2 / (E V), in units of E; L^2 is
// the mean square length. Dimensionless, entries of order one.
Eigen::MatrixXd tensor_per_edge(std::span<const Vec3> edges_m) {
  const double mean_square = mean_square_length(edges_m);
  Eigen::MatrixXd columns(15, edges_m.size());
  for (std::size_t e = 0; e < edges_m.size(); ++e) {
    columns.col(e) = edges_m[e].squaredNorm() / mean_square * fourth_power(edges_m[e].normalized());
  }
  return columns;
}

// C_iijj of isotropic_tensor().
constexpr double kIsotropicTrace = 6.0;

// Iterated Tikhonov regularisation of A x = isotropic, x >= 0: each round may leave the round
// before at the price kSmooth per squared step, and must lower the misfit by three tenths to be
// worth it. A cell that can be isotropic, such as a cube, becomes so exactly. Others get the smooth
// answer of the first round: the prisms of a shell are then anisotropic by 0.11 (median) instead of
// 0.09, but the highest frequency of the lattice, that is the cost of simulating it, is a tenth
// lower.
Eigen::VectorXd smooth_fit(const Eigen::MatrixXd& A) {
  constexpr double kSmooth = 0.05;
  constexpr double kWorthwhile = 0.7;
  const Eigen::Index n = A.cols();
  const Eigen::MatrixXd H = A.transpose() * A + kSmooth * Eigen::MatrixXd::Identity(n, n);
  const SymmetricTensor isotropic = isotropic_tensor();
  const Eigen::VectorXd wanted = A.transpose() * isotropic;
  Eigen::VectorXd x = nonnegative_minimum(H, wanted);
  for (double misfit = (A * x - isotropic).norm();;) {
    const Eigen::VectorXd next = nonnegative_minimum(H, wanted + kSmooth * x);
    const double next_misfit = (A * next - isotropic).norm();
    if (!(next_misfit < kWorthwhile * misfit)) return x;
    x = next;
    misfit = next_misfit;
  }
}

// Smoothing shrinks: CellFit::trace undoes that. C_iijj = sum_e k_e l_e^2 / V, nine times the bulk
// modulus, is exact for every cell.
CellFit fit_of(std::span<const Vec3> edges_m) {
  const Eigen::VectorXd x = smooth_fit(tensor_per_edge(edges_m));
  CellFit fit{{x.begin(), x.end()}, 0.0};
  for (std::size_t e = 0; e < edges_m.size(); ++e) fit.trace += x[e] * edges_m[e].squaredNorm();
  return fit;
}

}  // namespace

double CellFit::stiffness_per_weight(double volume_m3, double youngs_modulus_Pa) const {
  return kIsotropicTrace * youngs_modulus_Pa * volume_m3 / trace;
}

std::vector<double> isotropic_cell_stiffness(std::span<const Vec3> edges_m, double volume_m3,
                                             double youngs_modulus_Pa) {
  CellFit fit = fit_of(edges_m);
  const double scale = fit.stiffness_per_weight(volume_m3, youngs_modulus_Pa);
  for (double& weight : fit.weights) weight *= scale;
  return std::move(fit.weights);
}

double anisotropy(std::span<const Vec3> edges_m, std::span<const double> stiffness_N_m,
                  double volume_m3, double youngs_modulus_Pa) {
  SymmetricTensor tensor = SymmetricTensor::Zero();
  for (std::size_t e = 0; e < edges_m.size(); ++e) {
    tensor += stiffness_N_m[e] * edges_m[e].squaredNorm() / (volume_m3 * youngs_modulus_Pa) *
              fourth_power(edges_m[e].normalized());
  }
  const SymmetricTensor isotropic = isotropic_tensor();
  double worst = 0.0;
  for (Eigen::Index i = 0; i < tensor.size(); ++i) {
    const double weight = monomials()[static_cast<std::size_t>(i)].weight;
    worst = std::max(worst, std::abs(tensor[i] - isotropic[i]) / weight);
  }
  return worst / 1.2;  // the largest component of the isotropic tensor, C_1111 = 1.2 E
}

const CellFit& CellFitter::fit(std::span<const Vec3> edges_m) {
  set_shape_key(edges_m, key_);
  return fits_.get(key_, [&] { return fit_of(edges_m); });
}

void set_shape_key(std::span<const Vec3> edges_m, RoundedKey& key) {
  double largest = 0.0;
  for (const Vec3& e : edges_m) largest = std::max(largest, e.cwiseAbs().maxCoeff());
  const double quantum = RoundedKey::quantum(largest);
  key.clear();
  key.add(std::ilogb(quantum));
  for (const Vec3& e : edges_m) {
    for (int axis = 0; axis < 3; ++axis) key.add(e[axis], quantum);
  }
}

double elongation(std::span<const Vec3> corners_m) {
  Vec3 centre = Vec3::Zero();
  for (const Vec3& corner : corners_m) centre += corner / static_cast<double>(corners_m.size());
  Mat3 moments = Mat3::Zero();
  for (const Vec3& corner : corners_m) moments += (corner - centre) * (corner - centre).transpose();
  const Vec3 ascending =
      Eigen::SelfAdjointEigenSolver<Mat3>(moments, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(ascending[0] > 1e-14 * ascending[2])) return std::numeric_limits<double>::infinity();
  return std::sqrt(ascending[2] / ascending[0]);
}

}  // namespace limber

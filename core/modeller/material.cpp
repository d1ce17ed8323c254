#include "core/modeller/material.h"

#include <algorithm>
#include <cmath>

#include "core/dynamics/stable_step.h"
#include "core/model/errors.h"
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

std::array<Monomial, 15> monomials() {
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

const std::array<Monomial, 15> kMonomials = monomials();

double power(double x, int exponent) {
  double product = 1.0;
  for (int i = 0; i < exponent; ++i) product *= x;
  return product;
}

// n_i n_j n_k n_l
SymmetricTensor fourth_power(const Vec3& n) {
  SymmetricTensor t;
  for (std::size_t i = 0; i < kMonomials.size(); ++i) {
    const auto& [p, q, r, weight] = kMonomials[i];
    t[i] = weight * power(n.x(), p) * power(n.y(), q) * power(n.z(), r);
  }
  return t;
}

// (2/5) (d_ij d_kl + d_ik d_jl + d_il d_jk): 3 at iiii, 1 at iijj, else 0. This is the elasticity
// tensor of Young's modulus 1 and Poisson ratio 1/4, lambda = mu = 2/5.
SymmetricTensor isotropic_tensor() {
  SymmetricTensor t;
  for (std::size_t i = 0; i < kMonomials.size(); ++i) {
    const auto& [p, q, r, weight] = kMonomials[i];
    const bool even = p % 2 == 0 && q % 2 == 0 && r % 2 == 0;
    const bool one_axis = std::max({p, q, r}) == 4;
    t[i] = weight * 0.4 * (one_axis ? 3.0 : even ? 1.0 : 0.0);
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

void require(bool good, const std::string& where, const std::string& what,
             const std::string& remedy) {
  if (!good) throw InputError({where, what, remedy});
}

void require_number(bool good, const std::string& where, const std::string& quantity, double value,
                    const std::string& remedy) {
  require(good && !std::isnan(value), where, quantity + " is " + std::to_string(value), remedy);
}

void check(const Material& m, const std::string& name) {
  const std::string where = name + ": material";
  const auto positive = [](double x) { return x > 0.0 && std::isfinite(x); };
  const auto not_negative = [](double x) { return x >= 0.0 && std::isfinite(x); };
  require_number(positive(m.density), where, "density", m.density, "give a positive kg/m^3");
  require_number(positive(m.youngs_modulus), where, "Young's modulus", m.youngs_modulus,
                 "give a positive Pa");
  require_number(m.strain_at_break > 0.0, where, "strain at break", m.strain_at_break,
                 "give a positive strain or leave it unbreakable");
  require_number(m.strain_at_crush > 0.0, where, "strain at crush", m.strain_at_crush,
                 "give a positive strain or leave it unbreakable");
  require_number(not_negative(m.damping_ratio), where, "damping ratio", m.damping_ratio,
                 "give 0 or more");
  require_number(not_negative(m.internal_damping), where, "internal damping", m.internal_damping,
                 "give 0 or more 1/s");
  require_number(not_negative(m.friction), where, "friction", m.friction, "give 0 or more");
  require_number(not_negative(m.restitution) && m.restitution <= 1.0, where, "restitution",
                 m.restitution, "give 0 to 1");
  require_number(m.softening >= 1.0 && std::isfinite(m.softening), where, "softening", m.softening,
                 "give 1 (the real material) or more");
}

// The points of a cell's edges, each once.
std::vector<PointId> corners_of(const GeometricModel& model, const Cell& cell) {
  std::vector<PointId> corners;
  for (EdgeId e : cell.edges) {
    corners.push_back(model.edges[e].a);
    corners.push_back(model.edges[e].b);
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

std::vector<Vec3> edge_vectors(const GeometricModel& model, const Cell& cell) {
  std::vector<Vec3> vectors;
  for (EdgeId e : cell.edges) {
    vectors.push_back(model.points[model.edges[e].b] - model.points[model.edges[e].a]);
  }
  return vectors;
}

void add_cell_mass(PhysicalModel& model, const Cell& cell, double mass) {
  const std::vector<PointId> corners = corners_of(model.geometry, cell);
  for (PointId p : corners) model.points[p].mass += mass / static_cast<double>(corners.size());
}

void add_cell_stiffness(PhysicalModel& model, const Cell& cell, double volume, double modulus) {
  const std::vector<Vec3> vectors = edge_vectors(model.geometry, cell);
  const std::vector<double> stiffness = isotropic_cell_stiffness(vectors, volume, modulus);
  for (std::size_t i = 0; i < cell.edges.size(); ++i) {
    model.edges[cell.edges[i]].stiffness += stiffness[i];
  }
}

void add_cells(PhysicalModel& model, const Material& material) {
  for (CellId c : ids_of(model.geometry.cells)) {
    const Cell& cell = model.geometry.cells[c];
    const double volume = cell_volume(model.geometry, c);
    require(volume > 0.0, model.name + ": cell " + std::to_string(c.index()),
            "its volume is " + std::to_string(volume * 1e9) + " mm^3",
            "turn its faces outward, or thin the wall where the surface curves more than that");
    add_cell_mass(model, cell, material.density * volume);
    add_cell_stiffness(model, cell, volume, material.effective_modulus());
  }
}

void require_every_element_in_a_cell(const PhysicalModel& model) {
  for (EdgeId e : ids_of(model.geometry.edges)) {
    require(!model.geometry.edge_cells[e].empty(),
            model.name + ": edge " + std::to_string(e.index()),
            "it belongs to no cell, so the material gives it no stiffness",
            "put it into a cell or set its attributes yourself");
  }
  for (PointId p : ids_of(model.points)) {
    require(model.points[p].mass > 0.0, model.name + ": point " + std::to_string(p.index()),
            "it belongs to no cell, so the material gives it no mass",
            "put it into a cell or leave it out");
  }
}

void set_lengths_and_thresholds(PhysicalModel& model, const Material& material) {
  const double strain_at_break = material.effective_strain_at_break();
  const double strain_at_crush = material.effective_strain_at_crush();
  for (EdgeId e : ids_of(model.edges)) {
    const auto [a, b] = model.geometry.edges[e];
    EdgeAttributes& edge = model.edges[e];
    edge.rest_length = (model.geometry.points[b] - model.geometry.points[a]).norm();
    edge.break_threshold = strain_at_break * edge.rest_length;
    edge.crush_threshold = strain_at_crush * edge.rest_length;
  }
}

}  // namespace

double Material::effective_modulus() const { return youngs_modulus / softening; }

double Material::effective_strain_at_break() const {
  return strain_at_break * std::sqrt(softening);
}

double Material::effective_strain_at_crush() const {
  return strain_at_crush * std::sqrt(softening);
}

std::vector<double> isotropic_cell_stiffness(std::span<const Vec3> edges_m, double volume_m3,
                                             double youngs_modulus_Pa) {
  const Eigen::MatrixXd A = tensor_per_edge(edges_m);
  Eigen::VectorXd x = smooth_fit(A);
  // Smoothing shrinks. C_iijj = sum_e k_e l_e^2 / V, nine times the bulk modulus, is exact for
  // every cell all the same.
  double trace = 0.0;
  for (std::size_t e = 0; e < edges_m.size(); ++e) trace += x[e] * edges_m[e].squaredNorm();
  x *= kIsotropicTrace * youngs_modulus_Pa * volume_m3 / trace;
  return {x.begin(), x.end()};
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
  for (std::size_t i = 0; i < kMonomials.size(); ++i) {
    worst = std::max(worst, std::abs(tensor[i] - isotropic[i]) / kMonomials[i].weight);
  }
  return worst / 1.2;  // the largest component of the isotropic tensor, C_1111 = 1.2 E
}

void set_stiffness_proportional_damping(PhysicalModel& model, double damping_ratio) {
  const double omega_max = highest_frequency(model).omega_max;
  const double seconds = omega_max > 0.0 ? 2.0 * damping_ratio / omega_max : 0.0;
  for (EdgeAttributes& edge : model.edges) edge.damping = seconds * edge.stiffness;
}

PhysicalModel with_material(GeometricModel geometry, std::string name, const Material& material) {
  check(material, name);
  PhysicalModel model = with_default_attributes(std::move(geometry), std::move(name));
  for (PointAttributes& point : model.points) point.mass = 0.0;
  for (EdgeAttributes& edge : model.edges) edge.stiffness = 0.0;
  add_cells(model, material);
  require_every_element_in_a_cell(model);
  set_lengths_and_thresholds(model, material);
  set_stiffness_proportional_damping(model, material.damping_ratio);
  model.object = {material.friction, material.restitution, material.internal_damping,
                  material.softening};
  return model;
}

}  // namespace limber

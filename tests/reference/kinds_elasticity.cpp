// Group 3: elasticity of cubic lattices, through core/analysis. Statics is in kinds_statics.cpp.

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/analysis/prism_section.h"
#include "core/analysis/vibration.h"
#include "core/dynamics/spring_force.h"
#include "tests/reference/cubic.h"
#include "tests/reference/kinds.h"
#include "tests/reference/run.h"

namespace limber::reference {
namespace {

using std::numbers::pi;

// ---- the infinite lattice ----------------------------------------------------------------------

// A bar of the material is pulled along x by a unit strain and free to contract.
struct Pulled {
  double stress = 0.0;       // Pa: Young's modulus along x
  double contraction = 0.0;  // Poisson's ratio
};

Pulled pulled_along_x(const ElasticityMatrix& stiffness) {
  const Eigen::Matrix2d lateral = stiffness.block<2, 2>(1, 1);
  const Eigen::Vector2d coupling = stiffness.block<2, 1>(1, 0);
  const Eigen::Vector2d strain = -lateral.completeOrthogonalDecomposition().solve(coupling);
  return {stiffness(0, 0) + coupling.dot(strain), -strain.mean()};
}

// Springs between layers that move as one: a plane wave with opposite neighbours, m omega^2 = 4 K.
Vec3 layer_springs(const Bulk& bulk, double spacing) {
  return dynamical_matrix(bulk.lattice, Vec3(pi / spacing, 0.0, 0.0)).diagonal() / 4.0;
}

Json bulk_constants(const Case& c) {
  const CubicLattice shape = cubic_of(c.params);
  const double a = shape.spacing;
  const Bulk bulk = bulk_of(shape);
  const ElasticityMatrix& C = bulk.stiffness;
  const Pulled pulled = pulled_along_x(C);
  const Vec3 between_layers = layer_springs(bulk, a);
  return {{"C11", C(0, 0)},
          {"C12", C(0, 1)},
          {"C44", C(3, 3)},
          {"E100", pulled.stress},
          {"nu100", pulled.contraction},
          {"bulk_modulus", C.topLeftCorner<3, 3>().mean()},  // under equal strains of 1/3
          {"shear_modulus_C44", C(3, 3)},
          {"zener_A", 2.0 * C(3, 3) / (C(0, 0) - C(0, 1))},
          {"isotropy_defect", (C(0, 0) - C(0, 1) - 2.0 * C(3, 3)) * a / shape.springs.axial},
          {"layer_spring_longitudinal_K_L", between_layers.x()},
          {"layer_spring_transverse_K_T", between_layers.y()}};
}

// ---- one state, no motion ----------------------------------------------------------------------

Json energy_by_family(const Lattice& lattice, const CubicLattice& shape) {
  Json energy = Json::object();
  if (shape.springs.axial > 0.0) energy["axial"] = 0.0;
  if (shape.springs.face_diagonal > 0.0) energy["face"] = 0.0;
  if (shape.springs.body_diagonal > 0.0) energy["body"] = 0.0;
  for (const Spring& s : lattice.springs) {
    Json& sum = energy[family_of(s.rest_length, shape.spacing)];
    const Vec3 d = lattice.motion[s.b].position - lattice.motion[s.a].position;
    sum = sum.get<double>() + spring_energy(s.stiffness, d.norm() - s.rest_length);
  }
  return energy;
}

double largest_inside(const std::vector<Vec3>& force, const CubicLattice& shape) {
  double largest = 0.0;
  for (std::size_t p = 0; p < force.size(); ++p) {
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis) {
      const int at = layer_of(shape, PointId(p), axis);
      inside = inside && at > 0 && at < shape.points[axis] - 1;
    }
    if (inside) largest = std::max(largest, force[p].norm());
  }
  return largest;
}

Json affine_energy(const Case& c) {
  const CubicLattice shape = cubic_of(c.params);
  const Mat3 F = mat3(c.params.at("F"));
  PhysicalModel model = cubic_model(shape);
  for (Vec3& x : model.geometry.points) x = F * x;
  Run run(model);
  const std::vector<Vec3> force = run.forces();
  const Lattice& lattice = run.lattice();
  Vec3 total = Vec3::Zero(), torque = Vec3::Zero(), on_side = Vec3::Zero();
  for (std::size_t p = 0; p < force.size(); ++p) {
    total += force[p];
    torque += lattice.motion[p].position.cross(force[p]);
  }
  for (PointId p : layer_points(shape, 0, shape.points[0] - 1)) on_side += force[p.index()];
  return {{"n_points", model.points.size()},
          {"n_edges", model.edges.size()},
          {"elastic_energy", reference::elastic_energy(lattice)},
          {"energy_by_family", energy_by_family(lattice, shape)},
          {"max_force_on_interior_points", largest_inside(force, shape)},
          {"force_on_point_0", to_json(force[0])},
          {"force_sum_on_plus_x_face", to_json(on_side)},
          {"total_force", to_json(total)},
          {"total_torque", to_json(torque)}};
}

// ---- prisms ------------------------------------------------------------------------------------

// The continuum's, over G: no answer, but what GJ_over_continuum is defined by, as E A and E I are
// for its neighbours. Saint-Venant's series (Timoshenko and Goodier, Theory of Elasticity, section
// 109).
double square_torsion_constant() {
  double sum = 0.0;
  for (int n = 1; n < 40; n += 2) sum += std::tanh(n * pi / 2.0) / std::pow(n, 5);
  return (1.0 - 192.0 / std::pow(pi, 5) * sum) / 3.0;
}

Json prism_row(CubicLattice shape, int n) {
  const double a = shape.spacing, side = (n - 1) * a;
  shape.points = {n, n, 5};
  const PhysicalModel bar = cubic_lattice(shape);
  const PrismSection section = prism_section(bar, a);
  double layer_mass = 0.0;  // of a middle layer, whose points have 1 kg inside
  for (PointId p : layer_points(shape, 2, 2)) layer_mass += bar.points[p].mass;
  const ElasticityMatrix C = bulk_of(shape).stiffness;
  const double young = pulled_along_x(C).stress;
  return {section.axial,
          section.bending,
          section.torsion,
          section.poisson_ratio,
          layer_mass,
          n,
          section.axial / (young * side * side),
          section.bending / (young * std::pow(side, 4) / 12.0),
          section.torsion / (C(3, 3) * square_torsion_constant() * std::pow(side, 4))};
}

Json prism_surface_effects(const Case& c) {
  const CubicLattice shape = cubic_of(c.params);
  Json rows = Json::array();
  for (int n : c.params.at("n_points")) rows.push_back(prism_row(shape, n));
  return {{"columns",
           {"EA", "EI", "GJ", "nu_side_faces", "mass_points_per_layer", "n", "EA_over_continuum",
            "EI_over_continuum", "GJ_over_continuum"}},
          {"rows", rows}};
}

// ---- vibrations of a free bar ------------------------------------------------------------------

// The mode most like the first longitudinal one of a rod, u_x = cos(pi x / L); rad/s.
double longitudinal_frequency(const PhysicalModel& bar, const VibrationModes& modes,
                              double length) {
  Eigen::VectorXd along = Eigen::VectorXd::Zero(modes.omega_squared.size());
  for (std::size_t i = 0; i < modes.free_points.size(); ++i) {
    const PointId p = modes.free_points[i];
    along[3 * Eigen::Index(i)] =
        bar.points[p].mass * std::cos(pi * bar.geometry.points[p].x() / length);
  }
  Eigen::Index best = 0;
  (modes.shapes.transpose() * along).cwiseAbs().maxCoeff(&best);
  return std::sqrt(modes.omega_squared[best]);
}

Json free_bar_modes(const Case& c) {
  const CubicLattice shape = cubic_of(c.params);
  const PhysicalModel bar = cubic_lattice(shape);
  const VibrationModes modes = vibration_modes(bar);
  const int zero_modes = zero_mode_count(modes);
  Json lowest = Json::array();
  for (Eigen::Index i = zero_modes; i < modes.omega_squared.size() && lowest.size() < 12; ++i) {
    lowest.push_back(std::sqrt(modes.omega_squared[i]));
  }
  const double length = (shape.points[0] - 1) * shape.spacing;
  const double longitudinal = longitudinal_frequency(bar, modes, length);
  const Bulk bulk = bulk_of(shape);
  return {{"n_zero_modes", zero_modes},
          {"lowest_12_nonzero_omega", lowest},
          {"omega_max", std::sqrt(modes.omega_squared.maxCoeff())},
          {"cL_bulk", wave_speed(bulk.stiffness(0, 0), bulk.density)},
          {"cT_bulk", wave_speed(bulk.stiffness(3, 3), bulk.density)},
          {"omega_longitudinal_1", longitudinal},
          {"bar_speed_from_mode", longitudinal * length / pi}};
}

}  // namespace

Kinds elasticity_kinds() {
  return {{"bulk_constants", bulk_constants},
          {"affine_energy", affine_energy},
          {"prism_surface_effects", prism_surface_effects},
          {"free_bar_modes", free_bar_modes}};
}

}  // namespace limber::reference

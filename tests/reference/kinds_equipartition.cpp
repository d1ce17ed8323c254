// Group 12: how a vibrating lattice divides its energy.

#include <cmath>
#include <numbers>

#include "core/analysis/vibration.h"
#include "tests/reference/cubic.h"
#include "tests/reference/kinds.h"
#include "tests/reference/run.h"

namespace limber::reference {
namespace {

using std::numbers::pi;

struct Means {
  double kinetic = 0.0, elastic = 0.0;  // J
};

Means mean_energies(Run& run, double duration, double dt) {
  Means sum;
  int samples = 0;
  for (; run.time() < duration; ++samples) {
    run.advance_to(run.time() + 4.0 * dt, dt);
    sum.kinetic += reference::kinetic_energy(run.lattice());
    sum.elastic += reference::elastic_energy(run.lattice());
  }
  return {sum.kinetic / samples, sum.elastic / samples};
}

// Of points that are where they are authored: the kinetic energy of each mode, J.
Eigen::VectorXd modal_energies(const PhysicalModel& model, const VibrationModes& modes) {
  Eigen::VectorXd momenta(modes.omega_squared.size());
  for (std::size_t i = 0; i < modes.free_points.size(); ++i) {
    const PointAttributes& point = model.points[modes.free_points[i]];
    momenta.segment<3>(3 * Eigen::Index(i)) = point.mass * point.velocity;
  }
  return 0.5 * (modes.shapes.transpose() * momenta).cwiseAbs2();
}

Json virial(const Case& c) {
  PhysicalModel model = cubic_model(c.params);
  for (PointId p : ids_of(model.points)) {
    model.points[p].velocity = vec3(c.params.at("velocities").at(p.index()));
  }
  const VibrationModes modes = vibration_modes(model);
  const Eigen::VectorXd energies = modal_energies(model, modes);
  Json omega = Json::array(), energy_of = Json::array();
  for (Eigen::Index i = zero_mode_count(modes); i < energies.size(); ++i) {
    omega.push_back(std::sqrt(modes.omega_squared[i]));
    energy_of.push_back(energies[i]);
  }
  Run run(model);
  const double total = energy(run.lattice());
  const double duration = 200.0 * 2.0 * pi / omega.at(0).get<double>();
  const Means means = mean_energies(run, duration, 0.05 * run.stable_step());
  return {{"E_total", total},
          {"mean_kinetic", means.kinetic},
          {"mean_elastic", means.elastic},
          {"modal_energies", energy_of},
          {"mode_omega", omega}};
}

}  // namespace

Kinds equipartition_kinds() { return {{"virial", virial}}; }

}  // namespace limber::reference

#include "core/modeller/material.h"

#include <cmath>

#include "core/dynamics/stable_step.h"
#include "core/model/diagnostic_list.h"
#include "core/modeller/material_assignment.h"

namespace limber {

double Material::effective_modulus() const { return youngs_modulus / softening; }

double Material::effective_strain_at_break() const {
  return strain_at_break * std::sqrt(softening);
}

double Material::effective_strain_at_crush() const {
  return strain_at_crush * std::sqrt(softening);
}

void require_valid(const Material& m, const std::string& where) {
  const auto require = [&](bool good, const char* quantity, double value, const char* remedy) {
    if (!good) throw InputError({where, say(quantity, " is ", value), remedy});
  };
  const auto positive = [](double x) { return x > 0.0 && std::isfinite(x); };
  const auto not_negative = [](double x) { return x >= 0.0 && std::isfinite(x); };
  require(positive(m.density), "density", m.density, "give a positive kg/m^3");
  require(positive(m.youngs_modulus), "Young's modulus", m.youngs_modulus, "give a positive Pa");
  require(m.poisson_ratio > -1.0 && m.poisson_ratio <= 0.5, "Poisson ratio", m.poisson_ratio,
          "give the real material's, above -1 and up to 0.5");
  require(m.strain_at_break > 0.0, "strain at break", m.strain_at_break,
          "give a positive strain or leave it unbreakable");
  require(m.strain_at_crush > 0.0, "strain at crush", m.strain_at_crush,
          "give a positive strain or leave it unbreakable");
  require(not_negative(m.damping_ratio), "damping ratio", m.damping_ratio, "give 0 or more");
  require(not_negative(m.internal_damping), "internal damping", m.internal_damping,
          "give 0 or more 1/s");
  require(not_negative(m.friction), "friction", m.friction, "give 0 or more");
  require(not_negative(m.restitution) && m.restitution <= 1.0, "restitution", m.restitution,
          "give 0 to 1");
  require(m.softening >= 1.0 && std::isfinite(m.softening), "softening", m.softening,
          "give 1 (the real material) or more");
}

double critical_impact_speed(const Material& m) {
  return m.effective_strain_at_break() * std::sqrt(m.effective_modulus() / m.density);
}

void set_stiffness_proportional_damping(PhysicalModel& model, double damping_ratio) {
  const double omega_max = highest_frequency(model).omega_max;
  const double seconds = omega_max > 0.0 ? 2.0 * damping_ratio / omega_max : 0.0;
  for (EdgeAttributes& edge : model.edges) edge.damping = seconds * edge.stiffness;
}

PhysicalModel with_material(GeometricModel geometry, std::string name, const Material& material) {
  return with_materials(std::move(geometry), std::move(name), {&material, 1},
                        [](const CellPlace&) { return std::size_t{0}; });
}

}  // namespace limber

#include "core/modeller/softness.h"

#include <algorithm>
#include <cmath>

#include "core/model/bounds.h"
#include "core/modeller/cell_kind.h"
#include "core/modeller/three_digits.h"

namespace limber {
namespace {

constexpr double kTraceOverModulus = 6.0;  // A_iijj / E

// Volume of a cube as large as the mean cell, m^3; 0 where a cell is flat or there is none.
double mean_cell_volume(const GeometricModel& geometry) {
  double sum = 0.0;
  for (CellId c : ids_of(geometry.cells)) {
    if (is_sheet_cell(geometry, geometry.cells[c])) return 0.0;
    sum += std::abs(cell_volume(geometry, c));
  }
  return geometry.cells.empty() ? 0.0 : sum / static_cast<double>(geometry.cells.size());
}

bool is_pinned(const PhysicalModel& model) {
  return std::any_of(model.points.begin(), model.points.end(),
                     [](const PointAttributes& point) { return point.pinned; });
}

std::string remedy_of(const LandingEstimate& landing, double gravity) {
  const std::string stiffer = "give it a stiffer material or less softening";
  const double v = landing.most_speed();
  if (v == 0.0) return stiffer + ", or make it lower";
  return "let it fall from less than " + three_digits(v * v / (2.0 * gravity)) + " m (" +
         three_digits(v) + " m/s), or " + stiffer;
}

}  // namespace

double bar_wave_speed(const PhysicalModel& model) {
  double sum = 0.0;  // J
  for (EdgeId e : ids_of(model.edges)) {
    const EdgeAttributes& edge = model.edges[e];
    if (!edge.broken) sum += edge.stiffness * edge.rest_length * edge.rest_length;
  }
  const double mass = total_mass(model);
  return mass > 0.0 ? std::sqrt(sum / (kTraceOverModulus * mass)) : 0.0;
}

double sag_strain(double wave_speed_m_s, double height_m, double gravity_m_s2) {
  return gravity_m_s2 * height_m / (wave_speed_m_s * wave_speed_m_s);
}

double landing_strain(double sag_strain, double speed_m_s, double wave_speed_m_s) {
  return sag_strain + std::hypot(sag_strain, speed_m_s / wave_speed_m_s);
}

double most_landing_strain(double layers) { return 0.85 / std::sqrt(layers); }

double LandingEstimate::most_speed() const {
  const double squared = most_strain * (most_strain - 2.0 * sag_strain);
  return wave_speed * std::sqrt(std::max(0.0, squared));
}

std::optional<LandingEstimate> landing_estimate(const PhysicalModel& model, double speed_m_s,
                                                double gravity_m_s2) {
  const double cell = mean_cell_volume(model.geometry);
  LandingEstimate landing;
  landing.wave_speed = bar_wave_speed(model);
  if (!(cell > 0.0) || !(landing.wave_speed > 0.0) || is_pinned(model)) return std::nullopt;
  landing.height = bounds_of(model.geometry.points).sizes().y();
  landing.layers = std::max(1.0, landing.height / std::cbrt(cell));
  landing.sag_strain = sag_strain(landing.wave_speed, landing.height, gravity_m_s2);
  landing.strain = landing_strain(landing.sag_strain, speed_m_s, landing.wave_speed);
  landing.most_strain = most_landing_strain(landing.layers);
  return landing;
}

std::optional<Diagnostic> softness_note(const std::string& where, const PhysicalModel& model,
                                        double speed_m_s, double gravity_m_s2) {
  const auto landing = landing_estimate(model, speed_m_s, gravity_m_s2);
  if (!landing || !landing->inverts()) return std::nullopt;
  return Diagnostic{where,
                    "it is too soft to land at " + three_digits(speed_m_s) +
                        " m/s: that strains it by about " + three_digits(landing->strain) +
                        " (its weight alone by " + three_digits(landing->sag_strain) +
                        "), and from about " + three_digits(landing->most_strain) +
                        " on cells are crushed, and how it comes back is not the material's",
                    remedy_of(*landing, gravity_m_s2)};
}

}  // namespace limber

#include "bullet_bridge/switch_policy.h"

#include <algorithm>
#include <cmath>

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

double averaging_share(double dt, double tau) { return -std::expm1(-dt / tau); }

double impact_strain(const PieceStrength& piece, double closing_speed, double partner_mass) {
  if (closing_speed <= 0.0) return 0.0;
  // m_red / m = M / (m + M) = 1 / (m / M + 1); exact for an infinite partner.
  const double share = 1.0 / (piece.mass / partner_mass + 1.0);
  return closing_speed / piece.wave_speed * std::sqrt(share);
}

double sustained_strain(const PieceStrength& piece, double force_N, double length_m) {
  return force_N * length_m / (piece.mass * piece.wave_speed * piece.wave_speed);
}

double flexible_strain(const PieceStrength& piece, const SwitchSettings& settings) {
  return std::min(settings.visible_strain, settings.load_share * piece.weakest_strain);
}

double vibration_strain(const PieceStrength& piece, double rms_speed) {
  return rms_speed / piece.wave_speed;
}

int calm_ticks_needed(const PieceStrength& piece, const SwitchSettings& settings, double length_m,
                      double tick, bool touched) {
  // A touch that was foreseen but does not come costs two ticks (it may come at the start of the
  // second), not the whole settling time.
  const int settled = touched ? settings.calm_ticks : 2;
  const double period = 2.0 * length_m / piece.wave_speed;
  return std::max(settled, static_cast<int>(std::ceil(period / tick)));
}

bool calm(const PieceStrength& piece, const SwitchSettings& settings, const Calmness& seen) {
  const bool low = seen.peak_load < settings.calm_load_share;
  const bool steady = std::abs(seen.peak_load - seen.peak_load_before) < settings.steady_load_share;
  return (low || steady) &&
         vibration_strain(piece, seen.rms_vibration) < 0.5 * flexible_strain(piece, settings);
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet

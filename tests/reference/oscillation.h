#pragma once

#include <span>

namespace limber::reference {

// What a signal that obeys s[n+1] = a s[n] + b s[n-1] does from sample to sample: any damped
// oscillation does so, and so does every linear one-step integrator of one.
struct Recurrence {
  double a = 0.0, b = 0.0;

  double largest_factor() const;  // the larger magnitude of the roots of z^2 = a z + b
  double angle() const;           // rad per sample; 0 for real roots
};

// By least squares over all samples, four or more. Throws std::runtime_error for fewer.
Recurrence fit_recurrence(std::span<const double> samples);

// s'' + 2 zeta omega0 s' + omega0^2 s = 0.
struct Oscillation {
  double omega0 = 0.0;   // rad/s
  double zeta = 0.0;     // damping ratio; 0 below 1e-9, which is what a fit can tell from none
  double omega_d = 0.0;  // rad/s, 0 when overdamped
};

// Of equidistant samples (interval in s, below half a period). Roots z = exp(s t): omega0^2 is the
// product of the two s, -2 zeta omega0 their sum, which holds for double roots, too.
Oscillation fit_oscillation(std::span<const double> samples, double interval);

}  // namespace limber::reference

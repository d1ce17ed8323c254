#pragma once

#include "core/analysis/stability_case.h"

namespace limber {

// What the elongation u of a damped oscillator obeys from step to step of a linear one-step method:
// u[n+2] = trace u[n+1] - determinant u[n], with those of its amplification matrix.
struct OscillatorRecurrence {
  double trace = 0.0;
  double determinant = 0.0;

  double largest_factor() const;  // spectral radius: stable up to 1
  double angle() const;           // rad per step; 0 without oscillation
};

// Measured: two points on a spring, integrated by the time operator with steps of omega_step /
// omega, the elongations fitted by least squares. A method that leaves the range of the spring's
// rest length within a few steps has an infinite determinant.
OscillatorRecurrence measured_recurrence(const Scheme& scheme, double damping_ratio,
                                         double omega_step);

// The largest omega dt with a spectral radius of 1 at most, between the two ends, by bisection:
// that of the scheme as measured. 0 where the lower end is unstable, infinite where the upper is
// stable.
double measured_step_limit(const Scheme& scheme, double damping_ratio, double from, double to);

}  // namespace limber

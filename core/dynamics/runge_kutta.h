#pragma once

#include <array>

namespace limber {

// Coefficients of an explicit Runge-Kutta method of up to four stages (Butcher 1964): stage s is
// evaluated at x + dt sum_j a[s][j] k_j, time t + c[s] dt; the step is dt sum_s b[s] k_s.
struct ButcherTableau {
  int stages = 1;
  std::array<std::array<double, 3>, 4> a{};
  std::array<double, 4> b{};
  std::array<double, 4> c{};
};

// Both from old values: first order, and without damping unstable at any step. For comparison.
inline constexpr ButcherTableau kExplicitEulerTableau{1, {}, {1.0}, {}};

// Kutta 1901: fourth order, stable to omega dt = 2.828 without damping.
inline constexpr ButcherTableau kRungeKutta4Tableau{
    4,
    {{{}, {0.5}, {0.0, 0.5}, {0.0, 0.0, 1.0}}},
    {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0},
    {0.0, 0.5, 0.5, 1.0}};

}  // namespace limber

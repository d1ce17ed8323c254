#pragma once

#include <random>
#include <string>
#include <vector>

#include "core/dynamics/lattice.h"

namespace limber::test {

struct ChainShape {
  int points = 2;
  double stiffness = 100.0;  // N/m
  double mass = 1.0;         // kg, of every point
  double spacing = 1.0;      // m
  Vec3 origin = Vec3::Zero();
  Vec3 along = Vec3::UnitX();
  std::string name = "chain";
};

// Points on a straight line, neighbours joined, nothing damped or breakable.
PhysicalModel chain(const ChainShape& shape);

// Compiled and ready to step.
Lattice lattice_of(std::vector<PhysicalModel> models);

// Sums over all points and unbroken springs by their definitions, without the library's own.
struct Totals {
  double kinetic = 0.0;                  // J
  double elastic = 0.0;                  // J
  Vec3 momentum = Vec3::Zero();          // kg m/s
  Vec3 angular_momentum = Vec3::Zero();  // about the origin, kg m^2/s
  // Sums of magnitudes: what rounding errors of the two are relative to.
  double momentum_scale = 0.0;
  double angular_momentum_scale = 0.0;

  double energy() const { return kinetic + elastic; }
};
Totals totals(const Lattice& lattice);

// Fails the test when P or L differ by more than `share` of their scales.
void expect_same_momenta(const Totals& before, const Totals& after, double share);

// Components uniform in [-size, size].
Vec3 random_vector(std::mt19937& random, double size);

// Adds random_vector() to the velocity of every point.
void shake(Lattice& lattice, unsigned seed, double speed_m_s);

}  // namespace limber::test

// The same bar at several resolutions: how it bends, stretches and twists is known for each (tables
// of the project's reference cases, "prism surface effects": exact minimum of the energy of a layer
// of an infinitely long prism of n x n points, computed by another code), and it breaks under the
// same load.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/analysis/equilibrium.h"
#include "core/analysis/prism_section.h"
#include "core/dynamics/lattice.h"
#include "core/modeller/box_lattice.h"
#include "core/modeller/cubic_lattice.h"
#include "core/modeller/material_assignment.h"
#include "core/operators/time_operator.h"

namespace limber {
namespace {

constexpr double kWidth = 0.1;     // m, of the square section
constexpr double kModulus = 1e9;   // Pa
constexpr double kDensity = 1000;  // kg/m^3
constexpr double kStrain = 1e-3;   // at break

// Of the continuum with Poisson ratio 1/4. Saint-Venant's torsion constant of a square of side w is
// 0.1405770 w^4 (Timoshenko and Goodier, Theory of Elasticity, section 109).
const double kEA = kModulus * kWidth * kWidth;
const double kEI = kModulus * std::pow(kWidth, 4) / 12.0;
const double kGJ = kModulus / 2.5 * 0.1405770 * std::pow(kWidth, 4);

struct Row {
  int points;         // n, across
  double EA, EI, GJ;  // of the lattice over that of the continuum
};

// k1 = k2, k3 = 0, every edge once with its full k.
constexpr Row kUniform[] = {{2, 2.666667, 6.0, 7.113539},
                            {3, 1.733333, 2.825, 3.556769},
                            {4, 1.468173, 2.085016, 2.590733},
                            {5, 1.343690, 1.767752, 2.148881},
                            {7, 1.224391, 1.482905, 1.735231}};

// The same springs summed over cells (k1 / 4, k2 / 2 each): what a material becomes.
constexpr Row kShared[] = {{2, 1.0, 1.8, 3.556769},
                           {3, 1.0, 1.221429, 1.778385},
                           {5, 1.0, 1.057781, 1.222639},
                           {8, 1.0, 1.019164, 1.076270}};

void expect_row(const PrismSection& section, const Row& row) {
  EXPECT_NEAR(section.axial / kEA, row.EA, 1e-6 * row.EA) << row.points;
  EXPECT_NEAR(section.bending / kEI, row.EI, 1e-6 * row.EI) << row.points;
  EXPECT_NEAR(section.torsion / kGJ, row.GJ, 2e-6 * row.GJ) << row.points;
}

TEST(Refinement, OfUniformLatticesFollowsTheReference) {
  for (const Row& row : kUniform) {
    const double spacing = kWidth / (row.points - 1);
    const double k = kModulus * spacing / 2.5;  // E = 2.5 C12, C12 = k2 / a
    const PhysicalModel bar = cubic_lattice(
        {.points = {row.points, row.points, 4}, .spacing = spacing, .springs = {k, k, 0.0}});
    expect_row(prism_section(bar, spacing), row);
  }
}

Material plain() { return {.density = kDensity, .youngs_modulus = kModulus}; }

// Along z, its axis at x = y = 0. Without body diagonals, as in the tables.
GeometricModel bar_geometry(int points, int cells_along) {
  const int across = points - 1;
  return box_lattice({across, across, cells_along}, Vec3::Constant(kWidth / across),
                     {-kWidth / 2, -kWidth / 2, 0.0}, "bar", {.body_diagonals = false});
}

TEST(Refinement, OfAMaterialFollowsTheReference) {
  for (const Row& row : kShared) {
    const PhysicalModel bar = with_material(bar_geometry(row.points, 3), "bar", plain());
    expect_row(prism_section(bar, kWidth / (row.points - 1)), row);
  }
}

// With body diagonals too (the default) the same modulus is spread over more springs: no table,
// but stretching is exact, and the rest comes to the continuum from above, faster.
TEST(Refinement, WithBodyDiagonalsComesToTheContinuumToo) {
  double bending = 2.0, torsion = 4.0;
  for (int points : {3, 5, 8}) {
    const int across = points - 1;
    const double spacing = kWidth / across;
    const PhysicalModel bar = with_material(
        box_lattice({across, across, 3}, Vec3::Constant(spacing), Vec3::Zero(), "bar"), "bar",
        plain());
    const PrismSection section = prism_section(bar, spacing);
    EXPECT_NEAR(section.axial / kEA, 1.0, 1e-6);
    EXPECT_GT(section.bending / kEI, 1.0);
    EXPECT_GT(section.torsion / kGJ, 1.0);
    EXPECT_LT(section.bending / kEI - 1.0, 0.5 * (bending - 1.0));
    EXPECT_LT(section.torsion / kGJ - 1.0, 0.5 * (torsion - 1.0));
    bending = section.bending / kEI;
    torsion = section.torsion / kGJ;
  }
}

// A cantilever 15 times as long as wide, bent by its own weight: the tip sinks by q L^4 / (8 EI) +
// q L^2 / (2 kappa G A) (Timoshenko's beam, kappa = 5/6), with the EI of the table. What beam
// theory leaves out, the clamp that holds the end's width and a lattice's own shear stiffness, is 1
// % at this length.
TEST(Refinement, ACantileverBendsByTheTable) {
  constexpr double kLength = 1.5;  // m
  const double q = kDensity * 9.81 * kWidth * kWidth;
  for (const Row& row : {kShared[1], kShared[2], kShared[3]}) {
    const int across = row.points - 1;
    PhysicalModel bar = with_material(bar_geometry(row.points, 15 * across), "bar", plain());
    for (PointId p : ids_of(bar.points)) bar.points[p].pinned = bar.geometry.points[p].z() < 1e-9;
    const auto sag = linear_sag(bar, {0.0, -9.81, 0.0});
    double tip = 0.0;
    const std::size_t layer = row.points * row.points;
    for (std::size_t i = bar.points.size() - layer; i < bar.points.size(); ++i)
      tip -= sag[PointId(i)].y() / static_cast<double>(layer);
    const double shear =
        q * kLength * kLength / (2.0 * 5.0 / 6.0 * kModulus / 2.5 * kWidth * kWidth);
    const double wanted = q * std::pow(kLength, 4) / (8.0 * row.EI * kEI) + shear;
    EXPECT_NEAR(tip / wanted, 1.0, 0.02) << row.points;
  }
}

// A bar of 0.6 m that can break in its middle third only: its ends, held rigidly, are somewhere
// else than where it breaks, as in a tensile test.
PhysicalModel test_specimen(int points) {
  Material gauge = plain(), grip = plain();
  gauge.strain_at_break = kStrain;
  const Material materials[] = {grip, gauge};
  return with_materials(bar_geometry(points, 6 * (points - 1)), "specimen", materials,
                        by_region({{in_box({-1, -1, 0.2}, {1, 1, 0.4}), 1}}, 0));
}

constexpr double kSpecimen = 0.6;  // m

// The upper end moved by `shift` and turned by `turn` about y, everything else at rest.
PhysicalModel held(int points, const Vec3& shift, double turn) {
  PhysicalModel bar = test_specimen(points);
  const Vec3 centre(0, 0, kSpecimen);
  const Mat3 rotation = Eigen::AngleAxisd(turn, Vec3::UnitY()).toRotationMatrix();
  for (PointId p : ids_of(bar.points)) {
    Vec3& x = bar.geometry.points[p];
    const bool upper = x.z() > kSpecimen - 1e-9;
    bar.points[p].pinned = upper || x.z() < 1e-9;
    if (upper) x = centre + shift + rotation * (x - centre);
  }
  EXPECT_TRUE(settle(bar, Vec3::Zero()).converged);
  return bar;
}

struct Load {
  double force = 0.0;   // N, along the bar, on its upper end
  double moment = 0.0;  // N m, about y and the middle of that end
};

Load load_of(const PhysicalModel& bar) {
  const auto support = support_forces(bar, Vec3::Zero());
  const auto at_end = [&](PointId p) {
    return bar.points[p].pinned && bar.geometry.points[p].z() > kSpecimen / 2;
  };
  Vec3 sum = Vec3::Zero();
  int count = 0;
  for (PointId p : ids_of(bar.points))
    if (at_end(p)) sum += bar.geometry.points[p], ++count;
  Load load;
  for (PointId p : ids_of(bar.points)) {
    if (!at_end(p)) continue;
    load.force += support[p].z();
    load.moment += (bar.geometry.points[p] - sum / count).cross(support[p]).y();
  }
  return load;
}

// Largest stretch over threshold.
double share_of_strength(const PhysicalModel& bar) {
  double share = 0.0;
  for (EdgeId e : ids_of(bar.edges)) {
    const auto [a, b] = bar.geometry.edges[e];
    const double length = (bar.geometry.points[b] - bar.geometry.points[a]).norm();
    share = std::max(share, (length - bar.edges[e].rest_length) / bar.edges[e].break_threshold);
  }
  return share;
}

// Middles, as authored, of the edges that bear too much for one step of the simulation from rest;
// what breaks with them is left out.
std::vector<Vec3> broken_in_a_step(const PhysicalModel& bar, int points) {
  Lattice lattice;
  add_object(lattice, bar);
  rebuild_active(lattice);
  TimeOperator time(lattice);
  const StepReport report = time.advance(1, 1e-3 * time.largest_step(), kEmptySpace);
  const GeometricModel unbent = test_specimen(points).geometry;
  std::vector<Vec3> broken;
  for (const BreakEvent& event : report.breaks) {
    const auto [a, b] = unbent.edges[EdgeId(static_cast<std::size_t>(event.edge))];
    broken.push_back(0.5 * (unbent.points[a] + unbent.points[b]));
  }
  return broken;
}

struct FirstBreak {
  Load load;
  std::vector<Vec3> where;  // middles of the edges that break just above it, m
};

// The load at which the first edge breaks: strains are small, a secant or two meet it. A tenth of a
// percent below it the simulation breaks nothing.
template <class HeldAt>
FirstBreak first_break(const HeldAt& held_at, double amount, int points) {
  for (int round = 0; round < 2; ++round) amount /= share_of_strength(held_at(amount));
  const PhysicalModel bar = held_at(amount);
  EXPECT_NEAR(share_of_strength(bar), 1.0, 1e-6);
  EXPECT_TRUE(broken_in_a_step(held_at(0.999 * amount), points).empty());
  return {load_of(bar), broken_in_a_step(held_at(1.001 * amount), points)};
}

// Uniform tension breaks at E A strain, and somewhere in every layer of the part that can. The
// surface's springs are half as stiff, so that every edge along the bar has the same strain.
TEST(Refinement, BreaksAtTheSameTension) {
  for (int points : {3, 5, 8}) {
    const auto stretched = [&](double by) { return held(points, {0, 0, by}, 0.0); };
    const FirstBreak broken = first_break(stretched, kStrain * kSpecimen, points);
    EXPECT_NEAR(broken.load.force / (kEA * kStrain), 1.0, 0.005) << points;
    EXPECT_FALSE(broken.where.empty());
    for (const Vec3& at : broken.where) EXPECT_NEAR(at.z(), kSpecimen / 2, 0.1 + 1e-9);
  }
}

// Bent to an arc of a circle, the outermost edges strain by curvature x w / 2: the moment at the
// first break is EI strain / (w / 2), with the table's EI. Bending a few cells is as much too
// strong as it is too stiff: 22 % for two cells across, 6 % for four, 2 % for seven. What breaks is
// on the side that is stretched, -x.
TEST(Refinement, BreaksAtTheMomentOfTheTable) {
  for (const Row& row : {kShared[1], kShared[2], kShared[3]}) {
    const auto bent = [&](double turn) {  // the axis keeps its length
      const double x = kSpecimen * (1.0 - std::cos(turn)) / turn;
      const double z = kSpecimen * (std::sin(turn) / turn - 1.0);
      return held(row.points, {x, 0, z}, turn);
    };
    const FirstBreak broken = first_break(bent, 2.0 * kStrain / kWidth * kSpecimen, row.points);
    const double continuum = kEI * kStrain / (kWidth / 2.0);
    EXPECT_NEAR(broken.load.moment / continuum, row.EI, 0.005 * row.EI) << row.points;
    EXPECT_FALSE(broken.where.empty());
    for (const Vec3& at : broken.where) {
      EXPECT_NEAR(at.x(), -kWidth / 2, 1e-9);
      EXPECT_NEAR(at.z(), kSpecimen / 2, 0.1 + 1e-9);
    }
  }
}

}  // namespace
}  // namespace limber

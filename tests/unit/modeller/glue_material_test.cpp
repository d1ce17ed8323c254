#include "core/modeller/glue_material.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/analysis/equilibrium.h"
#include "core/model/errors.h"
#include "core/modeller/box_lattice.h"

namespace limber {
namespace {

Material soft() {
  return {.density = 1000.0, .youngs_modulus = 2e6, .strain_at_break = 0.01, .softening = 4.0};
}

TEST(BondLike, IsARodOfTheMaterial) {
  const GlueBond bond = bond_like(soft(), 1e-4, 0.02);
  EXPECT_DOUBLE_EQ(bond.stiffness, 5e5 * 1e-4 / 0.02);
  EXPECT_DOUBLE_EQ(bond.break_strain, 0.02);
  EXPECT_EQ(bond.crush_strain, kUnbreakable);
  EXPECT_EQ(bond.distance, 0.02);
}

// Two blocks hang on a gap of glue of their own material: the gap stretches by F L / (E A).
TEST(BondLike, StretchesAsTheMaterialInItsPlaceWould) {
  const double spacing = 0.1, gap = 0.05, side = 0.3;
  const GeometricModel block =
      box_lattice({3, 1, 3}, Vec3::Constant(spacing), Vec3::Zero(), "block");
  PhysicalModel upper = with_material(block, "upper", soft());
  const PhysicalModel lower = with_material(block, "lower", soft());
  place(upper, Mat3::Identity(), {0, spacing + gap, 0});
  // 16 bonds share the seam.
  PhysicalModel both = glue(upper, lower, bond_like(soft(), side * side / 16, gap)).model;
  for (PointId p : ids_of(both.points))
    both.points[p].pinned = both.geometry.points[p].y() > gap + 0.5 * spacing;
  const double weight = total_mass(lower) * 10.0;
  ASSERT_TRUE(settle(both, {0, -10.0, 0}).converged);
  double stretch = 0.0;
  for (std::size_t e = both.edges.size() - 16; e < both.edges.size(); ++e) {
    const auto [a, b] = both.geometry.edges[EdgeId(e)];
    stretch += ((both.geometry.points[a] - both.geometry.points[b]).norm() - gap) / 16;
  }
  EXPECT_NEAR(stretch, weight * gap / (5e5 * side * side), 1e-3 * stretch);
}

TEST(BondLike, RefusesWhatIsNoSeam) {
  EXPECT_THROW(bond_like(soft(), 0.0, 0.02), InputError);
  EXPECT_THROW(bond_like(soft(), 1e-4, NAN), InputError);
  EXPECT_THROW(bond_like(Material{}, 1e-4, 0.02), InputError);
}

}  // namespace
}  // namespace limber

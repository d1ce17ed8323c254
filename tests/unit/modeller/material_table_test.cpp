#include "core/modeller/material_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include "core/model/diagnostic_list.h"
#include "core/modeller/box_lattice.h"

namespace limber {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

TEST(MaterialTable, EveryMaterialIsSoundAndHasItsSource) {
  std::set<std::string_view> names;
  for (const NamedMaterial& m : named_materials()) {
    EXPECT_NO_THROW(require_valid(m.material, std::string(m.name)));
    EXPECT_TRUE(names.insert(m.name).second) << m.name;
    EXPECT_GT(m.source.size(), 10u) << m.name;
    EXPECT_EQ(m.material.softening, 1.0) << m.name;
    EXPECT_EQ(m.material.internal_damping, 0.0) << m.name;
  }
  EXPECT_TRUE(std::ranges::is_sorted(names));
  EXPECT_GE(names.size(), 18u);
}

// Sound in a thin bar, sqrt(E / rho), as textbooks on acoustics give it: an independent look at
// modulus and density together (Kaye and Laby: steel 5200, aluminium 5000, glass 5000 to 5300, ice
// about 3200, oak 3850, rubber 50 m/s).
TEST(MaterialTable, WaveSpeedsAreThoseOfAcoustics) {
  const auto speed = [](std::string_view name) {
    const Material& m = material_named(name).material;
    return std::sqrt(m.youngs_modulus / m.density);
  };
  EXPECT_NEAR(speed("steel"), 5200, 200);
  EXPECT_NEAR(speed("aluminium"), 5000, 200);
  EXPECT_NEAR(speed("glass"), 5200, 250);
  EXPECT_NEAR(speed("ice"), 3200, 100);
  EXPECT_NEAR(speed("oak"), 3850, 250);
  EXPECT_NEAR(speed("rubber"), 50, 10);
}

// Modulus times strain is the strength of what breaks without flowing (MPa, from the same sources).
TEST(MaterialTable, BrittleStrengthsAreModulusTimesStrain) {
  const auto strength = [](std::string_view name) {
    const Material& m = material_named(name).material;
    return m.youngs_modulus * m.strain_at_break / 1e6;
  };
  EXPECT_NEAR(strength("concrete"), 2.9, 0.05);
  EXPECT_NEAR(strength("glass"), 45, 0.5);
  EXPECT_NEAR(strength("ice"), 1.4, 0.05);
  EXPECT_NEAR(strength("oak"), 105, 1);
  EXPECT_NEAR(strength("spruce"), 70, 1);
  EXPECT_NEAR(strength("brick"), 10.5, 3.5);
  EXPECT_NEAR(strength("porcelain"), 60, 20);
}

TEST(MaterialTable, AnUnknownNameIsAnsweredWithTheNearest) {
  EXPECT_EQ(material_named("glass").name, "glass");
  try {
    material_named("porcelan");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(error.diagnostic.where, "material porcelan");
    EXPECT_THAT(error.diagnostic.remedy, HasSubstr("did you mean porcelain?"));
  }
}

TEST(MaterialTable, GoesStraightIntoALattice) {
  Material glass = material_named("glass").material;
  glass.softening = 100;
  const PhysicalModel cube = with_material(
      box_lattice({1, 1, 1}, Vec3::Constant(0.1), Vec3::Zero(), "cube"), "cube", glass);
  EXPECT_NEAR(total_mass(cube), 2.5, 1e-12);
}

constexpr std::string_view kUnchecked = "typical value, not checked against a primary source";

// A row of the table, the modulus in GPa.
std::string row(const NamedMaterial& m) {
  const Material& s = m.material;
  return say("| ", m.name, " | ", s.density, " | ", s.youngs_modulus / 1e9, " | ", s.poisson_ratio,
             " | ", s.strain_at_break, " | ", s.damping_ratio, " | ", s.friction, " | ",
             s.restitution, " | ", word_for(m.basis), " | ", m.source, m.remark.empty() ? "" : "; ",
             m.remark, " | ", m.checked.empty() ? kUnchecked : m.checked, " |\n");
}

TEST(MaterialTable, IsWhatTheDocumentSays) {
  std::ifstream file(LIMBER_TEST_DATA "/../../docs/materials.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  std::string table;
  for (const NamedMaterial& m : named_materials()) table += row(m);
  EXPECT_THAT(text, EndsWith("|---|---|---|---|---|---|---|---|---|---|---|\n" + table));
}

}  // namespace
}  // namespace limber

#include "core/modeller/material_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/dynamics/lattice.h"
#include "core/modeller/box_lattice.h"
#include "core/modeller/cell_stiffness.h"
#include "core/modeller/material_table.h"
#include "core/modeller/thin_material.h"

namespace limber {
namespace {

using ::testing::HasSubstr;

Material clay() {
  Material m;
  m.density = 2000.0;
  m.youngs_modulus = 1e9;
  m.strain_at_break = 1e-3;
  m.damping_ratio = 0.2;
  return m;
}

PhysicalModel box(const Vec3& spacing, const Material& material) {
  return with_material(box_lattice({4, 3, 2}, spacing, Vec3::Zero(), "box"), "box", material);
}

// Springs have G = E / 2.5 and K = E / 1.5, by definition of these for Poisson ratio 1/4.
TEST(PoissonMiss, ComparesShearAndBulkModuli) {
  for (double nu : {0.0, 0.2, 0.25, 0.37, 0.499}) {
    const double shear = 1.0 / (2.0 * (1.0 + nu)), bulk = 1.0 / (3.0 * (1.0 - 2.0 * nu));
    EXPECT_NEAR(poisson_miss(nu).shear_ratio, (1.0 / 2.5) / shear, 1e-12);
    EXPECT_NEAR(poisson_miss(nu).bulk_ratio, (1.0 / 1.5) / bulk, 1e-12);
  }
}

TEST(MaterialReport, OfCubesIsClean) {
  const PhysicalModel model = box(Vec3::Constant(0.02), clay());
  const MaterialReport report = material_report(model);
  EXPECT_EQ(report.solid_cells, 24u);
  EXPECT_LT(report.worst_anisotropy, 1e-9);
  EXPECT_NEAR(report.worst_elongation, 1.0, 1e-9);
  EXPECT_EQ(report.long_cells, 0u);
  EXPECT_EQ(report.slack_edges, 0u);
  Material quarter = clay();  // nu = 1/4
  EXPECT_TRUE(modelling_notes(model, report, {&quarter, 1}).empty());
}

TEST(MaterialReport, SeesLongCells) {
  const PhysicalModel within = box({0.0173, 0.01, 0.01}, clay());
  EXPECT_EQ(material_report(within).long_cells, 0u);
  const PhysicalModel beyond = box({0.0174, 0.01, 0.01}, clay());
  EXPECT_EQ(material_report(beyond).long_cells, 24u);
  const PhysicalModel needles = box({0.04, 0.01, 0.01}, clay());
  const MaterialReport report = material_report(needles);
  EXPECT_NEAR(report.worst_elongation, 4.0, 1e-9);
  EXPECT_GT(report.worst_anisotropy, 0.15);
  EXPECT_DOUBLE_EQ(report.worst_anisotropy, report.median_anisotropy);  // all cells are alike
  const auto notes = modelling_notes(needles, report);
  ASSERT_GE(notes.size(), 2u);
  EXPECT_EQ(notes[0].where, "box: cells");
  EXPECT_THAT(notes[0].what, HasSubstr("24 of 24 are longer than 1.732 times their width (the "
                                       "longest 4 times)"));
  EXPECT_THAT(notes[1].what, HasSubstr("depends on direction"));
}

TEST(MaterialReport, CountsSlackEdges) {
  PhysicalModel model = box(Vec3::Constant(0.02), clay());
  for (std::size_t e = 0; e < 10; ++e) model.edges[EdgeId(e)].stiffness = 0.0;
  const MaterialReport report = material_report(model);
  EXPECT_EQ(report.slack_edges, 10u);
  const auto notes = modelling_notes(model, report);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_THAT(notes[0].what, HasSubstr("10 of "));
}

// The compiled lattice is another way to the same step; without contact it has a safety margin.
TEST(MaterialReport, CountsSubstepsAsTheSimulatorWould) {
  Material softened = clay();
  softened.softening = 100.0;
  PhysicalModel model = box(Vec3::Constant(0.02), softened);
  model.object.contact_share = 0.0;
  const MaterialReport report = material_report(model);
  const MaterialReport real = material_report(box(Vec3::Constant(0.02), clay()));
  EXPECT_NEAR(report.substeps_per_tick_unsoftened, real.substeps_per_tick, 1.0);
  EXPECT_NEAR(real.substeps_per_tick, 10.0 * report.substeps_per_tick, 10.0);
  Lattice lattice;
  add_object(lattice, model);
  const double simulated = kReportTick / lattice.objects[0].largest_step;
  EXPECT_LE(report.substeps_per_tick, std::ceil(simulated));
  EXPECT_GE(report.substeps_per_tick, 0.8 * simulated);
  const auto notes = modelling_notes(model, report);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_THAT(notes[0].what, HasSubstr("S is 100: "));
}

TEST(ModellingNotes, SayByHowMuchARubberMisses) {
  const PhysicalModel model = box(Vec3::Constant(0.02), material_named("rubber").material);
  const std::vector<Material> materials = {clay(), material_named("rubber").material};
  const auto notes = modelling_notes(model, material_report(model), materials);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0].where, "box: material 1");
  EXPECT_THAT(notes[0].what, HasSubstr("its Poisson ratio is 0.499"));
  EXPECT_THAT(notes[0].what, HasSubstr("shear modulus is 19.9 % too high"));
  EXPECT_THAT(notes[0].what, HasSubstr("bulk modulus 99.6 % too low"));
}

// In plane stress G = E / (2 (1 + nu)) and the modulus against a change of area is
// (C_1111 + C_1122) / 2 with C_1111 = E / (1 - nu^2), C_1122 = nu C_1111.
TEST(PoissonMiss, OfSheetsComparesPlaneModuli) {
  const auto shear = [](double nu) { return 1.0 / (2.0 * (1.0 + nu)); };
  const auto area = [](double nu) { return (1.0 + nu) / (2.0 * (1.0 - nu * nu)); };
  for (double nu : {0.0, 0.2, 1.0 / 3.0, 0.499}) {
    EXPECT_NEAR(sheet_poisson_miss(nu).shear_ratio, shear(1.0 / 3.0) / shear(nu), 1e-12);
    EXPECT_NEAR(sheet_poisson_miss(nu).bulk_ratio, area(1.0 / 3.0) / area(nu), 1e-12);
  }
}

// One square with its diagonals, a metre above the origin.
PhysicalModel square_sheet(const Material& material) {
  GeometricModelBuilder builder;
  builder.begin_subobject("square");
  std::array<PointId, 4> p;
  for (int i = 0; i < 4; ++i) p[i] = builder.add_point(Vec3(i == 1 || i == 2, i > 1, 1.0));
  const std::array<std::array<PointId, 2>, 6> edges = {
      {{p[0], p[1]}, {p[1], p[2]}, {p[2], p[3]}, {p[3], p[0]}, {p[0], p[2]}, {p[1], p[3]}}};
  builder.add_cell(edges, split_square(p));
  return with_sheet_material(builder.finish(), "sheet", material, {.thickness = 1e-3});
}

TEST(ModellingNotes, CompareSheetsWithAThird) {
  Material metal = clay();
  metal.poisson_ratio = 0.33;
  const PhysicalModel right = square_sheet(metal);
  const MaterialReport report = material_report(right);
  EXPECT_EQ(report.solid_cells, 0u);
  EXPECT_EQ(report.sheet_cells, 1u);
  EXPECT_TRUE(modelling_notes(right, report, {&metal, 1}).empty());
  metal.poisson_ratio = 0.2;
  const auto notes = modelling_notes(right, report, {&metal, 1});
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0].where, "sheet: material");
  EXPECT_THAT(notes[0].what, HasSubstr("that of springs in a sheet is 1/3: the shear modulus is "
                                       "10 % too low, the modulus against a change of area 20 %"));
}

TEST(ModellingNotes, SayNothingOfShearInRopes) {
  GeometricModelBuilder builder;
  builder.begin_subobject("rope");
  builder.edge(builder.add_point(Vec3::Zero()), builder.add_point(Vec3::UnitX()));
  Material soft = clay();
  soft.poisson_ratio = 0.45;
  const PhysicalModel rope = with_rope_material(builder.finish(), "rope", soft, 1e-4);
  EXPECT_TRUE(modelling_notes(rope, material_report(rope), {&soft, 1}).empty());
}

TEST(ModellingNotes, RoundForPeople) {
  const PhysicalModel model = box(Vec3::Constant(0.02), clay());
  MaterialReport report = material_report(model);
  report.softening = 1234567.0;
  report.substeps_per_tick = 12.0;
  report.substeps_per_tick_unsoftened = 12345678901.0;
  const auto notes = modelling_notes(model, report);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_THAT(notes[0].what, HasSubstr("S is 1234567: 12 substeps a tick of 1/60 s instead of "
                                       "12345678901; "));
  EXPECT_THAT(notes[0].what, HasSubstr("multiplied by 1111"));
}

TEST(MaterialReport, OfAModelWithoutCellsOrSpringsIsEmpty) {
  GeometricModelBuilder builder;
  builder.begin_subobject("dust");
  builder.add_point(Vec3::Zero());
  PhysicalModel dust = with_default_attributes(builder.finish(), "dust");
  dust.points[PointId(0ul)].mass = 1.0;
  const MaterialReport report = material_report(dust);
  EXPECT_EQ(report.solid_cells, 0u);
  EXPECT_EQ(report.substeps_per_tick, 0.0);
  EXPECT_TRUE(modelling_notes(dust, report).empty());
}

}  // namespace
}  // namespace limber

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/model/validate.h"
#include "core/modeller/material_table.h"
#include "core/storage/model_file.h"
#include "demos/cli/cli_main.h"
#include "demos/cli/model_report.h"
#include "tests/support/meshes.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit_demos/said.h"

namespace limber::demos {
namespace {

using test::limber;
using test::Said;
using test::TemporaryFolder;
using testing::HasSubstr;

// A box of 0.4 x 0.2 x 0.2 in the unit of the file.
class ModelCommand : public testing::Test {
 protected:
  void SetUp() override {
    test::write_obj(test::box_mesh(Vec3(-0.2, 0.0, -0.1), Vec3(0.2, 0.2, 0.1)), mesh_);
  }

  const TemporaryFolder folder_;
  const std::string mesh_ = (folder_ / "box.obj").string();
  const std::string file_ = (folder_ / "box.limber").string();
};

TEST_F(ModelCommand, MakesALatticeOfTheMaterialWithTheMeshAsItsSkin) {
  const Said said = limber({"model", mesh_, "--spacing", "0.05", "--material", "terracotta",
                            "--softening", "100", "-o", file_});
  ASSERT_EQ(said.code, 0) << said.err;
  const PhysicalModel model = read_model(file_);
  EXPECT_EQ(model.cells.size(), 8u * 4 * 4);
  EXPECT_EQ(model.skins.size(), 1u);
  EXPECT_NEAR(total_mass(model), material_named("terracotta").material.density * 0.016, 1e-9);
  EXPECT_EQ(model.object.softening, 100.0);
}

TEST_F(ModelCommand, SaysHowWellItFitsAndWhatItCosts) {
  const Said said = limber({"model", mesh_, "--spacing", "0.05", "--softening", "100"});
  EXPECT_EQ(said.code, 0);
  EXPECT_THAT(said.out, testing::ContainsRegex("volume, m.3 +0.016 +0.016 "));
  EXPECT_THAT(said.out, HasSubstr("softening S 100"));
  EXPECT_THAT(said.out, HasSubstr("Poisson ratio is 0.2"));
  EXPECT_EQ(folder_.files(), 1u);  // the mesh
}

TEST_F(ModelCommand, TakesAnotherUnit) {
  const Said said = limber({"model", mesh_, "--scale", "0.1", "--spacing", "0.005", "-o", file_});
  ASSERT_EQ(said.code, 0) << said.err;
  EXPECT_NEAR(total_mass(read_model(file_)), material_named("porcelain").material.density * 1.6e-5,
              1e-9);
}

TEST_F(ModelCommand, IsDroppedByRun) {
  ASSERT_EQ(limber({"model", mesh_, "--softening", "1000", "-o", file_}).code, 0);
  const Said said = limber({"run", file_, "--seconds", "0.1", "--set", "height=0.5"});
  EXPECT_EQ(said.code, 0) << said.err;
  EXPECT_THAT(said.out, HasSubstr("rigid"));
}

TEST_F(ModelCommand, DropRefusesNothingAndWhatStartsBelowTheFloor) {
  PhysicalModel nothing;
  nothing.name = "nothing";
  write_model(nothing, file_);
  EXPECT_EQ(limber({"run", file_}).code, 2);
  EXPECT_THAT(limber({"run", file_}).err, HasSubstr("no points"));
  ASSERT_EQ(limber({"model", mesh_, "--softening", "1000", "-o", file_}).code, 0);
  EXPECT_EQ(limber({"run", file_, "--set", "height=-1"}).code, 2);
  EXPECT_EQ(limber({"run", file_, "--json", file_}).code, 2);
  EXPECT_EQ(limber({"info", file_, "--json", file_}).code, 2);
  EXPECT_EQ(read_model(file_).skins.size(), 1u);  // still there
}

TEST_F(ModelCommand, GivesTheSameFactsToPrograms) {
  const Said said =
      limber({"model", mesh_, "--spacing", "0.05", "--softening", "100", "--json", "-"});
  ASSERT_EQ(said.code, 0) << said.err;
  const auto json = nlohmann::json::parse(said.out);  // and nothing else
  EXPECT_EQ(json["mesh"], mesh_);
  EXPECT_EQ(json["material"], "porcelain");
  EXPECT_EQ(json["cells"], 128);
  EXPECT_EQ(json["spacing_m"], 0.05);
  EXPECT_NEAR(json["mass_kg"].get<double>(), material_named("porcelain").material.density * 0.016,
              1e-9);
  EXPECT_NEAR(json["fit"]["volume_error"].get<double>(), 0.0, 1e-6);  // positions are floats
  EXPECT_GT(json["substeps_per_tick_unsoftened"], json["substeps_per_tick"]);
  EXPECT_TRUE(json["output"].is_null());
  EXPECT_THAT(json["notes"].dump(), HasSubstr("Poisson"));
  EXPECT_EQ(limber({"model", mesh_, "--json", mesh_}).code, 2);
  EXPECT_EQ(limber({"model", mesh_, "--json", file_, "-o", file_}).code, 2);
}

TEST_F(ModelCommand, SaysNothingOfItsProgressInAPipe) {
  const Said said = limber({"model", mesh_, "--spacing", "0.05"});
  EXPECT_EQ(said.err, "");
}

TEST_F(ModelCommand, NotesNameTheFile) {
  const Said said = limber({"model", mesh_, "--spacing", "0.05"});
  EXPECT_THAT(said.out, HasSubstr("note: " + mesh_ + ": material: its Poisson ratio"));
  EXPECT_THAT(limber({"model", mesh_, "--spacing", "1"}).err,
              HasSubstr("limber: " + mesh_ + ": is thinner than a cell"));
}

TEST_F(ModelCommand, AsksWhetherTheUnitIsRight) {
  const Said large = limber({"model", mesh_, "--scale", "1000", "--spacing", "50"});
  EXPECT_EQ(large.code, 0);
  EXPECT_THAT(large.err, HasSubstr("it is 400 m long"));
  EXPECT_THAT(large.err, HasSubstr("--scale 0.001 for millimetres"));
  EXPECT_THAT(limber({"model", mesh_, "--scale", "0.001", "--spacing", "5e-5"}).err,
              HasSubstr("it is 0.0004 m long"));
}

TEST(CountNotes, SayHowManyCellsThereWillBeAndWhatToAskFor) {
  EXPECT_TRUE(count_notes("a", 1e-3, 2e-3).empty());  // 125,000
  const auto notes = count_notes("a", 1e-3, 1e-3);    // a million
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_THAT(notes[0].what, HasSubstr("1,000,000 cells of 0.001 m"));
  EXPECT_THAT(notes[0].remedy, HasSubstr("--spacing 0.0037 makes about 20,000"));
}

TEST_F(ModelCommand, SaysWhatIsTooSoftToLandBeforeItLands) {
  const Said made =
      limber({"model", mesh_, "--material", "gelatine", "--spacing", "0.05", "-o", file_});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("cells are crushed"));
  const Said run = limber({"run", file_, "--seconds", "0.02", "--json", "-"});
  EXPECT_THAT(run.err, HasSubstr("note: " + file_ + ": box: it is too soft to land at 4.43 m/s"));
  EXPECT_THAT(nlohmann::json::parse(run.out)["notes"].dump(), HasSubstr("too soft"));
  EXPECT_EQ(limber({"run", file_, "--seconds", "0.02", "--set", "height=0"}).code, 0);
  ASSERT_EQ(limber({"model", mesh_, "--spacing", "0.05", "-o", file_}).code, 0);
  EXPECT_EQ(limber({"run", file_, "--seconds", "0.02"}).err, "");
}

TEST_F(ModelCommand, ListsTheMaterials) {
  const Said said = limber({"model", "--materials"});
  EXPECT_EQ(said.code, 0);
  for (const NamedMaterial& named : named_materials()) {
    EXPECT_THAT(said.out, HasSubstr(std::string(named.name)));
  }
}

TEST_F(ModelCommand, RefusesWhatMakesNoSense) {
  const std::vector<std::vector<std::string>> wrong = {
      {"model"},
      {"model", (folder_ / "none.obj").string()},
      {"model", mesh_, "--material", "porcelane"},
      {"model", mesh_, "--spacing", "-1"},
      {"model", mesh_, "--spacing", "nan"},
      {"model", mesh_, "--spacing", "1"},
      {"model", mesh_, "--softening", "0.5"},
      {"model", mesh_, "--scale", "0"},
      {"model", mesh_, "--scale", "1e30"},
      {"model", mesh_, "--spacing", "1e30"},
      {"model", mesh_, "--softening", "1e30"},
      {"model", mesh_, "--damping-ratio", "1e30"},
      {"model", mesh_, "--internal-damping", "1e30"},
      {"model", mesh_, "-o", (folder_ / "none" / "a.limber").string()},
      {"model", mesh_, "-o", mesh_},
  };
  for (const auto& arguments : wrong) {
    const Said said = limber(arguments);
    EXPECT_EQ(said.code, 2) << arguments.back();
    EXPECT_EQ(std::count(said.err.begin(), said.err.end(), '\n'), 1) << said.err;
  }
  EXPECT_THAT(limber(wrong[2]).err, HasSubstr("porcelain"));
  EXPECT_FALSE(std::filesystem::exists(file_));
}

}  // namespace
}  // namespace limber::demos

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "core/model/validate.h"
#include "core/modeller/material_table.h"
#include "core/storage/model_file.h"
#include "demos/cli/cli_main.h"
#include "tests/support/meshes.h"
#include "tests/support/temporary_folder.h"

namespace limber::demos {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

struct Said {
  int code;
  std::string out, err;
};

Said limber(const std::vector<std::string>& arguments) {
  std::vector<const char*> argv = {"limber"};
  for (const std::string& a : arguments) argv.push_back(a.c_str());
  std::ostringstream out, err;
  const int code = cli_main(static_cast<int>(argv.size()), argv.data(), out, err);
  return {code, out.str(), err.str()};
}

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

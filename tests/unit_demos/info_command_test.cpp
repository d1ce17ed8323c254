#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/storage/model_file.h"
#include "demos/cli/cli_main.h"
#include "demos/cli/info_report.h"
#include "demos/cli/model_facts.h"
#include "tests/support/blocks.h"
#include "tests/support/same_model.h"
#include "tests/support/temporary_folder.h"

namespace limber::demos {
namespace {

using test::contents;
using test::TemporaryFolder;
using testing::HasSubstr;

struct Said {
  int code;
  std::string out, err;
};

Said info(const std::vector<std::string>& arguments) {
  std::vector<const char*> argv = {"limber", "info"};
  for (const std::string& a : arguments) argv.push_back(a.c_str());
  std::ostringstream out, err;
  const int code = cli_main(static_cast<int>(argv.size()), argv.data(), out, err);
  return {code, out.str(), err.str()};
}

// Puts other bytes for a number that occurs once in the file, and seals it again.
void replace_number(const std::filesystem::path& file, double old, double by) {
  std::string text = contents(file);
  const std::string bytes(reinterpret_cast<const char*>(&old), sizeof old);
  const std::size_t at = text.find(bytes, kSealBytes);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, sizeof by, reinterpret_cast<const char*>(&by), sizeof by);
  test::write(file, text);
  const int descriptor = ::open(file.c_str(), O_RDWR);
  seal(descriptor, "model", kModelFileVersion, file);
  ::close(descriptor);
}

class InfoCommand : public testing::Test {
 protected:
  const TemporaryFolder folder_;
  const std::string file_ = (folder_ / "a.limber").string();
};

TEST_F(InfoCommand, SaysWhatIsInAModelFile) {
  write_model(test::rich_model(), file_);
  const Said said = info({file_});
  EXPECT_EQ(said.code, 0) << said.err;
  EXPECT_EQ(said.err, "");
  for (const char* text :
       {"limber model, version 1", "rich", "left", "right", "glue: left + right", "softening S",
        "40.4 (real modulus / simulated)", "longest stable", "valid: every invariant holds"})
    EXPECT_THAT(said.out, HasSubstr(text));
}

// Against numbers that follow from the shape: 12 points of 1 kg on a box of 2 x 1 x 1 m.
TEST_F(InfoCommand, GivesTheFactsAsJson) {
  PhysicalModel model = test::block({.cells = {2, 1, 1}, .origin = {1, 2, 3}});
  model.edges[EdgeId(0)].break_threshold = 0.05;
  model.points[PointId(4)].pinned = true;
  write_model(model, file_);
  const Said said = info({file_, "--json", "-"});
  EXPECT_EQ(said.code, 0) << said.err;
  const auto json = nlohmann::json::parse(said.out);
  EXPECT_EQ(json["kind"], "model");
  EXPECT_EQ(json["version"], 1);
  EXPECT_EQ(json["bytes"], std::filesystem::file_size(file_));
  EXPECT_EQ(json["points"], 12);
  EXPECT_EQ(json["cells"], 2);
  EXPECT_EQ(json["subobjects"].size(), 1u);
  EXPECT_EQ(json["subobjects"][0]["edges"], model.edges.size());
  EXPECT_EQ(json["lowest_m"], nlohmann::json({1, 2, 3}));
  EXPECT_EQ(json["highest_m"], nlohmann::json({3, 3, 4}));
  EXPECT_DOUBLE_EQ(json["mass_kg"], 12.0);
  EXPECT_DOUBLE_EQ(json["com_m"][0], 2.0);
  EXPECT_DOUBLE_EQ(json["break_threshold_m"][0], 0.05);
  EXPECT_DOUBLE_EQ(json["break_threshold_m"][1], 0.1);
  EXPECT_TRUE(json["crush_threshold_m"].is_null());
  EXPECT_EQ(json["unbreakable_edges"], 0);
  EXPECT_EQ(json["pinned_points"], 1);
  EXPECT_GT(json["stable_step_s"], 0.0);
}

TEST_F(InfoCommand, CountsWhatIsBrokenAndSkins) {
  write_model(test::rich_model(), file_);
  const auto json = nlohmann::json::parse(info({file_, "--json", "-"}).out);
  const PhysicalModel model = test::rich_model();
  EXPECT_EQ(json["broken_edges"], std::count_if(model.edges.begin(), model.edges.end(),
                                                [](auto& e) { return e.broken; }));
  EXPECT_EQ(json["invalid_cells"], std::count_if(model.cells.begin(), model.cells.end(),
                                                 [](auto& c) { return !c.valid; }));
  EXPECT_EQ(json["skins"]["skins"], 3);
  EXPECT_EQ(json["skins"]["triangles"], 4);
  EXPECT_EQ(json["softening"], 40.4);
  EXPECT_GT(json["broken_edges"], 0);
}

// 57 bytes of a name are shown, but never a part of a character: 1 + 18 x 3 and 3 + 18 x 3.
TEST_F(InfoCommand, CutsLongNamesBetweenCharacters) {
  const auto euros = [](int n) {
    std::string text;
    for (int i = 0; i < n; ++i) text += "\xe2\x82\xac";
    return text;
  };
  for (const char* start : {"a", "abc"}) {
    PhysicalModel model = test::block({});
    model.name = start + euros(30);
    write_model(model, file_);
    EXPECT_THAT(info({file_}).out, HasSubstr("\"" + (start + euros(18)) + "...\"\n"));
  }
}

TEST_F(InfoCommand, WritesTheJsonBesideTheTable) {
  write_model(test::block({}), file_);
  const std::string target = (folder_ / "a.json").string();
  EXPECT_THAT(info({file_, "--json", target}).out, HasSubstr("softening S"));
  EXPECT_EQ(nlohmann::json::parse(contents(target))["name"], "block");
}

TEST_F(InfoCommand, ListsEverythingThatIsWrong) {
  PhysicalModel model = test::block({});
  model.points[PointId(2)].mass = 1234.5;
  model.points[PointId(5)].mass = 2345.6;
  write_model(model, file_);
  replace_number(file_, 1234.5, -1.0);
  replace_number(file_, 2345.6, std::numeric_limits<double>::quiet_NaN());
  const Said said = info({file_, "--json", (folder_ / "a.json").string()});
  EXPECT_EQ(said.code, 2);
  EXPECT_EQ(said.out, "");
  EXPECT_THAT(said.err, HasSubstr("limber: block: point 2: P2 mass is -1 kg"));
  EXPECT_THAT(said.err, HasSubstr("limber: block: point 5: P2 mass is nan kg"));
  EXPECT_THAT(said.err, HasSubstr("holds a model with 2 errors (above)"));
  EXPECT_EQ(std::count(said.err.begin(), said.err.end(), '\n'), 3);
  EXPECT_EQ(folder_.files(), 1u);
}

TEST_F(InfoCommand, RefusesWhatIsNoModelFile) {
  test::write(file_, "solid cube\n");
  const Said said = info({file_});
  EXPECT_EQ(said.code, 2);
  EXPECT_EQ(said.out, "");
  EXPECT_EQ(said.err, "limber: " + file_ +
                          ": is not a file of Limber's; name a file that Limber wrote, whole\n");
  EXPECT_EQ(info({file_ + "x"}).code, 2);
  EXPECT_EQ(info({(folder_ / "").string()}).code, 2);
  EXPECT_EQ(info({}).code, 2);
  EXPECT_EQ(info({file_, "--policy", "rigid"}).code, 2);
}

TEST_F(InfoCommand, ShowsNamesWithoutWhatTerminalsObey) {
  EXPECT_EQ(printable("a\x1b[2Jb\nc\x7f \xc3\xbc"), "a?[2Jb?c? \xc3\xbc");
  PhysicalModel model = test::block({});
  model.name = "evil\x1b[31m";
  model.geometry.subobjects[0].name = std::string(1000, 'x');
  write_model(model, file_);
  const Said said = info({file_});
  EXPECT_EQ(said.out.find('\x1b'), std::string::npos);
  EXPECT_EQ(said.out.find(std::string(61, 'x')), std::string::npos);
}

TEST(ModelFacts, KnowModelsWithoutAnything) {
  const ModelFacts facts = model_facts(PhysicalModel());
  EXPECT_EQ(facts.count.points, 0u);
  EXPECT_TRUE(facts.stiffness.empty());
  EXPECT_EQ(facts.mass_kg, 0.0);
}

// Two points of 1 kg on one spring: omega^2 = k (1 / m + 1 / m), the step at most 2 / omega.
// Contacts of the object and the distance that the simulator keeps from the bound take a tenth of
// it.
TEST(ModelFacts, StepFitsTheSpring) {
  constexpr double kStiffness = 1e6;  // N/m; contacts count little beside it
  GeometricModelBuilder builder;
  builder.begin_subobject("pair");
  builder.edge(builder.add_point({0, 0, 0}), builder.add_point({1, 0, 0}));
  PhysicalModel model = test::with_plausible_attributes(builder.finish(), "pair");
  model.edges[EdgeId(0)].stiffness = kStiffness;
  model.edges[EdgeId(0)].damping = 0.0;
  const ModelFacts facts = model_facts(model);
  const double bound = 2.0 / std::sqrt(2.0 * kStiffness);
  EXPECT_LE(facts.stable_step_s, bound);
  EXPECT_GE(facts.stable_step_s, 0.85 * bound);
  EXPECT_EQ(facts.damping_ratio, 0.0);
}

}  // namespace
}  // namespace limber::demos

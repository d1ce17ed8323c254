#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "demos/cli/body_groups.h"
#include "demos/cli/report_json.h"
#include "demos/cli/report_tables.h"

namespace limber::demos {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

ComparedRuns example(std::size_t runs_of_each) {
  RunResult run;
  run.scene = "pot";
  run.wall_s = 2.0;
  run.spring_updates = 1000;
  run.total_mass = 1.0;
  run.piece_masses = {1.0};
  run.softening = 2000.0;
  ComparedRuns runs;
  runs.flexible.assign(runs_of_each, run);
  run.wall_s = 1.0;
  runs.switching.assign(runs_of_each, run);
  runs.spring_rate = 1000.0;
  return runs;
}

json parsed_comparison(const ComparedRuns& runs) {
  return json::parse(comparison_json(runs, compare(runs)));
}

// Every key that the contract promises.
constexpr const char* kPromised[] = {"/scene",
                                     "/seconds",
                                     "/tick",
                                     "/bodies",
                                     "/points",
                                     "/springs",
                                     "/flexible/wall_s",
                                     "/flexible/spring_updates",
                                     "/flexible/broken_edges",
                                     "/flexible/fragments",
                                     "/flexible/first_break_s",
                                     "/switching/wall_s",
                                     "/switching/spring_updates",
                                     "/switching/broken_edges",
                                     "/switching/fragments",
                                     "/switching/first_break_s",
                                     "/switching/flexible_share",
                                     "/switching/to_flexible",
                                     "/switching/to_rigid",
                                     "/switching/missed",
                                     "/switching/needless",
                                     "/speedup",
                                     "/error/com_rel",
                                     "/error/rotation_rad",
                                     "/error/fragment_mass_l1",
                                     "/pieces/flexible",
                                     "/pieces/switching",
                                     "/pieces/largest_rel",
                                     "/pieces/debris_rel",
                                     "/noise",
                                     "/ledger/momentum_rel",
                                     "/ledger/angular_momentum_rel",
                                     "/ledger/energy_in_J",
                                     "/ledger/energy_out_J",
                                     "/ledger/energy_stored_J",
                                     "/ledger/energy_discarded_J",
                                     "/ledger/energy_unaccounted_rel",
                                     "/softening",
                                     "/baseline_efficiency"};

TEST(ComparisonJson, HoldsEveryPromisedKey) {
  const json j = parsed_comparison(example(1));
  for (const char* key : kPromised) {
    EXPECT_TRUE(j.contains(json::json_pointer(key))) << key;
  }
  EXPECT_EQ(j["speedup"], 2.0);
  EXPECT_EQ(j["softening"], 2000.0);
  EXPECT_EQ(j["baseline_efficiency"], 0.5);
}

TEST(ComparisonJson, IsNullWhereNothingWasMeasured) {
  const json j = parsed_comparison(example(1));
  EXPECT_TRUE(j["noise"].is_null());
  EXPECT_TRUE(j["median_speedup"].is_null());
  EXPECT_TRUE(j["flexible"]["first_break_s"].is_null());
  EXPECT_TRUE(j["switching"]["missed"].is_null());
  EXPECT_TRUE(j["ledger"]["momentum_rel"].is_null());  // there was no hand-over
  EXPECT_TRUE(j["error"]["com_rel"].is_null());        // there was no sample
  EXPECT_EQ(j["ledger"]["energy_discarded_J"], 0.0);
}

TEST(ComparisonJson, HoldsTheNoiseOnceMeasured) {
  const json j = parsed_comparison(example(3));
  EXPECT_EQ(j["noise"]["runs"], 3);
  EXPECT_EQ(j["noise"]["fragment_mass_l1"], 0.0);
  EXPECT_TRUE(j["noise"].contains("com_rel"));
  EXPECT_TRUE(j["noise"].contains("rotation_rad"));
}

TEST(ComparisonReport, ShowsNoSpeedupWithoutWhatItHoldsFor) {
  const ComparedRuns runs = example(1);
  const std::string text = comparison_report(runs, compare(runs));
  EXPECT_THAT(text, HasSubstr("softening S          2000"));
  EXPECT_THAT(text, HasSubstr("not measured; --noise 5 measures it"));
  EXPECT_THAT(text, HasSubstr("baseline efficiency  0.5"));
}

TEST(ComparisonReport, ShowsTheNoiseBesideTheError) {
  const ComparedRuns runs = example(2);
  const std::string text = comparison_report(runs, compare(runs));
  EXPECT_THAT(text, HasSubstr("(2 flexible runs)"));
  EXPECT_THAT(text, Not(HasSubstr("not measured; --noise")));
}

RunResult example_run() {
  RunResult run = example(1).switching[0];
  run.seconds = 4.0;
  run.state_hash = 0xabcULL;
  run.to_flexible = 1;
  run.ledger.momentum_rel = 1e-12;
  run.switches = {{0.5, "pot", true, "load", {{"approach_m_s", 3.4}}}};
  run.summaries = {{"pot\xff", "mixed", 1.0, Vec3(1, 2, 3), Vec3(4, 5, 6), 7, 8}};
  return run;
}

TEST(RunJson, HoldsEveryPromisedKey) {
  const json j = json::parse(run_json(example_run(), Policy::kRigid));
  for (const char* key : {"/scene", "/seconds", "/wall_s", "/real_time_factor", "/state_hash",
                          "/bodies/0/name", "/bodies/0/representation", "/bodies/0/mass_kg",
                          "/bodies/0/com_m", "/bodies/0/velocity_m_s", "/bodies/0/broken_edges",
                          "/bodies/0/fragments", "/bodies/0/softening", "/softening",
                          "/piece_masses_kg", "/notes", "/ledger/momentum_rel"}) {
    EXPECT_TRUE(j.contains(json::json_pointer(key))) << key;
  }
  EXPECT_EQ(j["state_hash"], "0000000000000abc");
  EXPECT_EQ(j["real_time_factor"], 4.0);
  EXPECT_EQ(j["policy"], "rigid");
  EXPECT_EQ(j["bodies"][0]["com_m"], json({1.0, 2.0, 3.0}));
  EXPECT_EQ(j["ledger"]["momentum_rel"], 1e-12);
}

TEST(RunJson, ListsTheSwitches) {
  const json j = json::parse(run_json(example_run(), Policy::kSwitching));
  EXPECT_EQ(j["switches"], json::parse(R"([{"time_s": 0.5, "body": "pot", "to": "flexible",
      "cause": "load", "numbers": {"approach_m_s": 3.4}}])"));
}

TEST(RunJson, IsNullForWhatIsNotFinite) {
  RunResult run = example_run();
  run.highest_rise_m = std::nan("");
  EXPECT_TRUE(json::parse(run_json(run, Policy::kSwitching))["highest_rise_m"].is_null());
}

TEST(RunJson, HasTheSofteningOfEachBodyAndTheLargest) {
  RunResult run = example_run();
  run.summaries.push_back(run.summaries[0]);
  run.summaries[0].softening = 1.0;
  run.summaries[1].softening = 2000.0;
  const json j = json::parse(run_json(run, Policy::kSwitching));
  EXPECT_EQ(j["bodies"][0]["softening"], 1.0);
  EXPECT_EQ(j["bodies"][1]["softening"], 2000.0);
  EXPECT_EQ(j["softening"], 2000.0);
}

BodySummary leaf(int i, const std::string& representation) {
  return {fmt::format("leaf {}", i), representation, 2.0, Vec3(i, 0, 0), Vec3(0, i, 0), 3, 1, 4.0};
}

TEST(GroupedBodies, AddsUpManyOfAKind) {
  std::vector<BodySummary> bodies = {leaf(1, "rigid"), leaf(2, "rigid"), leaf(3, "flexible"),
                                     leaf(4, "rigid")};
  bodies.insert(bodies.begin() + 1, {"pot 2", "mixed", 1.0, Vec3(1, 2, 3), Vec3(4, 5, 6), 7, 8});
  const std::vector<BodySummary> rows = grouped_bodies(bodies);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].name, "4 x leaf");
  EXPECT_EQ(rows[0].representation, "1 flexible, 3 rigid");
  EXPECT_EQ(rows[0].mass_kg, 8.0);
  EXPECT_EQ(rows[0].centre_of_mass, Vec3(2.5, 0, 0));
  EXPECT_EQ(rows[0].velocity, Vec3(0, 2.5, 0));
  EXPECT_EQ(rows[0].broken_edges, 12u);
  EXPECT_EQ(rows[0].fragments, 4u);
  EXPECT_EQ(rows[0].softening, 4.0);
  EXPECT_EQ(rows[1].name, "pot 2");
}

TEST(GroupedBodies, LeavesFewOfAKindAlone) {
  const std::vector<BodySummary> bodies = {leaf(1, "rigid"), leaf(2, "rigid"), leaf(3, "rigid")};
  EXPECT_EQ(grouped_bodies(bodies).size(), 3u);
  EXPECT_TRUE(grouped_bodies({}).empty());
}

TEST(RunReport, GroupsBodiesThatTheJsonLists) {
  RunResult run = example_run();
  run.summaries.clear();
  for (int i = 1; i <= 320; ++i) run.summaries.push_back(leaf(i, "rigid"));
  const std::string text = run_report(run, Policy::kSwitching);
  EXPECT_THAT(text, HasSubstr("320 x leaf"));
  EXPECT_THAT(text, Not(HasSubstr("leaf 17")));
  EXPECT_EQ(json::parse(run_json(run, Policy::kSwitching))["bodies"].size(), 320u);
}

TEST(RunReport, HasThePiecesOfWhatBroke) {
  RunResult run = example_run();
  EXPECT_THAT(run_report(run, Policy::kSwitching), Not(HasSubstr("what broke")));
  run.broken_edges = 70;
  run.piece_masses = {0.5, 0.25, 0.125};
  run.debris_mass = 0.03;
  std::string text = run_report(run, Policy::kSwitching);
  EXPECT_THAT(text, HasSubstr("0.5, 0.25, 0.125\n"));
  EXPECT_THAT(text, HasSubstr("0.03"));
  run.piece_masses.assign(50, 0.01);
  text = run_report(run, Policy::kSwitching);
  EXPECT_THAT(text, HasSubstr("0.01, ..."));
  EXPECT_EQ(json::parse(run_json(run, Policy::kSwitching))["piece_masses_kg"].size(), 50u);
}

TEST(SceneList, NamesTheRangeOfEachParameter) {
  SceneEntry pot{"pot", "a pot", {{"height", 1.0, "m", "of the fall", 0.0, 100.0}}, {}};
  EXPECT_THAT(scene_list({pot}), HasSubstr("height = 1 m  of the fall (0 to 100)"));
}

TEST(RunReport, ListsNoMoreSwitchesThanFitOnAScreen) {
  RunResult run = example_run();
  run.switches.resize(1000, run.switches[0]);
  const std::string text = run_report(run, Policy::kSwitching);
  EXPECT_THAT(text, HasSubstr("and 976 more; --json FILE lists them all"));
  EXPECT_THAT(text, HasSubstr("softening S"));
}

}  // namespace
}  // namespace limber::demos

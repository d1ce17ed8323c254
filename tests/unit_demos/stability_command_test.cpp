#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "demos/cli/cli_main.h"
#include "demos/cli/stability_plots.h"
#include "demos/cli/stability_report.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit_demos/said.h"

namespace limber::demos {
namespace {

using test::contents;
using test::expect_refused;
using test::limber;
using test::PathVariable;
using test::Said;
using test::TemporaryFolder;
using testing::HasSubstr;
using testing::StartsWith;

TEST(StabilityCommand, RefusesBadUsage) {
  const TemporaryFolder folder;
  expect_refused({"stability", "--bogus"});
  expect_refused({"stability", "extra"});
  expect_refused({"stability", "-o"});
  expect_refused({"stability", "--fast", "-o", (folder / "missing").string()});
  expect_refused({"stability", "--fast", "--json", (folder / "missing" / "a.json").string()});
  test::write(folder / "file", "");
  expect_refused({"stability", "--fast", "-o", (folder / "file").string()});
}

TEST(StabilityCommand, SaysThatGnuplotIsMissing) {
  const TemporaryFolder folder;
  const PathVariable nowhere("/nonexistent");
  const Said said = limber({"stability", "--fast", "-o", (folder / ".").string()});
  EXPECT_EQ(said.code, 2);
  EXPECT_THAT(said.err, StartsWith("limber: gnuplot: cannot be started"));
  EXPECT_THAT(said.err, HasSubstr("apt install gnuplot-nox"));
  EXPECT_EQ(folder.files(), 0u);
}

TEST(StabilityCommand, WritesDataAndPicturesAndNothingElse) {
  const TemporaryFolder folder;
  const Said said = limber({"stability", "--fast", "-o", (folder / ".").string()});
  EXPECT_EQ(said.code, 0) << said.err;
  EXPECT_EQ(said.err, "");
  EXPECT_THAT(said.out, HasSubstr("symplectic Euler"));
  for (const char* name : {"damping", "map", "mass_ratio", "accuracy"}) {
    const std::string file = std::string("stability_") + name;
    EXPECT_THAT(contents(folder / (file + ".png")), StartsWith("\x89PNG")) << file;
    EXPECT_THAT(contents(folder / (file + ".svg")), HasSubstr("</svg>")) << file;
  }
  EXPECT_THAT(contents(folder / "stability_cases.csv"), StartsWith("sweep,integrator,"));
  EXPECT_EQ(folder.files(), 12u);
}

TEST(StabilityCommand, GivesTheFactsToPrograms) {
  const Said said = limber({"stability", "--fast", "--json", "-"});
  EXPECT_EQ(said.code, 0) << said.err;
  const auto json = nlohmann::json::parse(said.out);
  EXPECT_TRUE(json.at("violations").empty());
  std::size_t cases = 0;
  for (const auto& integrator : json.at("integrators")) {
    cases += integrator.at("cases").get<std::size_t>();
  }
  EXPECT_EQ(json.at("cases").get<std::size_t>(), cases);
  EXPECT_EQ(limber({"stability", "--fast", "--json", "-"}).out, said.out);
}

// One case of each kind, by hand.
StabilityAtlas small_atlas() {
  StabilityAtlas atlas;
  const Scheme scheme = schemes().front();
  StabilityResult good, bad;
  good.tried.scheme = bad.tried.scheme = scheme;
  bad.outcome = StabilityOutcome::kStopped;
  bad.message = "block: \"point\" 3: gone; stay";
  bad.violation = "stopped within the analytic limit";
  atlas.cases = {good, bad};
  atlas.damping = {{scheme, 0.1, 2.0, 1.9}, {scheme, 1.0, 1.0, 1.05}};
  return atlas;
}

TEST(StabilityReport, CountsWhatHappened) {
  const std::vector<SchemeSummary> summaries = summaries_of(small_atlas());
  EXPECT_EQ(summaries.front().cases, 2u);
  EXPECT_EQ(summaries.front().violations, 1u);
  EXPECT_DOUBLE_EQ(summaries.front().least_share, 0.95);
  EXPECT_DOUBLE_EQ(summaries.front().largest_share, 1.05);
  EXPECT_EQ(summaries.back().cases, 0u);
  EXPECT_EQ(violations_in(small_atlas()), 1u);
  EXPECT_THAT(stability_report(small_atlas()), HasSubstr("stopped within the analytic limit"));
}

TEST(StabilityReport, QuotesWhatCsvWouldTakeApart) {
  EXPECT_THAT(cases_csv(small_atlas()), HasSubstr("\"block: \"\"point\"\" 3: gone; stay\""));
}

}  // namespace
}  // namespace limber::demos

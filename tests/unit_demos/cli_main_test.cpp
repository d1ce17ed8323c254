#include "demos/cli/cli_main.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "demos/scenes/scene.h"
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
using test::write;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::string any_scene() { return scene_library().front().name; }

TEST(CliMain, RefusesBadUsage) {
  const std::string scene = any_scene();
  expect_refused({});
  expect_refused({"fly"});
  expect_refused({"--fly"});
  expect_refused({"run", scene, "--fly"});
  expect_refused({"run", scene, "extra"});
  expect_refused({"run", scene, "--seconds"});
  expect_refused({"run", "--seconds", "1"});
  expect_refused({"compare"});
  expect_refused({"render", scene, "--time", "1"});
  expect_refused({"render", scene, "-o", "a.png"});
}

TEST(CliMain, RefusesBadNumbers) {
  const std::string scene = any_scene();
  for (const char* seconds : {"0", "-1", "nan", "inf", "1e9", "soon"}) {
    expect_refused({"run", scene, "--seconds", seconds});
  }
  for (const char* tick : {"0", "-1/60", "1/0", "0.11", "1e-6", "nan"}) {
    expect_refused({"compare", scene, "--tick", tick});
  }
  for (const char* noise : {"1", "-2", "51", "2.5"}) {
    expect_refused({"compare", scene, "--noise", noise});
  }
  expect_refused({"render", scene, "-o", "a.png", "--time", "-0.1"});
  expect_refused({"render", scene, "-o", "a.png", "--time", "0", "--width", "0"});
  expect_refused({"run", scene, "--policy", "stubborn"});
  expect_refused({"run", scene, "--set", "height"});
}

TEST(CliMain, RefusesUnknownScenesAndParameters) {
  expect_refused({"run", "no_such_scene"});
  expect_refused({"compare", any_scene(), "--set", "no_such_parameter=1"});
}

TEST(CliMain, RefusesAnUnwritableTargetBeforeItRuns) {
  const TemporaryFolder folder;
  const std::string target = (folder / "missing" / "a.json").string();
  // An hour of simulated time: the test would not end if it were simulated first.
  expect_refused({"run", any_scene(), "--seconds", "3600", "--json", target});
  expect_refused({"compare", any_scene(), "--seconds", "3600", "--json", target});
}

TEST(CliMain, NamesWhatWasTyped) {
  EXPECT_EQ(limber({"fly"}).err,
            "limber: command line: there is no command 'fly'; the commands are run, compare, "
            "render, model, info, stability, api\n");
  EXPECT_EQ(limber({"run", any_scene(), "--fly", "3"}).err,
            "limber: command line: '--fly 3' is not understood; `limber run --help` says what is "
            "possible\n");
}

TEST(CliMain, HasHelpForEveryCommand) {
  for (const char* command : {"run", "compare", "render", "model", "info", "stability"}) {
    const Said said = limber({command, "--help"});
    EXPECT_EQ(said.code, 0);
    EXPECT_THAT(said.out, HasSubstr("Usage: limber " + std::string(command)));
    EXPECT_EQ(said.err, "");
    EXPECT_THAT(limber({"--help"}).out, HasSubstr(command));
  }
}

TEST(CliMain, SaysItsVersion) {
  const Said said = limber({"--version"});
  EXPECT_EQ(said.code, 0);
  EXPECT_THAT(said.out, testing::MatchesRegex("limber [0-9.]+ .Bullet in float(32|64).\n"));
}

TEST(CliMain, ListsTheScenes) {
  const Said said = limber({"run"});
  EXPECT_EQ(said.code, 0);
  for (const SceneEntry& scene : scene_library()) {
    EXPECT_THAT(said.out, HasSubstr(scene.name));
    EXPECT_THAT(said.out, HasSubstr(scene.summary));
    for (const Parameter& p : scene.parameters) EXPECT_THAT(said.out, HasSubstr(p.name));
  }
}

TEST(CliMain, LeavesStandardOutputToTheJson) {
  const Said said = limber({"run", any_scene(), "--seconds", "1/30", "--json", "-"});
  EXPECT_EQ(said.code, 0) << said.err;
  EXPECT_EQ(said.err, "");
  const auto json = nlohmann::json::parse(said.out);
  EXPECT_EQ(json["scene"], any_scene());
  EXPECT_EQ(json["state_hash"].get<std::string>().size(), 16u);
}

TEST(CliMain, WritesTheJsonBesideTheTable) {
  const TemporaryFolder folder;
  const std::string target = (folder / "a.json").string();
  const Said said =
      limber({"compare", any_scene(), "--seconds", "1/60", "--noise", "2", "--json", target});
  EXPECT_EQ(said.code, 0) << said.err;
  EXPECT_THAT(said.out, HasSubstr("softening S"));
  EXPECT_EQ(nlohmann::json::parse(contents(target))["noise"]["runs"], 2);
  EXPECT_EQ(folder.files(), 1u);
}

TEST(Render, SaysHowToInstallPovRay) {
  const TemporaryFolder folder;
  const PathVariable nowhere((folder / "").string());
  const Said said =
      limber({"render", any_scene(), "--time", "3600", "-o", (folder / "a.png").string()});
  EXPECT_EQ(said.code, 2);
  EXPECT_THAT(said.err, StartsWith("limber: POV-Ray: cannot be started"));
  EXPECT_THAT(said.err, HasSubstr("apt install povray"));
  EXPECT_EQ(folder.files(), 0u);
}

TEST(Render, ShowsWhatPovRaySaidLast) {
  const TemporaryFolder folder;
  write(folder / "povray",
        "#!/bin/sh\n[ \"$1\" = --version ] && exit 0\necho first\necho out of luck >&2\nexit 3\n");
  std::filesystem::permissions(folder / "povray", std::filesystem::perms::owner_all);
  write(folder / "a.png", "old");
  const PathVariable here((folder / "").string());
  const Said said =
      limber({"render", any_scene(), "--time", "0", "-o", (folder / "a.png").string()});
  EXPECT_EQ(said.code, 1);
  EXPECT_THAT(said.err, HasSubstr("failed with exit code 3: first | out of luck"));
  EXPECT_EQ(contents(folder / "a.png"), "old");
}

TEST(Render, WritesAPng) {
  if (std::system("povray --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no POV-Ray";
  const TemporaryFolder folder;
  const Said said = limber({"render", any_scene(), "--time", "0", "--width", "48", "--height", "30",
                            "-o", (folder / "a.png").string()});
  EXPECT_EQ(said.code, 0) << said.err;
  EXPECT_THAT(contents(folder / "a.png"), StartsWith("\x89PNG"));
  EXPECT_THAT(said.out, HasSubstr("48 x 30 pixels"));
  EXPECT_EQ(folder.files(), 1u);
}

}  // namespace
}  // namespace limber::demos

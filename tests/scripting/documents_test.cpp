#include <fstream>
#include <iterator>

#include "demos/scripting/api_text.h"
#include "tests/scripting/script_runs.h"

// What the documents say about scripts holds: the reference is the one that the table makes, every
// step of the tutorial runs, every scene that ships does.

namespace limber::demos::test {
namespace {

using testing::HasSubstr;

std::string document(const std::string& name) {
  std::ifstream in(std::string(LIMBER_ROOT "/docs/") + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Blocks of ```lua.
std::vector<std::string> scripts_in(const std::string& text) {
  const std::string begin = "```lua\n", end = "\n```";
  std::vector<std::string> scripts;
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at)) {
    at += begin.size();
    scripts.push_back(text.substr(at, text.find(end, at) - at));
  }
  return scripts;
}

TEST(ScriptDocuments, TheReferenceIsUpToDate) {
  EXPECT_TRUE(document("scripting_reference.md") == api_reference())
      << "run `limber api > docs/scripting_reference.md`";
}

TEST(ScriptDocuments, StubsNameEveryFunction) {
  const std::string stubs = api_stubs();
  EXPECT_THAT(stubs, HasSubstr("function shape.box(fields) end"));
  EXPECT_THAT(stubs, HasSubstr("function body:position() end"));
  EXPECT_THAT(stubs, HasSubstr("---@field radius number m, of it"));
}

TEST(ScriptDocuments, EveryStepOfTheTutorialRuns) {
  const std::vector<std::string> steps = scripts_in(document("scripting.md"));
  EXPECT_EQ(steps.size(), 10u);
  for (const std::string& step : steps) {
    SCOPED_TRACE(step);
    const ScriptRun done = run_of_text(step, 0.5);
    if (done.result.failure) ADD_FAILURE() << done.result.failure->text();
  }
}

TEST(ScriptDocuments, TheScriptInTheReadmeBreaksItsPot) {
  const std::vector<std::string> scripts = scripts_in(document("../README.md"));
  ASSERT_EQ(scripts.size(), 1u);
  const ScriptRun done = run_of_text(scripts[0], 1.0);
  EXPECT_THAT(done.printed, testing::MatchesRegex("broke at 0.4[0-9] s, into [0-9]+ pieces\n"));
  EXPECT_GT(done.result.fragments, 4u);
}

TEST(ShippedScenes, AllRun) {
  for (const SceneEntry& scene : scene_library()) {
    SCOPED_TRACE(scene.name);
    EXPECT_FALSE(scene.summary.empty());
    RunOptions options;
    options.seconds = 0.1;
    const RunResult result = run(build_scene(scene.name), options);
    if (result.failure) ADD_FAILURE() << result.failure->text();
  }
}

// Two are enough to see that one falls by the other.
TEST(ShippedScenes, DominoesTopple) {
  RunOptions options;
  options.seconds = 0.6;
  const RunResult result = run(build_scene("dominoes", {{"biscuits", 2.0}}), options);
  ASSERT_EQ(result.summaries.size(), 2u);
  for (const BodySummary& biscuit : result.summaries) {
    EXPECT_LT(biscuit.centre_of_mass.y(), 0.036) << biscuit.name;  // upright: 0.045
  }
}

}  // namespace
}  // namespace limber::demos::test

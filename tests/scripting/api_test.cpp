#include "demos/scripting/api.h"

#include <algorithm>

#include "core/model/random.h"
#include "tests/scripting/script_runs.h"

// Every function of the table: its example runs, and no value makes it crash.

namespace limber::demos::test {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Api, EveryFunctionIsDocumented) {
  for (const ApiFunction& function : api_functions()) {
    SCOPED_TRACE(function.full_name());
    EXPECT_FALSE(function.summary.empty());
    EXPECT_THAT(function.example, HasSubstr(function.name));
    for (const Field& f : function.fields) EXPECT_FALSE(f.meaning.empty()) << f.name;
  }
  for (const ApiCallback& callback : api_callbacks()) {
    EXPECT_THAT(callback.example, HasSubstr("function " + callback.name));
  }
}

TEST(Api, EveryExampleRuns) {
  for (const ApiFunction& function : api_functions()) {
    SCOPED_TRACE(function.example);
    const ScriptRun done = run_of_text(function.example, 0.05);
    if (done.result.failure) ADD_FAILURE() << done.result.failure->text();
  }
  for (const ApiCallback& callback : api_callbacks()) {
    SCOPED_TRACE(callback.example);
    const ScriptRun done = run_of_text(callback.example, 0.1);
    if (done.result.failure) ADD_FAILURE() << done.result.failure->text();
  }
}

// What hostile or confused scripts put in the place of a value.
const std::vector<std::string>& strange_values() {
  static const std::vector<std::string> values = {
      "0",
      "-1",
      "1",
      "1e300",
      "-1e300",
      "0/0",
      "1/0",
      "-1/0",
      "math.mininteger",
      "0.5",
      "true",
      "''",
      "'porcelain'",
      "('x'):rep(1000)",
      "{}",
      "{1, 2}",
      "{1, 2, 3}",
      "{0, 0, 0}",
      "{0/0, 1, 2}",
      "{1e300, 1e300, 1e300}",
      "vec(1, 0, 0)",
      "{{0, 1}, {1, 2}}",
      "{{1, 1}, {0, 2}}",
      "{{0, 0, 0}, {0, 1, 0}}",
      "{{}}",
      "{a = 1}",
      "{[{}] = 1}",
      "setmetatable({}, {__index = function() return 1 end})",
      "print",
      "function() end",
      "function() error('no') end",
      "function() return 1, 2 end",
      "math.huge",
      "material{like = 'rubber'}",
      "shape.box{size = {1, 1, 1}, cells = {1, 1, 1}, "
      "material = 'rubber'}",
      "rigid.sphere{radius = 1}",
      "_G",
      "string"};
  return values;
}

// One call of a function with fields from `value`, caught and told.
std::string call_text(const ApiFunction& function, const std::string& fields) {
  std::string receiver;
  if (function.owner == "model") {
    receiver = "shape.box{size = {1, 1, 1}, cells = {1, 1, 1}, material = 'rubber'}";
  } else if (function.owner == "object") {
    receiver = "object";
  } else if (function.owner == "body") {
    receiver = "ball";
  } else if (function.owner == "flow") {
    receiver = "gust";
  }
  if (receiver.empty()) return "try(" + function.full_name() + ", " + fields + ")\n";
  return "try(function(f) return (" + receiver + "):" + function.name + "(f) end, " + fields +
         ")\n";
}

// All in one script: the messages of what was refused are one line with a remedy.
constexpr const char* kTry = R"(
local object = spawn{name = "thing", position = {0, 2, 0}, model = shape.box{size = {0.1, 0.1, 0.1},
                     cells = {1, 1, 1}, material = "spruce"}}
local ball = rigid.sphere{radius = 0.1, mass = 1, position = {0, 5, 0}}
local gust = wind.uniform{direction = {1, 0, 0}, speed = 0}
local function try(f, ...)
  local good, why = pcall(f, ...)
  if good then return end
  assert(type(why) == "string" and #why > 10, "no message")
  if not why:find("; ", 1, true) and not why:find("attempt to", 1, true)
     and not why:find(": no", 1, true) and not why:find("memory", 1, true) then
    print("without remedy: " .. why)
  end
end
)";

// Every field of every function with every strange value, the others as its defaults have it, in a
// scene that runs.
TEST(ApiFuzz, StrangeValuesNeverCrashAndAreAlwaysAnswered) {
  for (const ApiFunction& function : api_functions()) {
    if (function.name == "scene") continue;
    SCOPED_TRACE(function.full_name());
    std::string calls;
    for (const std::string& value : strange_values()) {
      calls += call_text(function, value);
      for (const Field& f : function.fields) {
        calls += call_text(function, "{" + f.name + " = " + value + "}");
      }
    }
    const std::string script = kTry + std::string("function on_start()\n") + calls + "end\n";
    const ScriptRun done = run_of_text(script, 0.01);
    if (done.result.failure) ADD_FAILURE() << done.result.failure->text();
    EXPECT_EQ(done.printed.find("without remedy"), std::string::npos) << done.printed;
  }
}

// Complete calls with one field at random replaced: past the check of what is missing.
TEST(ApiFuzz, ExamplesWithOneValueChangedNeverCrash) {
  Random random(2026);
  const auto pick = [&](const auto& list) {
    return list[static_cast<std::size_t>(random.uniform() * static_cast<double>(list.size()))];
  };
  for (const ApiFunction& function : api_functions()) {
    for (int round = 0; round < 12 && !function.fields.empty(); ++round) {
      const Field f = pick(function.fields);
      std::string script = function.example;
      const auto at = script.find(f.name + " = ");
      if (at == std::string::npos) continue;
      const auto end = script.find_first_of(",}\n", at);
      script.replace(at, end - at, f.name + " = " + pick(strange_values()));
      SCOPED_TRACE(script);
      try {
        run_of_text(script, 0.02);
      } catch (const InputError& error) {
        EXPECT_FALSE(error.diagnostic.what.empty());
      } catch (const SimulationError& error) {
        EXPECT_FALSE(error.diagnostic.what.empty());
      }
    }
  }
}

}  // namespace
}  // namespace limber::demos::test

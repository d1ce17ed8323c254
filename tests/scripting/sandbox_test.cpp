#include <chrono>

#include "demos/scripting/safe_strings.h"
#include "tests/scripting/script_runs.h"

// What a script from a stranger may try. Each of these goes on for ever, or eats the memory, in
// plain Lua.

namespace limber::demos::test {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

ScriptSettings small() {
  ScriptSettings settings;
  settings.limits.load_steps = 2'000'000;
  settings.limits.tick_steps = 500'000;
  settings.limits.memory_bytes = std::size_t{8} << 20;
  return settings;
}

class EndsOfItself : public testing::TestWithParam<const char*> {};

// It is stopped, whatever it catches, with the place and what to do.
TEST_P(EndsOfItself, IsStoppedByALimit) {
  const Diagnostic said = refusal_of_text(GetParam(), small());
  EXPECT_THAT(said.where, HasSubstr("test.lua"));
  EXPECT_THAT(said.text(), AnyOf(HasSubstr("steps"), HasSubstr("not enough memory")));
}

INSTANTIATE_TEST_SUITE_P(
    Sandbox, EndsOfItself,
    testing::Values(
        "while true do end",
        "local function loop() while true do end end while true do pcall(loop) end",
        "while true do pcall(string.rep, 'x', 1e7) end",
        "local t = {} while true do t[#t + 1] = {} end",
        "local s = 'x' while true do s = s .. s end",
        "local s = ('x'):rep(1e6) for i = 1, 1e9 do local t = s .. i end",
        "while true do pcall(error, 'again') end",
        "local t = setmetatable({}, {__index = function(t, k) return t[k + 1] end})\n"
        "while true do pcall(function() return t[1] end) end",
        "for i = 1, 1e9 do table.insert({}, i) end",
        "local t = {} for i = 1, 1e5 do t[i] = i end while true do table.insert(t, 1, 0) end",
        "local t = {} for i = 1, 1e5 do t[i] = i end while true do table.sort(t) end",
        "local t <close> = setmetatable({}, {__close = function() while true do end end})",
        "shape.rope{points = {{0, 0, 0}, {1, 0, 0}}, segments = 2, diameter = 0.1,\n"
        "  material = (function() while true do end end)()}",
        "shape.turned{radius = function() while true do end end, low = 0, high = 1,\n"
        "  material = 'rubber'}"));

TEST(Sandbox, RefusesSearchesThatMayTakeForEver) {
  for (const char* script : {
           "(('a'):rep(40)):find(('a?'):rep(40) .. ('a'):rep(40))",
           "(('a'):rep(5000)):find(('.-'):rep(10) .. 'b')",
           "(('a'):rep(5000)):match('(.*)(.*)(.*)b')",
           "(('a'):rep(5000)):gsub('.-.-.-.-b', '')",
           "(('a'):rep(1e6)):find(('a'):rep(1e5) .. 'b', 1, true)",
       }) {
    SCOPED_TRACE(script);
    EXPECT_THAT(refusal_of_text("local _ = " + std::string(script)).what,
                AnyOf(HasSubstr("a search"), HasSubstr("steps")));
  }
}

// Two repetitions in n characters: n starts, n ways to share, n to fail.
TEST(Sandbox, KnowsWhatASearchMayCost) {
  EXPECT_EQ(pattern_cost(99, "abc"), 100.0);
  EXPECT_EQ(pattern_cost(99, "a*b"), 100.0 * 100.0);
  EXPECT_EQ(pattern_cost(99, "a*.-b"), 100.0 * 100.0 * 100.0);
  EXPECT_EQ(pattern_cost(99, "a?b?c"), 400.0);
  EXPECT_EQ(pattern_cost(99, "%*%-"), 100.0);  // signs, not repetitions
  EXPECT_EQ(pattern_cost(99, "%b()"), 100.0 * 100.0);
}

TEST(Sandbox, EndsRecursion) {
  EXPECT_THAT(refusal_of_text("local function f() return 1 + f() end f()").what,
              AnyOf(HasSubstr("stack overflow"), HasSubstr("not enough memory")));
  EXPECT_THAT(refusal_of_text("string.gsub('x', 'x', function() error(('x'):rep(9)) end)").what,
              HasSubstr("xxxxxxxxx"));
}

TEST(Sandbox, RepeatsNothingFewerTimesThanForEver) {
  EXPECT_THAT(refusal_of_text("string.rep('', 1e15)").what, HasSubstr("repeats at most"));
  EXPECT_THAT(refusal_of_text("string.rep('x', 1e9)").what, HasSubstr("repeats at most"));
  EXPECT_THAT(refusal_of_text("string.rep(('x'):rep(1000), 1e6)").what,
              HasSubstr("not enough memory"));
}

TEST(Sandbox, HasNothingThatReachesOut) {
  for (const char* name : {"collectgarbage", "coroutine", "debug", "dofile", "io", "load",
                           "loadfile", "next", "os", "package", "utf8", "warn", "xpcall"}) {
    SCOPED_TRACE(name);
    const Diagnostic said = refusal_of_text(std::string("local _ = ") + name);
    EXPECT_THAT(said.what, HasSubstr(std::string("there is no '") + name));
  }
  for (const char* name : {"string.dump", "table.move"}) {
    EXPECT_NO_THROW(scene_of_text(std::string("assert(") + name + " == nil)"));
  }
}

TEST(Sandbox, RunsNoFinalisersAndNoBytecode) {
  EXPECT_THAT(refusal_of_text("setmetatable({}, {__gc = function() end})").what, HasSubstr("__gc"));
  EXPECT_THAT(refusal_of_text("setmetatable({}, {__gc = true})").what, HasSubstr("__gc"));
  EXPECT_THAT(refusal_of_text("\x1bLua and so on").text(), HasSubstr("attempt to load a binary"));
}

TEST(Sandbox, TakesNoLengthFromAMetatable) {
  const char* huge = "local t = setmetatable({}, {__len = function() return 1e15 end})\n";
  for (const char* use : {"table.insert(t, 1, 0)", "table.remove(t, 1)", "table.concat(t)",
                          "table.sort(t)", "table.unpack(t)"}) {
    EXPECT_THAT(refusal_of_text(std::string(huge) + use).what, HasSubstr("__len")) << use;
  }
  EXPECT_THAT(refusal_of_text("table.concat({}, '', 1, 1e15)").remedy, HasSubstr("leave out"));
  EXPECT_THAT(refusal_of_text("table.unpack({}, 1, 1e8)").remedy, HasSubstr("leave out"));
}

TEST(Sandbox, TypesOfTheSceneStayAsTheyAre) {
  EXPECT_NO_THROW(scene_of_text("assert(getmetatable(vec(1, 2, 3)) == 'vec')"));
  EXPECT_THAT(refusal_of_text("setmetatable(_G, {})").what, HasSubstr("protected metatable"));
  EXPECT_THAT(refusal_of_text("vec(1, 2, 3).x = 4").what, HasSubstr("does not change"));
}

// The order of pairs() and addresses would differ from run to run.
TEST(Sandbox, PairsGoInOrder) {
  const char* script = R"(
    local t = {"a", "b", z = 1, y = 2, x = 3, [10] = 4, [2.5] = 5, [true] = 6}
    local order = ""
    for k in pairs(t) do order = order .. tostring(k) .. " " end
    assert(order == "1 2 2.5 10 x y z true ", order)
    for k, v in pairs(t) do t[k] = nil end
    for k in pairs(t) do error("not empty") end)";
  EXPECT_NO_THROW(scene_of_text(script));
  EXPECT_THAT(refusal_of_text("for k in pairs({[{}] = 1}) do end").what,
              HasSubstr("differ from run to run"));
}

TEST(Sandbox, ShowsNoAddresses) {
  EXPECT_NO_THROW(
      scene_of_text("assert(tostring({}) == 'table' and tostring(print) == 'function')\n"
                    "assert(string.format('%s %s', {}, 1) == 'table 1')"));
  EXPECT_THAT(refusal_of_text("string.format('%p', {})").what, HasSubstr("%p"));
}

TEST(Sandbox, RandomNumbersAreTheSameInEveryRun) {
  const char* script =
      "math.randomseed(7) print(math.random(), math.random(6), math.random(-3, 3))";
  std::string first;
  for (int run = 0; run < 3; ++run) {
    std::ostringstream printed;
    ScriptSettings settings;
    settings.printed = &printed;
    scene_of_text(script, settings);
    if (run == 0) first = printed.str();
    EXPECT_EQ(printed.str(), first);
  }
  EXPECT_NO_THROW(
      scene_of_text("for i = 1, 1000 do local n = math.random(3, 5)\n"
                    "assert(n >= 3 and n <= 5 and math.type(n) == 'integer') end"));
  for (const char* bad : {"math.random(0)", "math.random(5, 3)", "math.random(0, 2^60)",
                          "math.randomseed(-1)", "math.randomseed(0/0)", "math.random({})"}) {
    EXPECT_FALSE(refusal_of_text(bad).what.empty()) << bad;
  }
}

TEST(Sandbox, AModelIsNoWayAroundTheLimitOfMemory) {
  ScriptSettings settings;
  settings.limits.points = 10'000;
  for (const char* script :
       {"shape.box{size = {1, 1, 1}, cells = {500, 500, 500}, material = 'rubber'}",
        "local box = shape.box{size = {1, 1, 1}, cells = {9, 9, 9}, material = 'rubber'}\n"
        "for i = 1, 1000 do box:copy() end",
        "local box = shape.box{size = {1, 1, 1}, cells = {9, 9, 9}, material = 'rubber'}\n"
        "for i = 1, 1000 do spawn{model = box} end"}) {
    EXPECT_THAT(refusal_of_text(script, settings).what, HasSubstr("points in all"));
  }
}

}  // namespace
}  // namespace limber::demos::test

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

// Two repetitions in n characters: n starts, n ways to share, n to fail, each along the pattern.
TEST(Sandbox, KnowsWhatASearchMayCost) {
  EXPECT_EQ(pattern_cost(99, "abc"), 3.0 * 100.0);
  EXPECT_EQ(pattern_cost(99, "a*b"), 3.0 * 100.0 * 100.0);
  EXPECT_EQ(pattern_cost(99, "a*.-b"), 5.0 * 100.0 * 100.0 * 100.0);
  EXPECT_EQ(pattern_cost(99, "a?b?c"), 5.0 * 400.0);
  EXPECT_EQ(pattern_cost(99, "%*%-"), 4.0 * 100.0);  // signs, not repetitions
  EXPECT_EQ(pattern_cost(99, "%b()"), 4.0 * 100.0 * 100.0);
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

// The iterator of pairs() is a function like others.
TEST(Sandbox, PairsOfAnythingElseAreRefused) {
  for (const char* script : {"pairs({1})()", "pairs({1})(5)", "pairs({1})(1234.5, 'x')"}) {
    EXPECT_THAT(refusal_of_text(script).what, HasSubstr("table expected")) << script;
  }
  EXPECT_NO_THROW(
      scene_of_text("local f, t = pairs({a = 1}) local k, v = f(t)\n"
                    "assert(k == 'a' and v == 1 and f(t) == nil)"));
}

// A thousand ends of a list of 1e5 items would be 1e8 steps if each paid for all of it.
TEST(Sandbox, TheEndOfAListIsChangedAtNoCost) {
  ScriptSettings settings;
  settings.limits.load_steps = 20'000'000;
  const std::string list = "local t = {} for i = 1, 1e5 do t[i] = i end\n";
  EXPECT_NO_THROW(scene_of_text(
      list + "for i = 1, 1000 do table.insert(t, i) end for i = 1, 1000 do table.remove(t) end\n"
             "assert(#t == 1e5)",
      settings));
  EXPECT_THAT(refusal_of_text(list + "for i = 1, 1000 do table.insert(t, 1, i) end", settings).what,
              HasSubstr("steps"));
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
  for (const char* hidden : {"%20p", "%-5p", "%5.3p", "%d %p", "%%%p", "\\0%p"}) {
    const std::string script = "string.format('" + std::string(hidden) + "', {}, {})";
    EXPECT_THAT(refusal_of_text(script).what, HasSubstr("(%p)")) << script;
  }
  EXPECT_NO_THROW(scene_of_text("assert(string.format('%%p %5.1f%%', 2) == '%p   2.0%')"));
  EXPECT_EQ(refusal_of_text("local _ = scene{}[{}]").what, "the scene has no parameter 'table'");
}

// Lua's own order of a table's names differs from run to run.
TEST(Sandbox, TheFirstWrongNameIsTheSameInEveryRun) {
  for (int run = 0; run < 10; ++run) {
    EXPECT_THAT(refusal_of_text("rigid.sphere{wrong = 1, radius = {}, bad = 1, worse = 1}").what,
                HasSubstr("'bad'"));
    // Of values the one that stands first in the reference.
    EXPECT_THAT(refusal_of_text("rigid.sphere{friction = -1, mass = 'x', radius = {}}").what,
                HasSubstr("'radius'"));
  }
}

// What was checked must not be something else when it is used.
TEST(Sandbox, CallbacksCannotChangeWhatWasChecked) {
  const std::string turn = "low = 0, high = 1, cells_across = 4, material = 'rubber'}\n";
  EXPECT_NO_THROW(
      scene_of_text("local a = {" + turn +
                    "a.colour = {1, 0, 0}\n"
                    "a.radius = function() a.colour = 1e-300 a.low = {} return 0.1 end\n"
                    "shape.turned(a)"));
  EXPECT_THAT(
      refusal_of_text("local c = {1, 0, 0}\n"
                      "local a = {colour = c, " +
                      turn + "a.radius = function() c[1] = 'x' return 0.1 end\nshape.turned(a)")
          .text(),
      HasSubstr("a vector changed while it was read; leave it alone in callbacks"));
}

TEST(Sandbox, NamesAreShort) {
  const std::string ball = "rigid.sphere{radius = 1, name = ('x'):rep(";
  EXPECT_NO_THROW(scene_of_text(ball + "1000)}"));
  EXPECT_THAT(refusal_of_text(ball + "1001)}").text(),
              HasSubstr("'name' is a text of 1001 bytes; give at most 1000"));
}

TEST(Sandbox, WhatIsPrintedCosts) {
  ScriptSettings settings = small();
  EXPECT_THAT(refusal_of_text("local s = ('x'):rep(1e5) local t = setmetatable({}, {__tostring =\n"
                              "function() return s end}) for i = 1, 20 do print(t, t) end",
                              settings)
                  .what,
              HasSubstr("steps"));
  std::ostringstream printed;
  settings.printed = &printed;
  settings.limits.printed_bytes = 10;
  scene_of_text("print('abc', 'def') print(('x'):rep(100), 'y') print('z')", settings);
  EXPECT_EQ(printed.str(), "abc\tdef\nz\n");
}

TEST(Sandbox, RunsForALimitedNumberOfTicks) {
  EXPECT_NO_THROW(scene_of_text("scene{seconds = 1e5, tick = 0.011}"));
  EXPECT_THAT(refusal_of_text("scene{seconds = 1e5, tick = 1e-5}").text(),
              HasSubstr("scene: 'seconds' are 1e+10 of 'tick'; give fewer seconds"));
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
        "for i = 1, 1000 do spawn{model = box} end",
        "local h = {} for i = 1, 1000 do h[i] = 0 end\n"
        "for i = 1, 11 do rigid.terrain{columns = 10, spacing = 1, heights = h} end",
        "local p, t = {}, {} for i = 1, 500 do p[i] = {i, i % 2, 0} t[3 * i] = 3 t[3 * i - 1] = 2\n"
        "t[3 * i - 2] = 1 end for i = 1, 6 do rigid.mesh{points = p, triangles = t} end",
        "local p = {} for i = 1, 900 do p[i] = vec(math.cos(i), math.sin(i), i % 2) end\n"
        "for i = 1, 12 do rigid.hull{points = p} end"}) {
    EXPECT_THAT(refusal_of_text(script, settings).what, HasSubstr("points in all")) << script;
  }
}

}  // namespace
}  // namespace limber::demos::test

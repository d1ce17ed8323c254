#include "tests/scripting/script_runs.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit_demos/said.h"

// Scripts as scenes: parameters, messages, callbacks, modules, the program.

namespace limber::demos::test {
namespace {

using limber::test::limber;
using limber::test::TemporaryFolder;
using limber::test::write;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kFallingBall =
    "local ball = rigid.sphere{name = 'ball', radius = 0.1, mass = 2, position = {0, 1, 0}}\n";

// A cube that falls from 5 cm: stiff enough to fly as a rigid body, soft enough to give on landing.
constexpr const char* kCube =
    "local brick = material{like = 'stoneware', softening = 1e5, damping_ratio = 0.2,\n"
    "                       strain_at_break = math.huge}\n"
    "local cube = spawn{name = 'cube', position = {0, 0.15, 0}, model = shape.box{\n"
    "  size = {0.2, 0.2, 0.2}, cells = {3, 3, 3}, material = brick}}\n";

TEST(ScriptMessages, NameFileLineAndTheNearestField) {
  const Diagnostic said = refusal_of_text("\nrigid.sphere{raduis = 0.1}");
  EXPECT_EQ(said.where, "test.lua:2");
  EXPECT_EQ(said.what, "rigid.sphere: there is no field 'raduis'");
  EXPECT_THAT(said.remedy, HasSubstr("did you mean 'radius'?"));
  EXPECT_THAT(said.remedy, HasSubstr("stack traceback"));
}

TEST(ScriptMessages, NameTheUnitThatIsWanted) {
  EXPECT_THAT(refusal_of_text("rigid.box{size = 3}").text(),
              HasSubstr("rigid.box: 'size' is a number; give three numbers in m, as in {1, 2, 3}"));
  EXPECT_THAT(refusal_of_text("rigid.sphere{}").text(),
              HasSubstr("rigid.sphere: 'radius' is missing; give a number in m"));
  EXPECT_THAT(refusal_of_text("rigid.sphere{radius = 1, friction = -1}").text(),
              HasSubstr("'friction' is -1; give a number, 0 to 10"));
}

TEST(ScriptMessages, NameWhatWasMistyped) {
  EXPECT_THAT(refusal_of_text("shap.box{}").remedy, HasSubstr("did you mean 'shape'"));
  EXPECT_THAT(refusal_of_text("material{like = 'stonware'}").text(), HasSubstr("stoneware"));
  EXPECT_THAT(refusal_of_text("function on_brake() end").text(), HasSubstr("on_break"));
  EXPECT_THAT(
      refusal_of_text("on_tick = 5").text(),
      HasSubstr("'on_tick' is a number, and nothing could call it; write function on_tick("));
  EXPECT_THAT(refusal_of_text("joint.ball{body = 1, at = {0, 0, 0}}").text(),
              HasSubstr("as rigid.box{} makes one"));
  EXPECT_THAT(refusal_of_text("local m = shape.sphere{radius = 1, cells_across = 4, "
                              "material = 'rubber'} m:plaec{}")
                  .text(),
              HasSubstr("'place'"));
  EXPECT_THAT(refusal_of_text("local s = scene{} local x = s.height").text(), HasSubstr("height"));
}

TEST(ScriptMessages, SayHowThingsAreCalled) {
  EXPECT_THAT(refusal_of_text("rigid.sphere(0.1)").text(), HasSubstr("named fields"));
  EXPECT_THAT(refusal_of_text("rigid.sphere{0.1}").text(), HasSubstr("named fields"));
  EXPECT_THAT(refusal_of_text("rigid.sphere({radius = 1}, 2)").text(), HasSubstr("one table"));
  EXPECT_THAT(refusal_of_text("local m = shape.sphere{radius = 1, cells_across = 4, "
                              "material = 'rubber'} m.place{}")
                  .text(),
              HasSubstr("colon"));
  EXPECT_THAT(refusal_of_text(std::string(kFallingBall) + "ball:position()").text(),
              HasSubstr("the scene does not run yet"));
}

TEST(ScriptMessages, HaveAllFunctionsOnTheWay) {
  const Diagnostic said = refusal_of_text(
      "local function inner() error('no more') end\nlocal function outer() inner() end\nouter()");
  EXPECT_EQ(said.where, "test.lua:1");
  EXPECT_EQ(said.what, "no more");
  EXPECT_THAT(said.remedy, HasSubstr("test.lua:3: in main chunk"));
}

TEST(Script, DeclaresParameters) {
  const SceneEntry entry = script_entry(
      script_of_text("local set = scene{summary = 'one', seconds = 2, gravity = {0, -1, 0},\n"
                     "parameters = {{name = 'height', value = 3, unit = 'm', meaning = 'of it',\n"
                     "               least = 0, most = 10}}}\n"
                     "rigid.sphere{radius = 1, position = {0, set.height, 0}}"),
      {});
  EXPECT_EQ(entry.summary, "one");
  ASSERT_EQ(entry.parameters.size(), 1u);
  EXPECT_EQ(entry.parameters[0].unit, "m");
  EXPECT_EQ(entry.parameters[0].most, 10.0);
  const Scene scene = entry.build({{"height", 7.0}});
  EXPECT_EQ(scene.seconds, 2.0);
  EXPECT_EQ(scene.gravity, Vec3(0.0, -1.0, 0.0));
  ASSERT_EQ(scene.bodies.size(), 1u);
  EXPECT_EQ(scene.bodies[0].centre, Vec3(0.0, 7.0, 0.0));
}

// The list of scenes must not build them, whatever a script does to go on.
TEST(Script, IsReadForItsHeaderNoFurther) {
  const auto summary = [](const std::string& then) {
    return read_header(script_of_text("local header = {summary = 'short'}\n" + then), {}).summary;
  };
  EXPECT_EQ(summary("scene(header) error('was run')"), "short");
  EXPECT_EQ(summary("pcall(scene, header) while true do pcall(error) end"), "short");
}

TEST(ScriptRun, CallsBackInOrder) {
  const ScriptRun done = run_of_text(
      "function on_start() print('start', time()) end\n"
      "function on_tick(dt) if time() < 0.03 then print('tick', dt) end end\n"
      "after{seconds = 0.02, call = function() print('after') end}\n"
      "local n = 0\n"
      "every{seconds = 0.02, call = function() n = n + 1 print('every', n) return n < 2 end}\n"
      "function on_input(name, value) print(name, value) end\n"
      "play{name = 'late', at = 0.03}\nplay{name = 'throw', at = 0, value = 2}\n"
      "scene{tick = 0.01}",
      0.06);
  EXPECT_EQ(done.printed,
            "start\t0.0\nthrow\t2.0\ntick\t0.01\ntick\t0.01\nafter\nevery\t1\ntick\t0.01\n"
            "late\t1.0\nevery\t2\n");
  EXPECT_FALSE(done.result.failure);
}

TEST(ScriptRun, TellsOfContactsAndSwitches) {
  const ScriptRun done =
      run_of_text(std::string(kFallingBall) + kCube +
                      "function on_contact(e) if e.thing == ball then\n"
                      "  print('contact', e.other == cube or e.other == nil) end end\n"
                      "function on_flexible(e) print('flexible', e.object:name(), e.cause) end\n"
                      "function on_rigid(e) print('rigid', e.object:name(), e.cause) end\n",
                  1.5);
  EXPECT_THAT(done.printed, HasSubstr("contact\ttrue\n"));
  EXPECT_THAT(done.printed, HasSubstr("flexible\tcube\ttouch"));
  EXPECT_THAT(done.printed, HasSubstr("rigid\tcube\tcalm"));
}

TEST(ScriptRun, TellsOfAContactWhenItBegins) {
  const ScriptRun done = run_of_text(
      std::string(kFallingBall) +
          "local n = 0\n"
          "function on_contact(e) n = n + 1 print(n, e.thing:name(), e.other, e.impulse > 1,\n"
          "  math.abs(e.at.y) < 0.05) end",
      1.0);
  EXPECT_EQ(done.printed, "1\tball\tnil\ttrue\ttrue\n");
}

TEST(ScriptRun, TellsOfBreaksAndSplits) {
  const ScriptRun done = run_of_text(
      "local clay = material{like = 'stoneware', softening = 1000, damping_ratio = 0.2}\n"
      "local n, last = 0, nil\n"
      "local bar = spawn{position = {0, 1.2, 0}, velocity = {0, -6, 0}, model = shape.box{\n"
      "  name = 'bar', size = {0.4, 0.05, 0.05}, cells = {8, 1, 1}, material = clay}}\n"
      "rigid.box{size = {0.02, 1, 1}, position = {0, 0.5, 0}}\n"
      "function on_break(e) n = n + 1 last = e end\n"
      "function on_split(e) print('split', e.object == bar, e.pieces + e.particles >= 2) end\n"
      "after{seconds = 0.4, call = function()\n"
      "  print(n > 0, bar:pieces() > 1, bar:broken() >= n, last.at.y > 0.5, last.edge >= 1) end}",
      0.5);
  EXPECT_THAT(done.printed, HasSubstr("split\ttrue\ttrue\n"));
  EXPECT_THAT(done.printed, HasSubstr("true\ttrue\ttrue\ttrue\ttrue\n"));
  EXPECT_GT(done.result.fragments, 1u);
}

// An impulse changes the velocity by impulse over mass, thrown things go as they are told, in free
// fall without gravity.
TEST(ScriptRun, PushesAndThrows) {
  const ScriptRun done = run_of_text(
      "scene{gravity = {0, 0, 0}}\n" + std::string(kFallingBall) + kCube +
          "local m\n"
          "function on_start() ball:push{impulse = {4, 0, 0}} m = cube:mass()\n"
          "  cube:throw{velocity = {0, 3, 0}} end\n"
          "after{seconds = 0.1, call = function()\n"
          "  assert((ball:velocity() - vec(2, 0, 0)):length() < 1e-6)\n"
          "  assert((cube:velocity() - vec(0, 3, 0)):length() < 1e-3)\n"
          "  assert(math.abs(cube:energy() - 0.5 * m * 9) < 1e-2 * m)\n"
          "  cube:push{impulse = {m, 0, 0}} end}\n"
          "after{seconds = 0.2, call = function()\n"
          "  assert((cube:velocity() - vec(1, 3, 0)):length() < 1e-3) print('done') end}",
      0.3);
  EXPECT_EQ(done.printed, "done\n") << failure_of(done);
}

// Asleep one on the other; what holds the upper one goes away.
TEST(ScriptRun, WhatStoodOnARemovedOrMovedBodyFalls) {
  for (const char* change : {"lower:remove()", "lower:move{position = {5, 0.1, 0}}"}) {
    SCOPED_TRACE(change);
    const ScriptRun done = run_of_text(
        "local lower = rigid.box{size = {0.2, 0.2, 0.2}, mass = 1, position = {0, 0.1, 0}}\n"
        "local upper = rigid.box{size = {0.2, 0.2, 0.2}, mass = 1, position = {0, 0.3, 0}}\n"
        "local function still() local y = upper:position().y return y > 0.29 and y < 0.31 end\n"
        "after{seconds = 4, call = function() assert(still() and upper:velocity():length() == "
        "0)\n" +
            std::string(change) +
            " end}\n"
            "after{seconds = 5, call = function() print(upper:position().y < 0.11) end}",
        5.1);
    EXPECT_EQ(done.printed, "true\n") << failure_of(done);
  }
}

// A rod of 0.4 x 0.1 x 0.1 m and 3 kg, turned upright: m (0.4^2 + 0.1^2) / 12 = 0.0425 kg m^2 about
// x (it was 0.005), so that 0.1 N m s give 0.1 / 0.0425 rad/s.
TEST(ScriptRun, AMovedBodyTurnsByItsNewInertia) {
  const ScriptRun done = run_of_text(
      "scene{gravity = {0, 0, 0}}\n"
      "local rod = rigid.box{size = {0.4, 0.1, 0.1}, mass = 3, position = {0, 2, 0}}\n"
      "function on_start()\n"
      "  rod:move{rotation = {axis = {0, 0, 1}, angle = math.pi / 2}}\n"
      "  rod:push{impulse = {0, 0, 1}, at = {0, 2.1, 0}}\n"
      "  print((rod:spin() - vec(0.1 / 0.0425, 0, 0)):length() < 1e-4) end",
      0.02);
  EXPECT_EQ(done.printed, "true\n") << failure_of(done);
}

TEST(ScriptRun, WhatHungFromARemovedBodyFalls) {
  const ScriptRun done = run_of_text(
      "scene{floor = false}\n"
      "local hook = rigid.sphere{radius = 0.05, position = {0, 2, 0}}\n"
      "local bob = rigid.sphere{radius = 0.1, mass = 1, position = {0, 1.5, 0}}\n"
      "joint.ball{body = bob, to = hook, at = {0, 2, 0}}\n"
      "after{seconds = 4, call = function() assert(bob:velocity():length() == 0) hook:remove() "
      "end}\n"
      "after{seconds = 4.5, call = function() print(bob:position().y < 1) end}",
      4.6);
  EXPECT_EQ(done.printed, "true\n") << failure_of(done);
}

TEST(ScriptRun, PrintsOnceWhatItPrintsWhileItIsSetUp) {
  const ScriptRun done = run_of_text("print('set up') function on_start() print('go') end", 0.05);
  EXPECT_EQ(done.printed, "set up\ngo\n");
}

TEST(ScriptRun, NamesAreKeptWhole) {
  EXPECT_NO_THROW(
      scene_of_text("local ball = rigid.sphere{name = 'a\\0b', radius = 1}\n"
                    "assert(ball:name() == 'a\\0b')"));
}

// Played inputs make room for others.
TEST(ScriptRun, InputsThatWereCountNoMore) {
  const ScriptRun done = run_of_text(
      "local n = 0\nfunction on_input() n = n + 1 end\n"
      "function on_start() for i = 1, 1e5 do play{name = 'a', at = 0} end end\n"
      "after{seconds = 0.05, call = function() play{name = 'a', at = 1} print(n) end}",
      0.1, [] {
        ScriptSettings settings;
        settings.limits.tick_steps = 1'000'000'000;
        return settings;
      }());
  EXPECT_EQ(done.printed, "100000\n") << failure_of(done);
}

TEST(ScriptRun, SpawnsAndRemovesAndAsks) {
  const ScriptRun done = run_of_text(
      std::string(kCube) + kFallingBall +
          "after{seconds = 0.1, call = function()\n"
          "  local twin = spawn{model = cube:model(), name = 'twin', position = {2, 0, 0}}\n"
          "  assert(twin:position().x > 1.9 and twin:name() == 'twin')\n"
          "  local block = rigid.box{size = {1, 1, 1}, position = {5, 0.5, 0}}\n"
          "  local hit = ray{from = {5, 3, 0}, to = {5, 0.1, 0}}\n"
          "  assert(hit.thing == block and math.abs(hit.at.y - 1) < 1e-3 and hit.normal.y > 0.99)\n"
          "  assert(math.abs(hit.distance - 2) < 1e-3)\n"
          "  block:remove()\n"
          "  assert(ray{from = {5, 3, 0}, to = {5, 0.1, 0}} == nil)\n"
          "  local gone, why = pcall(block.position, block)\n"
          "  assert(not gone and why:find('removed', 1, true))\n"
          "  local on_cube = ray{from = cube:position() + vec(0, 0.5, 0), to = cube:position()}\n"
          "  assert(on_cube.thing == cube and cube:strain() < 1 and not (cube == twin))\n"
          "  print('done') end}",
      0.3);
  EXPECT_EQ(done.printed, "done\n") << failure_of(done);
  EXPECT_EQ(done.result.bodies, 2u);
  EXPECT_EQ(done.result.summaries[1].name, "twin");
}

TEST(ScriptRun, JoinsBodies) {
  const ScriptRun done = run_of_text(
      "local bob = rigid.sphere{radius = 0.1, mass = 1, position = {0.3, 2, 0}}\n"
      "joint.ball{body = bob, at = {0, 2, 0}}\n"
      "local low = 2\n"
      "function on_tick() local p = bob:position()\n"
      "  assert(math.abs((p - vec(0, 2, 0)):length() - 0.3) < 0.02)\n"
      "  low = math.min(low, p.y) end\n"
      "after{seconds = 1, call = function() print(low < 1.76) end}",
      1.1);
  EXPECT_EQ(done.printed, "true\n") << failure_of(done);
}

TEST(ScriptRun, MovesTheWind) {
  const ScriptRun done = run_of_text(
      "local leaf = shape.sheet{width = 0.1, depth = 0.1, centre = {0, 1, 0}, cells_u = 3,\n"
      "  cells_v = 3, thickness = 1e-3, normal_drag = 1.2, material = 'paper'}\n"
      "leaf:place{position = {0, 1, 1}, rotation = {axis = {1, 0, 0}, angle = math.pi / 2}}\n"
      "scene{gravity = {0, 0, 0}}\nlocal sheet = spawn{model = leaf}\n"
      "local gust = wind.uniform{direction = {0, 0, 1}, speed = 0}\n"
      "after{seconds = 0.1, call = function() assert(sheet:velocity():length() < 1e-9)\n"
      "  gust:set{strength = 5} end}\n"
      "after{seconds = 0.3, call = function() print(sheet:velocity().z > 0.1) end}",
      0.35);
  EXPECT_EQ(done.printed, "true\n") << failure_of(done);
}

TEST(ScriptRun, IsTheSameBitForBit) {
  const std::string script =
      std::string(kCube) + "function on_tick() cube:push{impulse = {math.random(), 0, 0}} end";
  EXPECT_EQ(run_of_text(script, 0.5).result.state_hash, run_of_text(script, 0.5).result.state_hash);
  EXPECT_NE(run_of_text(script, 0.5).result.state_hash,
            run_of_text("math.randomseed(2)\n" + script, 0.5).result.state_hash);
}

TEST(ScriptRun, EndsCleanlyWithWhatItHas) {
  const ScriptRun done = run_of_text(
      std::string(kFallingBall) + "function on_tick() if time() > 0.2 then error('enough') end end",
      1.0);
  ASSERT_TRUE(done.result.failure);
  EXPECT_EQ(done.result.failure->where, "test.lua:2");
  EXPECT_THAT(done.result.failure->what, ContainsRegex("at 0\\.2[0-9]* s: enough"));
  EXPECT_THAT(done.result.failure->remedy, HasSubstr("in function 'on_tick'"));
  EXPECT_NEAR(done.result.seconds, 0.2, 0.04);
}

TEST(ScriptRun, IsStoppedInATickThatTakesForEver) {
  ScriptSettings settings;
  settings.limits.tick_steps = 100'000;
  const ScriptRun done =
      run_of_text("function on_tick() while true do pcall(time) end end", 1.0, settings);
  ASSERT_TRUE(done.result.failure);
  EXPECT_THAT(done.result.failure->what, HasSubstr("the callbacks of this tick took more than"));
}

TEST(ScriptFolder, ModulesComeFromTheScenesFolderAlone) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "scene" / "parts");
  write(folder / "outside.lua", "return 1");
  write(folder / "scene" / "parts" / "leaf.lua", "print('once') return {size = 3}");
  std::filesystem::create_symlink(folder / "outside.lua", folder / "scene" / "linked.lua");
  const auto said = [&](const std::string& text) {
    write(folder / "scene" / "main.lua", text);
    return limber({"run", (folder / "scene" / "main.lua").string(), "--seconds", "0.02"});
  };
  const auto good = said(
      "local a, b = require 'parts.leaf', require('parts.leaf')\n"
      "assert(a.size == 3 and a == b)");
  EXPECT_EQ(good.code, 0) << good.err;
  EXPECT_EQ(good.err, "once\n");
  EXPECT_EQ(said("require('parts.leaf') require('parts.leaf', 1)").err, "once\n");
  for (const char* module : {"..outside", "../outside", "/etc/passwd", "linked", "none", ""}) {
    const auto bad = said("require('" + std::string(module) + "')");
    EXPECT_EQ(bad.code, 2) << module;
    EXPECT_THAT(bad.err, ContainsRegex("no such file|no name of a module")) << module;
  }
  for (const char* file : {"../outside.lua", "/etc/passwd", "linked.lua", "none.obj"}) {
    const auto bad = said("shape.file{file = '" + std::string(file) + "'}");
    EXPECT_THAT(bad.err, HasSubstr("there is no such file in the scene's folder")) << file;
  }
}

TEST(ScriptProgram, ExitsByTheContract) {
  const TemporaryFolder folder;
  const std::string file = (folder / "a.lua").string();
  write(file, "scene{}\nrigid.sphere{raduis = 1}");
  const auto bad = limber({"run", file});
  EXPECT_EQ(bad.code, 2);
  EXPECT_EQ(bad.out, "");
  EXPECT_THAT(bad.err, HasSubstr("limber: " + file + ":2: rigid.sphere: there is no field"));
  write(file, "function on_tick() error('enough') end");
  const auto failed = limber({"run", file, "--seconds", "0.1", "--json", "-"});
  EXPECT_EQ(failed.code, 1);
  EXPECT_THAT(failed.out, HasSubstr("state_hash"));
  EXPECT_THAT(failed.err, HasSubstr("enough"));
  EXPECT_EQ(limber({"compare", file, "--seconds", "0.1"}).code, 1);
}

// A file that opens and fails when it is read; rights do not stop every user.
TEST(ScriptProgram, RefusesAScriptThatCannotBeRead) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/proc/self/mem", folder / "a.lua");
  const auto said = limber({"run", (folder / "a.lua").string(), "--seconds", "0.02"});
  EXPECT_EQ(said.code, 2);
  EXPECT_THAT(said.err, HasSubstr("a.lua: it cannot be read; check the name and rights"));
}

TEST(ScriptProgram, SetsParametersAndPlaysInputs) {
  const TemporaryFolder folder;
  const std::string file = (folder / "a.lua").string(), inputs = (folder / "in.txt").string();
  write(file,
        "local set = scene{parameters = {{name = 'n', value = 1, least = 0, most = 5}}}\n"
        "print(set.n)\nfunction on_input(name, value) print(name, value, time() >= 0.05) end");
  write(inputs, "# a player\n\n0.05 aim -2.5\n");
  const auto good = limber({"run", file, "--seconds", "0.1", "--set", "n=4", "--inputs", inputs});
  EXPECT_EQ(good.code, 0) << good.err;
  EXPECT_EQ(good.err, "4.0\naim\t-2.5\ttrue\n");
  EXPECT_EQ(limber({"run", file, "--set", "n=6"}).code, 2);
  for (const char* line : {"soon aim 1", "-1 aim 1", "1 aim", "1 aim 2 3", "nan aim 1"}) {
    write(inputs, line);
    const auto refused = limber({"run", file, "--inputs", inputs});
    EXPECT_EQ(refused.code, 2) << line;
    EXPECT_THAT(refused.err, HasSubstr("in.txt:1"));
  }
}

}  // namespace
}  // namespace limber::demos::test

#include <numbers>

#include "bullet_bridge/stage_body.h"
#include "tests/scripting/script_runs.h"

// What scripts do to the world and learn of it: compounds, joints while it runs, overlaps, contacts
// of lattices, things that go, materials in regions.

namespace limber::demos::test {
namespace {

using testing::HasSubstr;

constexpr const char* kJelly =
    "local jelly = material{density = 1000, youngs_modulus = 1e5, damping_ratio = 0.2}\n"
    "local cube = spawn{position = {0, 0.15, 0}, model = shape.box{name = 'cube',\n"
    "  size = {0.2, 0.2, 0.2}, cells = {3, 3, 3}, material = jelly}}\n";

// Closed forms: 4/3 pi r^3, pi r^2 h, a third of it, a^3 / 6 with its centre at a quarter.
TEST(SolidVolume, IsThatOfTheBooks) {
  using namespace bullet;
  const double pi = std::numbers::pi;
  EXPECT_NEAR(volume_of(SolidShape(BoxShape{{0.5, 1.0, 1.5}})).volume, 6.0, 1e-12);
  EXPECT_NEAR(volume_of(SolidShape(SphereShape{2.0})).volume, 32.0 / 3.0 * pi, 1e-12);
  EXPECT_NEAR(volume_of(SolidShape(CapsuleShape{1.0, 2.0})).volume, (2.0 + 4.0 / 3.0) * pi, 1e-12);
  EXPECT_NEAR(volume_of(SolidShape(CylinderShape{2.0, 3.0})).volume, 12.0 * pi, 1e-12);
  const SolidVolume cone = volume_of(SolidShape(ConeShape{1.0, 3.0}));
  EXPECT_NEAR(cone.volume, pi, 1e-12);
  EXPECT_NEAR(cone.centre.y(), -0.75, 1e-12);
  const SolidVolume hull = volume_of(
      SolidShape(HullShape{{{1.0, 0.0, 0.0}, {3.0, 0.0, 0.0}, {1.0, 2.0, 0.0}, {1.0, 0.0, 2.0}}}));
  EXPECT_NEAR(hull.volume, 8.0 / 6.0, 1e-12);
  EXPECT_LT((hull.centre - Vec3(1.5, 0.5, 0.5)).norm(), 1e-12);
}

// Two balls of r = 0.1 m and 2 kg each, 1 m apart, along a diagonal: 2/5 m r^2 each about the
// line, and m d^2 more, d = 0.5 m, across.
TEST(Compound, HasTheMomentsOfItsParts) {
  bullet::CompoundShape dumbbell;
  const Vec3 along = Vec3(1.0, 1.0, 0.0).normalized();
  dumbbell.parts = {{bullet::SphereShape{0.1}, Vec3(3.0, 0.0, 0.0), Mat3::Identity()},
                    {bullet::SphereShape{0.1}, Vec3(3.0, 0.0, 0.0) + along, Mat3::Identity()}};
  const Vec3 centre = bullet::centre_parts(dumbbell);
  EXPECT_LT((centre - (Vec3(3.0, 0.0, 0.0) + 0.5 * along)).norm(), 1e-12);
  const bullet::PrincipalFrame frame = bullet::principal_frame(dumbbell, 4.0);
  const double round = 2.0 * 0.4 * 2.0 * 0.01;
  EXPECT_NEAR(frame.moments[0], round, 1e-8);
  EXPECT_NEAR(frame.moments[1], round + 4.0 * 0.25, 1e-7);
  EXPECT_NEAR(frame.moments[2], round + 4.0 * 0.25, 1e-7);
  EXPECT_NEAR(std::abs(frame.axes.col(0).dot(along)), 1.0, 1e-9);
  EXPECT_NEAR(frame.axes.determinant(), 1.0, 1e-12);
}

// Rays meet its parts where they were placed, beside and below them nothing. It turns about its
// centre of mass, at 2 rad/s about y, and can be turned.
TEST(Compound, IsOneBody) {
  const ScriptRun done = run_of_text(
      "scene{gravity = {0, 0, 0}, floor = false}\n"
      "local hammer = rigid.compound{mass = 3, position = {0, 1, 0}, spin = {0, 2, 0}, parts = {\n"
      "  {shape = 'box', size = {0.1, 0.4, 0.1}},\n"
      "  {shape = 'box', size = {0.4, 0.1, 0.1}, position = {0, 0.25, 0}}}}\n"
      "function on_start()\n"
      "  assert((hammer:position() - vec(0, 1.125, 0)):length() < 1e-5)\n"
      "  assert((hammer:axis{of = {1, 0, 0}} - vec(1, 0, 0)):length() < 1e-5)\n"
      "  assert(ray{from = {0.19, 3, 0}, to = {0.19, 0, 0}}.thing == hammer)\n"
      "  assert(ray{from = {0.19, 0, 0}, to = {0.19, 3, 0}}.at.y > 1.19)\n"
      "  assert(ray{from = {0.19, 1, 1}, to = {0.19, 1, -1}} == nil)\n"
      "end\n"
      "after{seconds = 0.5, call = function()\n"
      "  local turned = vec(math.cos(2 * time()), 0, -math.sin(2 * time()))\n"
      "  assert((hammer:axis{of = {1, 0, 0}} - turned):length() < 1e-3)\n"
      "  hammer:move{rotation = {axis = {0, 0, 1}, angle = math.pi / 2}}\n"
      "  assert((hammer:axis{of = {1, 0, 0}} - vec(0, 1, 0)):length() < 1e-5) print('done') end}",
      0.6);
  EXPECT_EQ(done.printed, "done\n") << failure_of(done);
}

TEST(Compound, SaysWhatAPartLacks) {
  EXPECT_THAT(refusal_of_text("rigid.compound{parts = {{shape = 'sphere'}}}").text(),
              HasSubstr("a sphere has no 'radius'"));
  EXPECT_THAT(refusal_of_text("rigid.compound{parts = {{shape = 'box'}}}").text(),
              HasSubstr("a box has no 'size'"));
  EXPECT_THAT(refusal_of_text("rigid.compound{parts = {}}").text(), HasSubstr("empty list"));
}

TEST(Joints, AreMadeWhileTheSceneRuns) {
  const ScriptRun done = run_of_text(
      "scene{floor = false}\n"
      "local bob = rigid.sphere{radius = 0.1, mass = 1, position = {0.3, 2, 0}}\n"
      "function on_start() joint.ball{body = bob, at = {0, 2, 0}} end\n"
      "after{seconds = 1, call = function()\n"
      "  print(math.abs((bob:position() - vec(0, 2, 0)):length() - 0.3) < 0.02)\n"
      "  bob:remove()\n"
      "  print(pcall(joint.ball, {body = bob, at = {0, 2, 0}})) end}",
      1.1);
  EXPECT_THAT(done.printed, HasSubstr("true\nfalse\t")) << failure_of(done);
  EXPECT_THAT(done.printed, HasSubstr("the body was removed"));
}

TEST(Overlap, FindsBodiesObjectsAndTheFloor) {
  const ScriptRun done = run_of_text(
      std::string(kJelly) +
          "local ball = rigid.sphere{radius = 0.1, mass = 0, position = {1, 1, 0}}\n"
          "local function names(where)\n"
          "  local things, floor = overlap(where)\n"
          "  local text = floor and 'floor' or ''\n"
          "  for _, one in ipairs(things) do text = text .. ' ' .. one:name() end\n"
          "  return text\n"
          "end\n"
          "function on_start()\n"
          "  print(names{centre = {1, 1, 0}, radius = 0.01})\n"    // within the ball
          "  print(names{centre = {1.2, 1, 0}, radius = 0.09})\n"  // 1 cm away
          "  print(names{centre = {1.2, 1, 0}, radius = 0.11})\n"
          "  print(names{centre = {0, 0.1, 0}, size = {0.5, 0.3, 0.1}})\n"
          // A box of 1 m x 2 cm x 2 cm reaches the ball only when it is turned by 45 degrees.
          "  print(names{centre = {0.7, 0.7, 0}, size = {1, 0.02, 0.02}})\n"
          "  print(names{centre = {0.7, 0.7, 0}, size = {1, 0.02, 0.02},\n"
          "              rotation = {axis = {0, 0, 1}, angle = math.pi / 4}})\n"
          "end",
      0.02);
  EXPECT_EQ(done.printed, " body\n\n body\nfloor cube\n\n body\n") << failure_of(done);
}

// 8 kg that fall from 5 cm, v^2 = 2 g h, are stopped by m v = 8 * sqrt(2 * 9.81 * 0.05) = 7.9 N s
// and what gravity adds; the ball meets the jelly afterwards.
TEST(LatticeContacts, AreTold) {
  const ScriptRun done =
      run_of_text(std::string(kJelly) +
                      "local ball = rigid.sphere{name = 'ball', radius = 0.05, mass = 0.5,\n"
                      "                          position = {0, 1, 0}}\n"
                      "local sum = 0\n"
                      "function on_contact(e)\n"
                      "  print(e.thing:name(), e.other and e.other:name() or 'floor',\n"
                      "        math.abs(e.at.y - (e.other and 0.2 or 0)) < 0.05, e.impulse > 0)\n"
                      "end",
                  0.6);
  EXPECT_THAT(done.printed, HasSubstr("cube\tfloor\ttrue\ttrue\n")) << failure_of(done);
  const bool either = done.printed.find("ball\tcube\ttrue\ttrue\n") != std::string::npos ||
                      done.printed.find("cube\tball\ttrue\ttrue\n") != std::string::npos;
  EXPECT_TRUE(either) << done.printed;
}

// What the stage says of one lattice on the floor, summed over its ticks, is what stops it.
TEST(LatticeContacts, SayTheImpulseThatStopsIt) {
  const Scene scene = scene_of_text(std::string("scene{floor_friction = 0}\n") + kJelly);
  RunOptions options;
  options.policy = Policy::kFlexible;
  Simulation simulation(scene, options);
  double sum = 0.0;
  double mass = 8.0;
  for (int tick = 0; tick < 12; ++tick) {
    simulation.advance_tick();
    for (const bullet::StageContact& contact : simulation.stage().contacts()) {
      EXPECT_EQ(contact.first.kind, bullet::StageThing::Kind::kObject);
      EXPECT_EQ(contact.second.kind, bullet::StageThing::Kind::kFloor);
      EXPECT_LT(std::abs(contact.at.y()), 0.02);
      sum += contact.impulse;
    }
  }
  const double momentum = mass * simulation.result().summaries[0].velocity.y();
  const double fallen = -mass * 9.81 * 12.0 / 60.0;
  EXPECT_GT(sum, 5.0);
  EXPECT_NEAR(sum, momentum - fallen, 0.02 * sum);
}

TEST(Removal, TakesAnObjectAway) {
  const ScriptRun done = run_of_text(
      std::string(kJelly) +
          "local ball = rigid.sphere{radius = 0.05, mass = 0.5, position = {0, 0.35, 0}}\n"
          "after{seconds = 0.5, call = function()\n"
          "  cube:remove()\n"
          "  assert(ray{from = {0.05, 1, 0.05}, to = {0.05, 0.01, 0.05}} == nil)\n"
          "  print(cube:name(), pcall(cube.position, cube)) end}\n"
          "after{seconds = 1.5, call = function() print(ball:position().y < 0.06) end}",
      1.6);
  EXPECT_THAT(done.printed, HasSubstr("cube\tfalse\t")) << failure_of(done);
  EXPECT_THAT(done.printed, HasSubstr("the object was removed; forget it after object:remove()"));
  EXPECT_THAT(done.printed, HasSubstr("true\n"));
  ASSERT_EQ(done.result.summaries.size(), 1u);
  EXPECT_EQ(done.result.summaries[0].representation, "removed");
  EXPECT_EQ(done.result.fragments, 0u);
}

TEST(Removal, OfWhatHasJustCome) {
  const ScriptRun done =
      run_of_text(std::string(kJelly) +
                      "function on_start()\n"
                      "  local twin = spawn{model = cube:model(), name = 'twin',\n"
                      "                     position = {3, 0, 0}}\n"
                      "  twin:remove() end",
                  0.1);
  ASSERT_FALSE(done.result.failure) << failure_of(done);
  ASSERT_EQ(done.result.samples.back().objects.size(), 2u);
  EXPECT_NEAR(done.result.samples.back().objects[1].centre_of_mass.x(), 3.0, 0.01);
}

// The wind blows on the faces of what is there.
TEST(Removal, InTheWind) {
  const ScriptRun done = run_of_text(
      std::string(kJelly) +
          "local twin = spawn{model = shape.box{size = {0.2, 0.2, 0.2}, cells = {3, 3, 3},\n"
          "  material = jelly}:drag{normal = 1, tangential = 0}, position = {1, 0.15, 0}}\n"
          "wind.uniform{direction = {1, 0, 0}, speed = 5}\n"
          "function on_start() cube:remove() end\n"
          "after{seconds = 0.3, call = function() print(twin:velocity().x > 0.001) end}",
      0.4);
  EXPECT_EQ(done.printed, "true\n") << failure_of(done);
}

TEST(Switching, IsSetByTheScript) {
  const Scene scene = scene_of_text("switching{load_share = 0.1, calm_ticks = 9}");
  ASSERT_TRUE(scene.switching);
  EXPECT_EQ(scene.switching->load_share, 0.1);
  EXPECT_EQ(scene.switching->calm_ticks, 9);
  EXPECT_EQ(scene.switching->load_time, bullet::SwitchSettings{}.load_time);
  // What is rigid to a load of any size stays so, and breaks nothing.
  const std::string brick =
      "spawn{position = {0, 0.5, 0}, model = shape.box{size = {0.2, 0.1, 0.1}, cells = {4, 2, 2},\n"
      "  material = material{like = 'stoneware', softening = 1e4, damping_ratio = 0.2}}}";
  EXPECT_GT(run_of_text(brick, 0.5).result.to_flexible, 0u);
  const std::string never = "switching{load_share = 1e6, visible_strain = 1e6}\n";
  EXPECT_EQ(run_of_text(never + brick, 0.5).result.to_flexible, 0u);
}

// A cube of 1 m, half of it of twice the density: 1000 * 0.5 + 2000 * 0.5 kg, its centre of mass at
// (0.5 * 0.25 + 1.0 * 0.75) / 1.5 of the way up.
TEST(Regions, AreOfTheirOwnMaterial) {
  const std::string box =
      "local light = material{density = 1000, youngs_modulus = 1e6}\n"
      "local heavy = material{density = 2000, youngs_modulus = 1e6}\n"
      "spawn{model = shape.box{size = {1, 1, 1}, cells = {4, 4, 4}, corner = {0, 0, 0},\n"
      "  material = light, regions = {{material = heavy, ";
  const auto scene = scene_of_text(box + "low = {0, 0.5, 0}, high = {1, 1, 1}}}}}");
  double mass = 0.0, moment = 0.0;
  const PhysicalModel& model = scene.objects[0];
  for (PointId p : ids_of(model.points)) {
    mass += model.points[p].mass;
    moment += model.points[p].mass * model.geometry.points[p].y();
  }
  EXPECT_NEAR(mass, 1500.0, 1e-9);
  EXPECT_NEAR(moment / mass, 0.875 / 1.5, 1e-12);
  EXPECT_THAT(refusal_of_text(box + "low = {0, 0, 0}}}}}").text(),
              HasSubstr("'low' and 'high', or 'centre' and 'radius'"));
  EXPECT_NO_THROW(scene_of_text(box + "centre = {0, 0, 0}, radius = 0.5}}}}"));
}

}  // namespace
}  // namespace limber::demos::test

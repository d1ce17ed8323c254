#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/model/errors.h"
#include "demos/scenes/simulation.h"

// Whatever way bad input comes in, it is refused before anything moves, by a message that names the
// element and says what to do.

namespace limber::demos::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// What is said instead of doing it; empty, and a failure, where it is done.
template <class Action>
Diagnostic refusal(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    EXPECT_FALSE(error.diagnostic.remedy.empty());
    return error.diagnostic;
  }
  ADD_FAILURE() << "was accepted";
  return {};
}

Diagnostic refusal_of_teapot(const std::string& parameter, double value) {
  return refusal([&] { build_scene("tipsy_teapot", {{parameter, value}}); });
}

// The brick, spoilt by `spoil`, handed to a simulation.
template <class Spoil>
Diagnostic refusal_of_brick(const Spoil& spoil) {
  Scene scene = build_scene("jelly_and_brick");
  PhysicalModel& brick = scene.objects[1];
  spoil(brick);
  return refusal([&] { Simulation(scene, {}); });
}

TEST(BadInput, UnknownSceneIsNamedWithTheNearest) {
  const Diagnostic said = refusal([] { build_scene("tipsy_teapod"); });
  EXPECT_THAT(said.where, HasSubstr("tipsy_teapod"));
  EXPECT_THAT(said.remedy, HasSubstr("tipsy_teapot"));
}

TEST(BadInput, UnknownParameterIsNamedWithTheNearest) {
  const Diagnostic said = refusal_of_teapot("densty", 2400.0);
  EXPECT_THAT(said.where, HasSubstr("densty"));
  EXPECT_THAT(said.remedy, HasSubstr("density"));
}

TEST(BadInput, NegativeDensityIsRefused) {
  const Diagnostic said = refusal_of_teapot("density", -1.0);
  EXPECT_THAT(said.where, HasSubstr("density"));
  EXPECT_THAT(said.what, HasSubstr("-1 kg/m^3 is out of range"));
  EXPECT_THAT(said.remedy, HasSubstr("give 100 to 20000 kg/m^3"));
}

TEST(BadInput, ZeroDensityIsRefused) {
  EXPECT_THAT(refusal_of_teapot("density", 0.0).text(), ContainsRegex("density|point [0-9]+"));
}

TEST(BadInput, NonFiniteParameterIsRefused) {
  EXPECT_THAT(refusal_of_teapot("density", kNan).where, HasSubstr("density"));
  EXPECT_THAT(refusal_of_teapot("height", kInfinity).where, HasSubstr("height"));
}

TEST(BadInput, SofteningBelowOneIsRefused) {
  EXPECT_THAT(refusal_of_teapot("softening", 0.0).text(), HasSubstr("softening"));
}

// Each is refused by one message with its range; both ends of the range make a valid scene.
TEST(BadInput, EveryParameterHasARangeWithItsUnit) {
  for (const SceneEntry& scene : scene_library()) {
    for (const Parameter& p : scene.parameters) {
      SCOPED_TRACE(scene.name + " " + p.name);
      EXPECT_LT(p.least, p.most);
      EXPECT_LE(p.least, p.value);
      EXPECT_GE(p.most, p.value);
      for (double value : {1e30, -1e30, std::nextafter(p.most, 1e300)}) {
        const Diagnostic said = refusal([&] { build_scene(scene.name, {{p.name, value}}); });
        EXPECT_EQ(said.where, "scene " + scene.name + ": parameter " + p.name);
        EXPECT_THAT(said.what, HasSubstr("out of range"));
        EXPECT_THAT(said.remedy, HasSubstr(" to "));
        EXPECT_THAT(said.remedy, ::testing::EndsWith(p.unit));
      }
    }
  }
}

// 0.1 s at both ends of the ranges: nothing blows up.
TEST(BadInput, BothEndsOfEveryRangeRun) {
  for (const char* name : {"jelly_and_brick", "swing", "leaf_magic"}) {
    const auto& scenes = scene_library();
    const auto scene = std::ranges::find(scenes, name, &SceneEntry::name);
    ASSERT_NE(scene, scenes.end());
    for (const Parameter& p : scene->parameters) {
      if (p.name == "leaves") continue;
      for (double value : {p.least, p.most}) {
        SCOPED_TRACE(scene->name + " " + p.name);
        ParameterValues changes = {{p.name, value}};
        if (scene->name == "leaf_magic") changes["leaves"] = 10.0;
        RunOptions options;
        options.seconds = 0.1;
        EXPECT_NO_THROW(run(build_scene(scene->name, changes), options));
      }
    }
  }
}

TEST(BadInput, NonFiniteMassIsRefused) {
  for (double mass : {kNan, kInfinity, -1.0, 0.0}) {
    SCOPED_TRACE(mass);
    const Diagnostic said =
        refusal_of_brick([&](PhysicalModel& brick) { brick.points[PointId(17)].mass = mass; });
    EXPECT_EQ(said.where, "brick: point 17");
    EXPECT_THAT(said.what, HasSubstr("mass"));
  }
}

TEST(BadInput, EdgeWithoutRestLengthIsRefused) {
  const Diagnostic said =
      refusal_of_brick([](PhysicalModel& brick) { brick.edges[EdgeId(5)].rest_length = 0.0; });
  EXPECT_EQ(said.where, "brick: edge 5");
  EXPECT_THAT(said.what, HasSubstr("rest length"));
}

TEST(BadInput, EdgeFromAPointToItselfIsRefused) {
  const Diagnostic said = refusal_of_brick([](PhysicalModel& brick) {
    Edge& edge = brick.geometry.edges[EdgeId(5)];
    edge.b = edge.a;
  });
  EXPECT_EQ(said.where, "brick: edge 5");
}

TEST(BadInput, EdgeToAPointThatIsNotThereIsRefused) {
  const Diagnostic said = refusal_of_brick([](PhysicalModel& brick) {
    brick.geometry.edges[EdgeId(5)].b = PointId(brick.points.size());
  });
  EXPECT_EQ(said.where, "brick: edge 5");
}

TEST(BadInput, FaceOfAPointThatIsNotThereIsRefused) {
  const Diagnostic said = refusal_of_brick([](PhysicalModel& brick) {
    brick.geometry.faces[FaceId(3)].corners[2] = PointId(brick.points.size());
  });
  EXPECT_EQ(said.where, "brick: face 3");
}

TEST(BadInput, CellOfAnEdgeThatIsNotThereIsRefused) {
  const Diagnostic said = refusal_of_brick([](PhysicalModel& brick) {
    brick.geometry.cells[CellId(2)].edges[0] = EdgeId(brick.edges.size());
  });
  EXPECT_EQ(said.where, "brick: cell 2");
}

TEST(BadInput, PositionThatIsNotFiniteIsRefused) {
  const Diagnostic said =
      refusal_of_brick([](PhysicalModel& brick) { brick.geometry.points[PointId(9)].y() = kNan; });
  EXPECT_EQ(said.where, "brick: point 9");
}

}  // namespace
}  // namespace limber::demos::test

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "demos/scenes/simulation.h"

// Two cubes of 0.2 m fall 0.5 m side by side: one soft and wobbling, one stiff and at rest in
// itself. The policy tells them apart by their numbers.

namespace limber::demos::test {
namespace {

constexpr std::size_t kJelly = 0, kBrick = 1;

const RunResult& whole_run() {
  static const RunResult result = run(build_scene("jelly_and_brick"), {});
  return result;
}

// Free fall of the brick's lowest points, by the closed form.
double first_touch_s(const Scene& scene) { return std::sqrt(2.0 * 0.5 / -scene.gravity.y()); }

long last_tick_in_flight(const Scene& scene) {
  return static_cast<long>(std::floor(first_touch_s(scene) / scene.tick));
}

// 0 where all of the body is rigid, 1 where all of it is flexible.
double flexible_part(const Snapshot::Body& body) {
  const auto flexible = std::count(body.flexible.begin(), body.flexible.end(), true);
  return static_cast<double>(flexible) / static_cast<double>(body.flexible.size());
}

std::vector<SwitchEvent> switches_of(const RunResult& run, const std::string& body) {
  std::vector<SwitchEvent> events;
  for (const SwitchEvent& event : run.switches) {
    if (event.body == body) events.push_back(event);
  }
  return events;
}

TEST(JellyAndBrick, KeepTheirKindsInFlight) {
  const Scene scene = build_scene("jelly_and_brick");
  Simulation simulation(scene, {});
  for (long tick = 0; tick < last_tick_in_flight(scene); ++tick) {
    const Snapshot now = simulation.snapshot();
    EXPECT_EQ(flexible_part(now.bodies[kJelly]), 1.0) << now.time_s << " s";
    EXPECT_EQ(flexible_part(now.bodies[kBrick]), 0.0) << now.time_s << " s";
    simulation.advance_tick();
  }
}

TEST(JellyAndBrick, JellyStaysFlexibleWhileItWobbles) {
  const Scene scene = build_scene("jelly_and_brick");
  for (const SwitchEvent& event : switches_of(whole_run(), "jelly")) {
    EXPECT_GT(event.time_s, first_touch_s(scene)) << event.cause;
  }
}

// Or in the one before: the prediction allows for what Bullet's query rounds off the corners of
// boxes and proxies, up to 3 cm each.
TEST(JellyAndBrick, BrickTurnsFlexibleInTheTickOfItsTouch) {
  const Scene scene = build_scene("jelly_and_brick");
  const std::vector<SwitchEvent> brick = switches_of(whole_run(), "brick");
  const auto touched =
      std::find_if(brick.begin(), brick.end(), [](const SwitchEvent& e) { return e.to_flexible; });
  ASSERT_NE(touched, brick.end());
  const double tick_begins = static_cast<double>(last_tick_in_flight(scene)) * scene.tick;
  EXPECT_GE(touched->time_s, tick_begins - scene.tick - 1e-9) << touched->cause;
  EXPECT_LE(touched->time_s, tick_begins + scene.tick + 1e-9) << touched->cause;
  EXPECT_EQ(whole_run().missed, 0u);
}

// The jelly may have to sag into its rest once more: 3 s, the scene's own time, are enough in
// float64, 5 s in float32.
TEST(JellyAndBrick, ComeToRest) {
  Scene scene = build_scene("jelly_and_brick");
  scene.seconds = 6.0;
  for (const BodySummary& body : run(scene, {}).summaries) {
    EXPECT_LT(body.velocity.norm(), 0.02) << body.name;
  }
}

TEST(JellyAndBrick, LieOnTheFloor) {
  const auto& bodies = whole_run().summaries;
  EXPECT_NEAR(bodies[kBrick].centre_of_mass.y(), 0.1, 0.002);
  EXPECT_GT(bodies[kJelly].centre_of_mass.y(), 0.08);  // it sags under its weight
  EXPECT_LT(bodies[kJelly].centre_of_mass.y(), 0.1);
}

Scene with_swapped_names() {
  Scene scene = build_scene("jelly_and_brick");
  std::swap(scene.objects[kJelly].name, scene.objects[kBrick].name);
  std::swap(scene.objects[kJelly].geometry.subobjects[0].name,
            scene.objects[kBrick].geometry.subobjects[0].name);
  return scene;
}

void expect_same_but_for_the_body(const SwitchEvent& a, const SwitchEvent& b) {
  EXPECT_EQ(a.body, b.body == "jelly" ? "brick" : "jelly");
  EXPECT_EQ(a.time_s, b.time_s);
  EXPECT_EQ(a.to_flexible, b.to_flexible);
  EXPECT_EQ(a.cause, b.cause);
  EXPECT_EQ(a.numbers, b.numbers);
}

TEST(JellyAndBrick, AreToldApartByNumbersNotByNames) {
  const RunResult swapped = run(with_swapped_names(), {});
  EXPECT_EQ(swapped.state_hash, whole_run().state_hash);
  ASSERT_EQ(swapped.switches.size(), whole_run().switches.size());
  for (std::size_t i = 0; i < swapped.switches.size(); ++i) {
    expect_same_but_for_the_body(swapped.switches[i], whole_run().switches[i]);
  }
}

}  // namespace
}  // namespace limber::demos::test

#include "tests/scripting/script_runs.h"

// Every shape of rigid bodies lies where its size says, and the terrain and the mesh carry.

namespace limber::demos::test {
namespace {

// The height (m) of the middle of a body that fell from a little above where it comes to rest.
double height_at_rest(const std::string& body, const std::string& ground = "") {
  const ScriptRun done =
      run_of_text(ground + "local body = " + body +
                      "\nafter{seconds = 1.4, call = function() print(body:position().y) end}",
                  1.5);
  EXPECT_FALSE(done.result.failure);
  return std::stod(done.printed);
}

constexpr double kBullet = 0.005;  // m, what Bullet's contacts give way

TEST(RigidShapes, RestAtHalfTheirHeight) {
  EXPECT_NEAR(height_at_rest("rigid.box{size = {0.4, 0.2, 0.4}, mass = 1, position = {0, 0.2, 0}}"),
              0.1, kBullet);
  EXPECT_NEAR(height_at_rest("rigid.sphere{radius = 0.1, mass = 1, position = {0, 0.2, 0}}"), 0.1,
              kBullet);
  EXPECT_NEAR(height_at_rest(
                  "rigid.cylinder{radius = 0.2, height = 0.2, mass = 1, position = {0, 0.2, 0}}"),
              0.1, kBullet);
  EXPECT_NEAR(
      height_at_rest("rigid.cone{radius = 0.2, height = 0.2, mass = 1, position = {0, 0.2, 0}}"),
      0.1, kBullet);
  EXPECT_NEAR(
      height_at_rest("rigid.capsule{radius = 0.1, height = 0.3, mass = 1, position = {0, 0.2, 0},\n"
                     "rotation = {axis = {0, 0, 1}, angle = math.pi / 2}}"),
      0.1, kBullet);
}

TEST(RigidShapes, HullsDoNotFloatOnAMargin) {
  EXPECT_NEAR(height_at_rest("rigid.hull{mass = 1, position = {0, 0.2, 0}, points = {\n"
                             "{-0.2, -0.1, -0.2}, {0.2, -0.1, -0.2}, {-0.2, -0.1, 0.2},\n"
                             "{0.2, -0.1, 0.2}, {-0.2, 0.1, -0.2}, {0.2, 0.1, -0.2},\n"
                             "{-0.2, 0.1, 0.2}, {0.2, 0.1, 0.2}}}"),
              0.1, kBullet);
}

TEST(RigidShapes, MeshAndTerrainCarry) {
  const std::string ball = "rigid.sphere{radius = 0.1, mass = 1, position = {0.1, 0.8, 0.1}}";
  EXPECT_NEAR(height_at_rest(ball,
                             "rigid.mesh{points = {{-2, 0.5, -2}, {-2, 0.5, 2}, {2, 0.5, 2},\n"
                             "{2, 0.5, -2}}, triangles = {1, 2, 3, 1, 3, 4}}\n"),
              0.6, 2.0 * kBullet);
  EXPECT_NEAR(height_at_rest(ball,
                             "rigid.terrain{columns = 3, spacing = 1, position = {0, 0.2, 0},\n"
                             "heights = {0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3}}\n"),
              0.6, 2.0 * kBullet);
}

TEST(RigidShapes, RefuseWhatIsNoShape) {
  EXPECT_THAT(refusal_of_text("rigid.hull{points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}").text(),
              testing::HasSubstr("four"));
  EXPECT_THAT(
      refusal_of_text("rigid.mesh{points = {{0, 0, 0}, {1, 0, 0}}, triangles = {1, 2, 3}}").text(),
      testing::HasSubstr("not there"));
  EXPECT_THAT(
      refusal_of_text("rigid.terrain{columns = 2, spacing = 1, heights = {1, 2, 3}}").text(),
      testing::HasSubstr("columns x rows"));
}

}  // namespace
}  // namespace limber::demos::test

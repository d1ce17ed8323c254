#include "core/model/bounds.h"
#include "core/storage/model_file.h"
#include "tests/scripting/script_runs.h"
#include "tests/support/blocks.h"
#include "tests/support/same_model.h"
#include "tests/support/temporary_folder.h"

// A model file as a scene: the script that drops it does, to the bit, what place() and
// set_in_motion() do.

namespace limber::demos::test {
namespace {

using limber::test::TemporaryFolder;

class Drop : public testing::Test {
 protected:
  Drop() {
    model_.name = "a thing";
    place(model_, Mat3::Identity(), {0.1, -0.7, 1.3});
    write_model(model_, file_);
  }

  const TemporaryFolder folder_;
  const std::string file_ = (folder_ / "a.limber").string();
  PhysicalModel model_ = limber::test::block({.cells = {3, 1, 2}, .spacing = 0.1});
};

TEST_F(Drop, IsTheSameToTheBit) {
  // It lies from (0.1, -0.7, 1.3) to (0.4, -0.6, 1.5).
  struct Case {
    ParameterValues values;
    double height, speed, spin;
  };
  for (const Case& c : {Case{{}, 1.0, 0.0, 0.0}, Case{{{"height", 0.25}}, 0.25, 0.0, 0.0},
                        Case{{{"speed", -2.0}, {"spin", 3.5}}, 1.0, -2.0, 3.5}}) {
    const Scene scene = build_scene(file_, c.values);
    PhysicalModel expected = model_;
    const Box3 box(model_.geometry.points[PointId(0)],
                   model_.geometry.points[PointId(model_.points.size() - 1)]);
    place(expected, Mat3::Identity(),
          {-box.center().x(), c.height - box.min().y(), -box.center().z()});
    set_in_motion(expected, {c.speed, 0.0, 0.0}, {0.0, 0.0, -c.spin});
    ASSERT_EQ(scene.objects.size(), 1u);
    limber::test::expect_same_model(scene.objects[0], expected);
    EXPECT_EQ(scene.name, "a thing");
    EXPECT_EQ(scene.seconds, 3.0);
    EXPECT_TRUE(scene.camera.target.isApprox(Vec3(0.0, c.height + 0.05, 0.0)));
  }
}

TEST_F(Drop, RefusesWhatIsOutOfRange) {
  EXPECT_THROW(build_scene(file_, {{"height", 101.0}}), InputError);
  EXPECT_THROW(build_scene(file_, {{"heigth", 1.0}}), InputError);
}

// The script is trusted with as many points as the user's file has.
TEST_F(Drop, IsNotLimitedByWhatScriptsMayMake) {
  ScriptSettings settings;
  settings.limits.points = 0;
  EXPECT_NO_THROW(build_scene(file_, {}, settings));
}

}  // namespace
}  // namespace limber::demos::test

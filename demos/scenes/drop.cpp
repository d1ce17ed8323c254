#include <algorithm>

#include "core/model/errors.h"
#include "core/storage/model_file.h"
#include "demos/scenes/scenes.h"

namespace limber::demos {
namespace {

struct Extent {
  Vec3 low, high;
};

Extent extent_of(const PhysicalModel& model) {
  Extent box{model.geometry.points[PointId(0)], model.geometry.points[PointId(0)]};
  for (const Vec3& p : model.geometry.points) {
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
  }
  return box;
}

// Sees the floor below the model and the model at its height; zoomed, what happens at the floor.
Camera camera_for(const Vec3& size, double height, double zoom) {
  const double shown = (height + size.y() + 0.5 * size.norm()) / zoom;
  const Vec3 target(0.0, 0.45 * shown, 0.0);
  return {target + 2.2 * shown * Vec3(0.35, 0.25, 0.9), target, 32.0};
}

void require(bool good, const PhysicalModel& model, const std::string& what,
             const std::string& remedy) {
  if (!good) throw InputError({"scene " + model.name, what, remedy});
}

Scene build(PhysicalModel model, const ParameterValues& values) {
  require(!model.points.empty(), model, "the model has no points", "give one that has");
  require(values.at("height") >= 0.0, model, "the height is below 0", "give 0 m or more");
  require(values.at("zoom") > 0.0, model, "the zoom is not above 0", "give 1 or so");
  const Extent box = extent_of(model);
  const Vec3 middle = 0.5 * (box.low + box.high);
  const double height = values.at("height");
  place(model, Mat3::Identity(), {-middle.x(), height - box.low.y(), -middle.z()});
  set_in_motion(model, {values.at("speed"), 0.0, 0.0}, {0.0, 0.0, -values.at("spin")});
  Scene scene;
  scene.name = model.name;
  scene.seconds = 3.0;
  scene.camera = camera_for(box.high - box.low, height, values.at("zoom"));
  scene.objects.push_back(std::move(model));
  return scene;
}

}  // namespace

SceneEntry drop_of(const std::string& model_file) {
  return {model_file,
          "a model from a file falls on the floor",
          {{"height", 1.0, "m", "of the lowest point above the floor"},
           {"speed", 0.0, "m/s", "sideways"},
           {"spin", 0.0, "rad/s", "forward"},
           {"zoom", 1.0, "", "of the camera, towards where it lands"}},
          [model_file](const ParameterValues& values) {
            return build(read_model(model_file), values);
          }};
}

}  // namespace limber::demos

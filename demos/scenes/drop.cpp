#include "core/model/bounds.h"
#include "core/model/errors.h"
#include "core/storage/model_file.h"
#include "demos/scenes/scenes.h"

namespace limber::demos {
namespace {

// A little from the right and above, always on the model.
Camera camera_for(const Box3& model, double zoom) {
  const double size = model.sizes().norm();
  return {model.center() + size * Vec3(0.35, 0.25, 0.9), model.center(), 32.0, zoom};
}

void require(bool good, const PhysicalModel& model, const std::string& what,
             const std::string& remedy) {
  if (!good) throw InputError({"scene " + model.name, what, remedy});
}

Scene build(PhysicalModel model, const ParameterValues& values) {
  require(!model.points.empty(), model, "the model has no points", "give one that has");
  const Box3 box = bounds_of(model.geometry.points);
  const Vec3 middle = box.center();
  const double height = values.at("height");
  place(model, Mat3::Identity(), {-middle.x(), height - box.min().y(), -middle.z()});
  set_in_motion(model, {values.at("speed"), 0.0, 0.0}, {0.0, 0.0, -values.at("spin")});
  Scene scene;
  scene.name = model.name;
  scene.seconds = 3.0;
  scene.camera = camera_for(bounds_of(model.geometry.points), values.at("zoom"));
  scene.objects.push_back(std::move(model));
  return scene;
}

}  // namespace

SceneEntry drop_of(const std::string& model_file) {
  return {model_file,
          "a model from a file falls on the floor",
          {{"height", 1.0, "m", "of the lowest point above the floor", 0.0, 100.0},
           {"speed", 0.0, "m/s", "sideways", -50.0, 50.0},
           {"spin", 0.0, "rad/s", "forward", -50.0, 50.0},
           {"zoom", 1.0, "", "of the camera; at 1 the model fills the picture", 0.01, 100.0}},
          [model_file](const ParameterValues& values) {
            return build(read_model(model_file), values);
          }};
}

}  // namespace limber::demos

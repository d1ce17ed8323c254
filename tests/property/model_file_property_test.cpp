#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/operators/breaking_operator.h"
#include "core/storage/model_file.h"
#include "tests/property/generators.h"
#include "tests/support/same_model.h"
#include "tests/support/temporary_folder.h"

namespace limber::test {
namespace {

std::string random_name() { return *rc::gen::arbitrary<std::string>(); }

void randomise(PhysicalModel& model) {
  const bool moving = coin(), pinned = coin(), breakable = coin(), drag = coin();
  for (PointAttributes& p : model.points) {
    p.mass = uniform(1e-6, 10.0);
    if (moving) p.velocity = random_vector(100.0);
    if (pinned) p.pinned = coin();
  }
  for (EdgeAttributes& e : model.edges) {
    e.stiffness = uniform(0.0, 1e9);
    if (breakable) e.break_threshold = coin() ? kUnbreakable : uniform(1e-9, 1.0);
    if (breakable) e.crush_threshold = coin() ? kUnbreakable : uniform(1e-9, 1.0);
  }
  for (FaceAttributes& f : model.faces)
    if (drag)
      f = {*rc::gen::element(DragLaw::kQuadratic, DragLaw::kLinear, DragLaw::kPressure),
           uniform(0.0, 2.0), uniform(0.0, 2.0)};
  model.name = random_name();
  for (Subobject& s : model.geometry.subobjects) s.name = random_name();
  for (SubobjectAttributes& part : model.parts) {
    part.surface.texture = random_name();
    for (int n = *rc::gen::inRange(0, 4); n > 0; --n) part.values[random_name()] = uniform(-1, 1);
  }
}

RC_GTEST_PROP(ModelFileProperty, GivesBackAnyModelAndTheSameBytes, ()) {
  PhysicalModel model = coin() ? block(random_shape(3)) : sheet(*rc::gen::inRange(1, 5), coin());
  randomise(model);
  break_edges(model, ids(random_edges(model)));
  const TemporaryFolder folder;
  write_model(model, folder / "a");
  const PhysicalModel again = read_model(folder / "a");
  expect_same_model(again, model);
  write_model(again, folder / "b");
  RC_ASSERT(contents(folder / "a") == contents(folder / "b"));
  RC_ASSERT(!testing::Test::HasFailure());
}

}  // namespace
}  // namespace limber::test

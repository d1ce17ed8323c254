#pragma once

#include <Eigen/Geometry>
#include <array>

#include "core/environment/environment.h"
#include "tests/bridge/models.h"

// What the wind blows about, and the wind.

namespace limber::bullet::test {

inline void give_drag(PhysicalModel& model, double normal, double tangential) {
  for (FaceAttributes& face : model.faces) {
    face.normal_drag = normal;
    face.tangential_drag = tangential;
  }
}

// Two triangles bent along their common edge, with a brace across that keeps the bend. 9 g.
inline PhysicalModel leaf() {
  GeometricModelBuilder builder;
  builder.begin_subobject("leaf");
  const std::array<Vec3, 4> at = {Vec3(0.0, 0.0, 0.0), Vec3(0.1, 0.0, 0.03), Vec3(0.1, 0.01, -0.03),
                                  Vec3(0.2, 0.005, 0.0)};
  std::array<PointId, 4> p;
  for (int i = 0; i < 4; ++i) p[i] = builder.add_point(at[i]);
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 1; j < 4; ++j) builder.edge(p[i], p[j]);
  }
  builder.add_face({p[0], p[1], p[2]});
  builder.add_face({p[1], p[3], p[2]});
  PhysicalModel model = with_default_attributes(builder.finish(), "leaf");
  const std::array<double, 4> mass = {0.004, 0.002, 0.002, 0.001};
  for (int i = 0; i < 4; ++i) model.points[p[i]].mass = mass[i];
  for (EdgeAttributes& edge : model.edges) {
    edge.stiffness = 2e6;  // at 2e5 it bends enough to land 0.1 mm elsewhere
    edge.damping = 0.2;
  }
  give_drag(model, 1.2, 0.05);
  place(model, Eigen::AngleAxisd(0.3, Vec3(1.0, 2.0, 3.0).normalized()).toRotationMatrix(),
        {0.0, 3.0, 0.0});
  return model;
}

inline PhysicalModel plank() {
  PhysicalModel model =
      make_block({.cells = {6, 1, 2}, .spacing = 0.05, .mass = 0.15, .modulus = 2e8},
                 {0.0, 3.0, 0.0}, {0.5, 0.0, 0.0}, {0.5, 1.0, 3.0});
  give_drag(model, 1.2, 0.05);
  return model;
}

// A gust from the side that rises and falls, and a whirl that drifts by.
inline Air gusting_air() {
  Air air;
  FlowPrimitive gust;
  gust.direction = {1.0, 0.0, 0.3};
  gust.strength = Track<double>({{0.0, 1.0}, {0.4, 5.0}, {0.9, 2.0}});
  FlowPrimitive whirl;
  whirl.kind = FlowKind::kLineVortex;
  whirl.position = Track<Vec3>({{0.0, Vec3(-0.5, 3.0, 0.0)}, {1.0, Vec3(1.5, 1.0, 0.0)}});
  whirl.strength = 2.0;
  whirl.core_radius = 0.3;
  air.wind.primitives = {gust, whirl};
  return air;
}

}  // namespace limber::bullet::test

// Group 6: what the air does to faces. The flow alone is in kinds_flow.cpp.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tests/reference/build.h"
#include "tests/reference/flow.h"
#include "tests/reference/kinds.h"
#include "tests/reference/run.h"

namespace limber::reference {
namespace {

// ---- faces in the air --------------------------------------------------------------------------

constexpr double kDensity = 1.225;  // kg/m^3, of air where a case does not say

using Triangles = std::vector<std::array<int, 3>>;

// Points, edges and faces that belong to no cell; every face with the same drag.
PhysicalModel leaf_of(const std::vector<MassPoint>& points, const std::vector<Bond>& bonds,
                      const Triangles& triangles, const FaceAttributes& drag) {
  GeometricModelBuilder builder;
  builder.begin_subobject("leaf");
  for (const MassPoint& point : points) builder.add_point(point.position);
  const auto id = [](int p) { return PointId(std::size_t(p)); };
  for (const Bond& bond : bonds) builder.edge(id(bond.a), id(bond.b));
  for (const auto& [a, b, c] : triangles) builder.add_face({id(a), id(b), id(c)});
  const PhysicalModel springs = network(points, bonds);
  PhysicalModel model = with_default_attributes(builder.finish(), "leaf");
  model.points = springs.points;
  model.edges = springs.edges;
  model.object = springs.object;
  for (FaceAttributes& face : model.faces) face = drag;
  return model;
}

Environment in_air(double density, const FlowField& wind, const Vec3& gravity = Vec3::Zero()) {
  return {.gravity = gravity, .air = Air{density, wind}, .ground = {}};
}

FaceAttributes linear_drag(const Json& params) {
  return {DragLaw::kLinear, params.at("alpha_N"), params.at("alpha_T")};
}

FaceAttributes quadratic_drag(const Json& params, DragLaw law = DragLaw::kQuadratic) {
  return {law, params.at("C_N"), params.at("C_T")};
}

FlowField uniform_wind(const Json& velocity) { return {{uniform_flow(vec3(velocity))}}; }

Json triangle_force(const Case& c) {
  const Json &X = c.params.at("X"), &V = c.params.at("V");
  std::vector<MassPoint> points;
  for (int i = 0; i < 3; ++i) points.push_back({vec3(X.at(i)), 1.0, vec3(V.at(i))});
  const FlowField wind = uniform_wind(c.params.at("wind"));
  const auto force = [&](const FaceAttributes& drag) {
    Run run(leaf_of(points, {}, {{0, 1, 2}}, drag), in_air(c.params.at("rho"), wind));
    const std::vector<Vec3> f = run.forces();
    return Vec3(f[0] + f[1] + f[2]);
  };
  const Vec3 &a = points[0].position, &b = points[1].position, &d = points[2].position;
  const BodyFace face = body_face({a, b, d}, {});
  Vec3 velocity = Vec3::Zero();
  for (const MassPoint& point : points) velocity += point.velocity / 3.0;
  const Vec3 linear = force(linear_drag(c.params));
  return {{"area", face.area_vector.norm()},
          {"normal", to_json(Vec3(face.area_vector.normalized()))},
          {"u_rel", to_json(Vec3(flow_velocity(wind, face.centroid, 0.0) - velocity))},
          {"F_linear", to_json(linear)},
          {"F_quadratic", to_json(force(quadratic_drag(c.params)))},
          {"F_pressure", to_json(force(quadratic_drag(c.params, DragLaw::kPressure)))},
          {"power_linear", linear.dot(velocity)}};
}

// ---- a plate -----------------------------------------------------------------------------------

double triangle_area(const std::vector<MassPoint>& points, const std::array<int, 3>& t) {
  const Vec3& a = points[t[0]].position;
  return 0.5 * (points[t[1]].position - a).cross(points[t[2]].position - a).norm();
}

void lump_masses(std::vector<MassPoint>& points, const Triangles& triangles, double mass) {
  double total = 0.0;
  for (MassPoint& point : points) point.mass = 0.0;
  for (const auto& t : triangles) {
    const double area = triangle_area(points, t);
    total += area;
    for (int p : t) points[p].mass += area / 3.0;
  }
  for (MassPoint& point : points) point.mass *= mass / total;
}

std::vector<MassPoint> plate_points(const Json& params) {
  const int n = params.at("n");
  const double spacing = params.at("side").get<double>() / (n - 1);
  const Vec3 u = vec3(params.at("tangent")), v = vec3(params.at("normal")).cross(u);
  std::vector<MassPoint> points;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) points.push_back({spacing * (i * u + j * v)});
  }
  return points;
}

Triangles plate_triangles(int n) {
  Triangles triangles;
  for (int j = 0; j + 1 < n; ++j) {
    for (int i = 0; i + 1 < n; ++i) {
      const int p = i + n * j;
      triangles.push_back({p, p + 1, p + n + 1});
      triangles.push_back({p, p + n + 1, p + n});
    }
  }
  return triangles;
}

// The sides of the triangles as springs.
std::vector<Bond> sides_of(const std::vector<MassPoint>& points, const Triangles& triangles,
                           double stiffness) {
  std::vector<Bond> bonds;
  const auto add = [&](int a, int b) {
    for (const Bond& bond : bonds) {
      if ((bond.a == a && bond.b == b) || (bond.a == b && bond.b == a)) return;
    }
    bonds.push_back({a, b, stiffness, (points[b].position - points[a].position).norm()});
  };
  for (const auto& [a, b, d] : triangles) add(a, b), add(b, d), add(a, d);
  return bonds;
}

constexpr double kFlutterDamping = 100.0;  // 1/s

PhysicalModel plate(const Json& params, const FaceAttributes& drag) {
  std::vector<MassPoint> points = plate_points(params);
  const Triangles triangles = plate_triangles(params.at("n"));
  lump_masses(points, triangles, params.at("mass"));
  // Any springs will do, the plate falls without a load on them: a period of about half a second.
  const double stiffness = 100.0 * params.at("mass").get<double>() / double(points.size());
  PhysicalModel model = leaf_of(points, sides_of(points, triangles, stiffness), triangles, drag);
  // They do not bend it. Air that passes a limp sheet at an angle makes it flutter, out of nothing
  // but rounding; this keeps it flat.
  model.object.internal_damping = kFlutterDamping;
  return model;
}

struct Fall {
  std::vector<Vec3> velocity;  // at the sample times, m/s
  Json distance = Json::array();
  Vec3 terminal;          // m/s
  double rotation = 0.0;  // rad, at the last sample
};

double rotation_angle(const Lattice& lattice) {
  const Eigen::Quaterniond q(rotation(lattice));
  return 2.0 * std::atan2(q.vec().norm(), std::abs(q.w()));
}

// The air slows a light plate within some 30 ms.
double fall_step(const Run& run) { return std::min(1e-3, 0.2 * run.stable_step()); }

Run plate_in_air(const Case& c, const FaceAttributes& drag) {
  const double density = c.params.value("rho", kDensity);
  return Run(plate(c.params, drag),
             in_air(density, uniform_wind(c.params.at("wind")), gravity_of(c.params)));
}

// The velocity that a plate keeps: each second a flat one goes on with what the last one reached.
Vec3 terminal_velocity(const Case& c, const FaceAttributes& drag, Vec3 velocity) {
  for (int seconds = 0; seconds < 2000; ++seconds) {
    Run run = plate_in_air(c, drag);
    for (PointMotion& point : run.lattice().motion) point.velocity = velocity;
    run.advance_to(1.0, 8.0 * fall_step(run));
    const Vec3 before = velocity;
    velocity = rigid_motion(run.lattice()).velocity;
    if ((velocity - before).norm() <= 1e-13 * velocity.norm()) break;
  }
  return velocity;
}

Fall fall(const Case& c, const FaceAttributes& drag) {
  Run run = plate_in_air(c, drag);
  const double dt = fall_step(run);
  const Vec3 start = rigid_motion(run.lattice()).centre;
  Fall result;
  for (double time : c.inputs.at("t")) {
    run.advance_to(time, dt);
    const RigidMotion body = rigid_motion(run.lattice());
    result.velocity.push_back(body.velocity);
    result.distance.push_back((body.centre - start).norm());
  }
  result.rotation = rotation_angle(run.lattice());
  result.terminal = terminal_velocity(c, drag, result.velocity.back());
  return result;
}

Json plate_fall(const Case& c) {
  const Fall linear = fall(c, linear_drag(c.params));
  const Fall quadratic = fall(c, quadratic_drag(c.params));
  return {{"velocity_linear", to_json(linear.velocity)},
          {"terminal_velocity_linear", to_json(linear.terminal)},
          {"rotation_angle", std::max(linear.rotation, quadratic.rotation)},
          {"velocity_quadratic", to_json(quadratic.velocity)},
          {"terminal_velocity_quadratic", to_json(quadratic.terminal)},
          {"fall_distance_quadratic", quadratic.distance}};
}

// ---- a leaf ------------------------------------------------------------------------------------

PhysicalModel leaf_model(const Json& params) {
  std::vector<MassPoint> points;
  const Json& masses = params.at("masses");
  const Vec3 velocity = vec3(params.at("v0"));
  for (const Json& x : params.at("X")) {
    points.push_back({vec3(x), masses.at(points.size()), velocity});
  }
  std::vector<Bond> bonds;
  for (const auto& [a, b] : params.at("edges").get<std::vector<std::array<int, 2>>>()) {
    const double length = (points[b].position - points[a].position).norm();
    bonds.push_back({a, b, params.at("k"), length, params.at("c")});
  }
  const bool is_linear = params.at("model") == "linear";
  const FaceAttributes drag =
      is_linear ? linear_drag(params)
                : quadratic_drag(params, params.at("model") == "pressure" ? DragLaw::kPressure
                                                                          : DragLaw::kQuadratic);
  return leaf_of(points, bonds, params.at("triangles").get<Triangles>(), drag);
}

Json leaf(const Case& c) {
  const FlowField wind = flow_of(c.params.at("primitives"));
  Run run(leaf_model(c.params),
          in_air(c.params.value("rho", kDensity), wind, gravity_of(c.params)));
  const double dt = 0.05 * run.stable_step();
  Json all = Json::array(), com = Json::array();
  for (double time : c.inputs.at("t")) {
    run.advance_to(time, dt);
    all.push_back(to_json(positions(run.lattice())));
    com.push_back(to_json(rigid_motion(run.lattice()).centre));
  }
  return {{"positions", all}, {"com", com}};
}

}  // namespace

Kinds wind_kinds() {
  return {{"triangle_force", triangle_force}, {"plate_fall", plate_fall}, {"leaf", leaf}};
}

}  // namespace limber::reference

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "core/environment/face_drag.h"
#include "core/environment/face_forces.h"
#include "tests/property/generators.h"
#include "tests/support/blocks.h"
#include "tests/support/lattices.h"

// What holds for the air on any face and any body.

namespace limber {
namespace {

using test::random_edges;
using test::random_vector;
using test::uniform;

Mat3 random_rotation() {
  const double angle = uniform(-3.2, 3.2);
  const Vec3 axis = random_vector(1.0) + Vec3(0.0, 0.0, 1.5);
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

FaceAttributes random_face() {
  const DragLaw law = *rc::gen::element(DragLaw::kQuadratic, DragLaw::kLinear, DragLaw::kPressure);
  const double normal = uniform(0.0, 3.0), tangential = uniform(0.0, 1.0);
  return {law, normal, tangential};
}

FlowPrimitive random_primitive() {
  FlowPrimitive flow;
  flow.kind =
      *rc::gen::element(FlowKind::kUniform, FlowKind::kLineSource, FlowKind::kPointSource,
                        FlowKind::kLineVortex, FlowKind::kLineDoublet, FlowKind::kPointDoublet);
  flow.position = random_vector(5.0);
  flow.axis = random_vector(1.0) + Vec3(0.0, 0.0, 1.5);
  flow.direction = random_vector(1.0) + Vec3(1.5, 0.0, 0.0);
  flow.strength = uniform(-10.0, 10.0);
  flow.core_radius = uniform(0.01, 2.0);
  if (test::coin()) {
    flow.bounds = {random_vector(2.0), uniform(0.0, 4.0), uniform(0.0, 4.0)};
  }
  return flow;
}

FlowField random_wind() {
  FlowField field;
  for (int n = *rc::gen::inRange(0, 4); n > 0; --n) field.primitives.push_back(random_primitive());
  return field;
}

// ---- flow fields -------------------------------------------------------------------------------

FlowPrimitive moved(FlowPrimitive flow, const Mat3& rotation, const Vec3& translation) {
  flow.position = Vec3(rotation * flow.position.at(0.0) + translation);
  flow.axis = rotation * flow.axis;
  flow.direction = rotation * flow.direction;
  flow.bounds.centre = rotation * flow.bounds.centre + translation;
  return flow;
}

// Deep in a thin core all velocities are small differences of positions: the scale of rounding is
// the largest velocity there is.
double largest_speed(const FlowPrimitive& flow) {
  const double R = flow.core_radius;
  return std::abs(flow.strength.at(0.0)) * std::max({1.0, 1.0 / R, 1.0 / (R * R * R)});
}

RC_GTEST_PROP(FlowFieldProperty, DoesNotDependOnTheFrame, ()) {
  const FlowPrimitive flow = random_primitive();
  const Mat3 rotation = random_rotation();
  const Vec3 translation = random_vector(5.0), at = random_vector(5.0);
  const Vec3 here = flow_velocity(flow, at, 0.0);
  const Vec3 there =
      flow_velocity(moved(flow, rotation, translation), rotation * at + translation, 0.0);
  RC_ASSERT((there - rotation * here).norm() <= 1e-12 * largest_speed(flow));
}

RC_GTEST_PROP(FlowFieldProperty, IsTheSumOfItsPrimitives, ()) {
  const FlowField field = random_wind();
  const Vec3 at = random_vector(5.0);
  Vec3 sum = Vec3::Zero();
  for (const FlowPrimitive& flow : field.primitives) sum += flow_velocity(flow, at, 0.0);
  RC_ASSERT(flow_velocity(field, at, 0.0) == sum);
  RC_ASSERT(sum.allFinite());
}

// Steps of 1e-6 m across the core's edge and the bounds change the velocity by as little.
RC_GTEST_PROP(FlowFieldProperty, IsContinuous, ()) {
  FlowPrimitive flow = random_primitive();
  flow.bounds.fade = std::max(flow.bounds.fade, 0.1);
  const Vec3 out = (random_vector(1.0) + Vec3(0.0, 1.5, 0.0)).normalized();
  const Vec3 at = flow.position.at(0.0) + flow.core_radius * out;
  const Vec3 there = at + random_vector(1e-6);
  const double steepest = 30.0 * largest_speed(flow) * (1.0 / flow.core_radius + 10.0);
  const Vec3 change = flow_velocity(flow, there, 0.0) - flow_velocity(flow, at, 0.0);
  RC_ASSERT(change.norm() <= steepest * (there - at).norm());
}

// ---- one face ----------------------------------------------------------------------------------

RC_GTEST_PROP(FaceDragProperty, DoesNotDependOnTheSide, ()) {
  const FaceAttributes face = random_face();
  const Vec3 area = random_vector(1.0), u = random_vector(20.0);
  RC_ASSERT(face_drag(face, area, u, 1.2) == face_drag(face, -area, u, 1.2));
}

RC_GTEST_PROP(FaceDragProperty, RotatesWithTheFace, ()) {
  const FaceAttributes face = random_face();
  const Vec3 area = random_vector(1.0), u = random_vector(20.0);
  const Mat3 rotation = random_rotation();
  const Vec3 wanted = rotation * face_drag(face, area, u, 1.2);
  const Vec3 found = face_drag(face, rotation * area, rotation * u, 1.2);
  RC_ASSERT((found - wanted).norm() <= 1e-13 * (1.0 + u.squaredNorm()));
}

// Proportional to area; to the first or second power of the speed, odd in it; to the density or not
// at all.
RC_GTEST_PROP(FaceDragProperty, ScalesAsItsLawSays, ()) {
  const FaceAttributes face = random_face();
  const Vec3 area = random_vector(1.0), u = random_vector(20.0);
  const double a = uniform(0.1, 9.0), s = uniform(-3.0, 3.0), rho = uniform(0.1, 3.0);
  const bool linear = face.drag_law == DragLaw::kLinear;
  const double factor = a * (linear ? s : rho * std::abs(s) * s);
  const Vec3 wanted = factor * face_drag(face, area, u, 1.0);
  const Vec3 found = face_drag(face, a * area, s * u, rho);
  RC_ASSERT((found - wanted).norm() <= 1e-12 * (1.0 + wanted.norm()));
}

RC_GTEST_PROP(FaceDragProperty, NeverPullsAgainstTheRelativeWind, ()) {
  const FaceAttributes face = random_face();
  const Vec3 area = random_vector(1.0), u = random_vector(20.0);
  const double power = face_drag(face, area, u, 1.2).dot(u);
  RC_ASSERT(power >= -1e-14 * u.norm() * u.squaredNorm());
}

// ---- bodies ------------------------------------------------------------------------------------

// A block or a sheet with drag on some faces, deformed and with some edges broken.
Lattice random_body() {
  PhysicalModel model;
  if (test::coin()) {
    const int nx = *rc::gen::inRange(1, 4), ny = *rc::gen::inRange(1, 4);
    model = test::block({.cells = {nx, ny, 2}});
  } else {
    model = test::sheet(*rc::gen::inRange(1, 5), test::coin());
  }
  for (Vec3& x : model.geometry.points) x += random_vector(0.3);
  for (FaceAttributes& face : model.faces) face = random_face();
  Lattice lattice = test::lattice_of({model});
  const auto edges = *rc::gen::container<std::vector<std::int32_t>>(
      3, rc::gen::inRange(0, static_cast<int>(lattice.springs.size())));
  break_edges(lattice.topology, lattice.breaking, edges);
  return lattice;
}

std::vector<Vec3> forces_on(const Lattice& lattice, const Air& air) {
  std::vector<Vec3> forces(lattice.motion.size(), Vec3::Zero());
  add_face_forces(faces_in_air(lattice, PointRole::kDynamic), air, 0.0, lattice.motion, forces);
  return forces;
}

RC_GTEST_PROP(FaceForcesProperty, TakeEnergyOutInStillAir, ()) {
  Lattice lattice = random_body();
  for (PointMotion& p : lattice.motion) p.velocity = random_vector(10.0);
  const std::vector<Vec3> forces = forces_on(lattice, Air{});
  double power = 0.0, scale = 0.0;
  for (std::size_t p = 0; p < forces.size(); ++p) {
    power += forces[p].dot(lattice.motion[p].velocity);
    scale += forces[p].norm() * lattice.motion[p].velocity.norm();
  }
  RC_ASSERT(power <= 1e-13 * scale);
}

RC_GTEST_PROP(FaceForcesProperty, DoNotDependOnAFrameThatMoves, ()) {
  Lattice lattice = random_body();
  for (PointMotion& p : lattice.motion) p.velocity = random_vector(10.0);
  const Vec3 wind = random_vector(10.0), frame = random_vector(100.0);
  const std::vector<Vec3> here = forces_on(lattice, Air{.wind = {{uniform_flow(wind)}}});
  for (PointMotion& p : lattice.motion) p.velocity += frame;
  const std::vector<Vec3> there = forces_on(lattice, Air{.wind = {{uniform_flow(wind + frame)}}});
  for (std::size_t p = 0; p < here.size(); ++p) {
    RC_ASSERT((there[p] - here[p]).norm() <= 1e-10);  // 1e-16 of 100 m/s, times the slope of drag
  }
}

// The corners of a face in any order, clockwise or not.
RC_GTEST_PROP(FaceForcesProperty, DoNotDependOnTheOrderOfCorners, ()) {
  const std::vector<PointMotion> motion = {{random_vector(1.0), random_vector(5.0)},
                                           {random_vector(1.0), random_vector(5.0)},
                                           {random_vector(1.0), random_vector(5.0)}};
  const FaceAttributes attributes = random_face();
  const Air air{.wind = random_wind()};
  const auto force_of = [&](const std::array<std::int32_t, 3>& p) {
    const DragFace face{p[0], p[1], p[2], 0, attributes};
    std::vector<Vec3> forces(3, Vec3::Zero());
    add_face_forces({&face, 1}, air, 0.0, motion, forces);
    RC_ASSERT(forces[0] == forces[1] && forces[1] == forces[2]);
    return forces[0];
  };
  const Vec3 wanted = force_of({0, 1, 2});
  std::array<std::int32_t, 3> order = {0, 1, 2};
  while (std::next_permutation(order.begin(), order.end())) {
    RC_ASSERT((force_of(order) - wanted).norm() <= 1e-10 * (1e-3 + wanted.norm()));
  }
}

void move_rigidly(Lattice& lattice, const BodyMotion& body) {
  for (PointMotion& p : lattice.motion) {
    const Vec3 arm = body.rotation * p.position;
    p = {body.centre + arm, body.velocity + body.angular_velocity.cross(arm)};
  }
}

// A rigid proxy feels the same wind as its lattice would.
RC_GTEST_PROP(FaceForcesProperty, OnARigidBodySumUpToItsWrench, ()) {
  Lattice lattice = random_body();
  const auto faces = faces_in_air(lattice, PointRole::kDynamic);
  const std::vector<BodyFace> carried = body_faces(faces, lattice.motion, BodyMotion{});
  const BodyMotion body{random_vector(3.0), random_rotation(), random_vector(10.0),
                        random_vector(5.0)};
  move_rigidly(lattice, body);
  const Air air{.wind = random_wind()};
  const std::vector<Vec3> forces = forces_on(lattice, air);
  Wrench sum;
  double force_scale = 0.0, torque_scale = 0.0;
  for (std::size_t p = 0; p < forces.size(); ++p) {
    const Vec3 arm = lattice.motion[p].position - body.centre;
    sum.force += forces[p];
    sum.torque += arm.cross(forces[p]);
    force_scale += forces[p].norm();
    torque_scale += arm.norm() * forces[p].norm();
  }
  const Wrench wrench = rigid_face_wrench(carried, body, air, 0.0);
  RC_ASSERT((wrench.force - sum.force).norm() <= 1e-12 * force_scale);
  RC_ASSERT((wrench.torque - sum.torque).norm() <= 1e-12 * torque_scale);
}

// Faces taken from the world at any pose are those taken at rest.
RC_GTEST_PROP(BodyFacesProperty, AreTheSameFromEveryPose, ()) {
  Lattice lattice = random_body();
  const auto faces = faces_in_air(lattice, PointRole::kDynamic);
  const std::vector<BodyFace> at_rest = body_faces(faces, lattice.motion, BodyMotion{});
  BodyMotion body;
  body.centre = random_vector(3.0);
  body.rotation = random_rotation();
  move_rigidly(lattice, body);
  const std::vector<BodyFace> moved_back = body_faces(faces, lattice.motion, body);
  RC_ASSERT(moved_back.size() == at_rest.size());
  for (std::size_t i = 0; i < at_rest.size(); ++i) {
    RC_ASSERT((moved_back[i].centroid - at_rest[i].centroid).norm() <= 1e-13);
    RC_ASSERT((moved_back[i].area_vector - at_rest[i].area_vector).norm() <= 1e-13);
  }
}

}  // namespace
}  // namespace limber

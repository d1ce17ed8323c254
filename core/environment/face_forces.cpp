#include "core/environment/face_forces.h"

#include <algorithm>

#include "core/environment/face_drag.h"

namespace limber {
namespace {

bool has_corners(const DragFace& face, auto is_wanted) {
  return is_wanted(face.a) && is_wanted(face.b) && is_wanted(face.c);
}

// Appends the seen faces with drag of one object, if all their corners are wanted.
void append_faces(const Lattice& lattice, const LatticeObject& object, auto is_wanted,
                  std::vector<DragFace>& faces) {
  const PhysicalModel& model = object.authored;
  if (model.faces.empty()) return;  // it has none, or was retired
  for (std::int32_t f = object.faces.begin; f < object.faces.end; ++f) {
    const FaceId id(static_cast<std::size_t>(f - object.faces.begin));
    if (!lattice.breaking.face_external[f] || !has_drag(model.faces[id])) continue;
    const auto& [a, b, c] = model.geometry.faces[id].corners;
    const std::int32_t first = object.points.begin;
    const DragFace face{first + a.value, first + b.value, first + c.value, f, model.faces[id]};
    if (has_corners(face, is_wanted)) faces.push_back(face);
  }
}

Vec3 area_vector_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  return 0.5 * (b - a).cross(c - a);
}

Vec3 centroid_of(const Vec3& a, const Vec3& b, const Vec3& c) { return (a + b + c) / 3.0; }

// On a face at `centroid` that moves with `velocity`.
Vec3 force_on_face(const FaceAttributes& attributes, const Vec3& area_vector, const Vec3& centroid,
                   const Vec3& velocity, const Air& air, double time) {
  const Vec3 wind = flow_velocity(air.wind, centroid, time);
  return face_drag(attributes, area_vector, wind - velocity, air.density);
}

}  // namespace

std::vector<DragFace> faces_in_air(const Lattice& lattice, PointRole role) {
  const auto has_role = [&](std::int32_t p) { return lattice.role[p] == role; };
  std::vector<DragFace> faces;
  for (const LatticeObject& object : lattice.objects) {
    append_faces(lattice, object, has_role, faces);
  }
  return faces;
}

std::vector<DragFace> faces_in_air(const Lattice& lattice, std::span<const std::int32_t> points) {
  std::vector<DragFace> faces;
  // Objects are ranges of points, so that the ascending points come object by object.
  for (auto p = points.begin(); p != points.end();) {
    const LatticeObject& object = lattice.objects[lattice.point_object[*p]];
    const auto next = std::lower_bound(p, points.end(), object.points.end);
    const auto is_one_of_them = [&](std::int32_t q) { return std::binary_search(p, next, q); };
    append_faces(lattice, object, is_one_of_them, faces);
    p = next;
  }
  return faces;
}

void add_face_forces(std::span<const DragFace> faces, const Air& air, double time,
                     std::span<const PointMotion> motion, std::span<Vec3> force) {
  for (const DragFace& face : faces) {
    const PointMotion &a = motion[face.a], &b = motion[face.b], &c = motion[face.c];
    const Vec3 third =
        force_on_face(face.attributes, area_vector_of(a.position, b.position, c.position),
                      centroid_of(a.position, b.position, c.position),
                      (a.velocity + b.velocity + c.velocity) / 3.0, air, time) /
        3.0;
    for (std::int32_t p : {face.a, face.b, face.c}) force[p] += third;
  }
}

BodyFace body_face(const std::array<Vec3, 3>& corners, const FaceAttributes& attributes) {
  const auto& [a, b, c] = corners;
  return {centroid_of(a, b, c), area_vector_of(a, b, c), attributes};
}

std::vector<BodyFace> body_faces(std::span<const DragFace> faces,
                                 std::span<const PointMotion> motion, const BodyMotion& body) {
  const auto local = [&](std::int32_t p) -> Vec3 {
    return body.rotation.transpose() * (motion[p].position - body.centre);
  };
  std::vector<BodyFace> carried;
  carried.reserve(faces.size());
  for (const DragFace& face : faces) {
    carried.push_back(body_face({local(face.a), local(face.b), local(face.c)}, face.attributes));
  }
  return carried;
}

Wrench rigid_face_wrench(std::span<const BodyFace> faces, const BodyMotion& body, const Air& air,
                         double time) {
  Wrench sum;
  for (const BodyFace& face : faces) {
    const Vec3 arm = body.rotation * face.centroid;
    const Vec3 force =
        force_on_face(face.attributes, body.rotation * face.area_vector, body.centre + arm,
                      body.velocity + body.angular_velocity.cross(arm), air, time);
    sum.force += force;
    sum.torque += arm.cross(force);
  }
  return sum;
}

}  // namespace limber

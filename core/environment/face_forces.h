#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/dynamics/lattice.h"
#include "core/environment/environment.h"

namespace limber {

// ---- lattices ----------------------------------------------------------------------------------

// A face of a lattice that feels the air.
struct DragFace {
  std::int32_t a, b, c;  // points
  std::int32_t face;
  FaceAttributes attributes;
};

// The faces that have a drag coefficient and are seen, in ascending order: those of cells while
// they are part of the boundary (inner faces would multiply the drag of a closed body), those of
// sheets until an edge on one of their sides breaks. To be asked anew after breaks and changes of
// role. Cost: the faces of the objects concerned.
std::vector<DragFace> faces_in_air(const Lattice& lattice, PointRole role);  // of all corners
std::vector<DragFace> faces_in_air(const Lattice& lattice,
                                   std::span<const std::int32_t> points);  // ascending; all corners

// Adds the air's force on each face, a third to each corner: the wind at the centroid against the
// mean velocity of the corners. N; `time` in s.
void add_face_forces(std::span<const DragFace> faces, const Air& air, double time,
                     std::span<const PointMotion> motion, std::span<Vec3> force);

// ---- rigid bodies with the same faces ----------------------------------------------------------

// A face in its body's frame, about the body's centre.
struct BodyFace {
  Vec3 centroid;     // m
  Vec3 area_vector;  // m^2
  FaceAttributes attributes;
};

BodyFace body_face(const std::array<Vec3, 3>& corners, const FaceAttributes& attributes);

struct BodyMotion {
  Vec3 centre = Vec3::Zero();            // m
  Mat3 rotation = Mat3::Identity();      // body to world
  Vec3 velocity = Vec3::Zero();          // of the centre, m/s
  Vec3 angular_velocity = Vec3::Zero();  // world, rad/s
};

// The faces as a body with this pose carries them that takes the points where they are.
std::vector<BodyFace> body_faces(std::span<const DragFace> faces,
                                 std::span<const PointMotion> motion, const BodyMotion& body);

// World frame, torque about the body's centre; N and N m.
struct Wrench {
  Vec3 force = Vec3::Zero();
  Vec3 torque = Vec3::Zero();
};

// The sum of what add_face_forces() does to points that move rigidly. Exactly so: the mean velocity
// of the corners is the body's velocity at the centroid, and three equal forces at the corners are
// one at the centroid.
Wrench rigid_face_wrench(std::span<const BodyFace> faces, const BodyMotion& body, const Air& air,
                         double time);

}  // namespace limber

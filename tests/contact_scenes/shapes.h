#pragma once

#include <functional>
#include <vector>

#include "tests/contact_scenes/scene.h"

// Bullet's shapes, each with all that it refers to. Margins are a millimetre where Bullet adds them
// to the outside (hulls, cones, meshes): the true shape is what is authored.

namespace limber::bullet::test {

Shape box(const Vec3& size_m);
Shape sphere(double radius_m);
Shape capsule(double radius_m, double length_m);   // along y, with its ends
Shape cylinder(double radius_m, double height_m);  // along y
Shape cone(double radius_m, double height_m);      // along y
Shape hull(const std::vector<Vec3>& points_m);

struct Part {
  Shape shape;
  Vec3 position = Vec3::Zero();  // m
};
Shape compound(const std::vector<Part>& parts);

// Triangles of y = height(x, z) on a square of this side about the origin.
using Relief = std::function<double(double x, double z)>;
Shape mesh_floor(const Relief& height, double side_m, int cells);
// The same but as a scaled shape: of a mesh of half the size.
Shape scaled_mesh_floor(const Relief& height, double side_m, int cells);
Shape heightfield(const Relief& height, double side_m, int cells);

}  // namespace limber::bullet::test

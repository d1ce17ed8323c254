#pragma once

#include <filesystem>
#include <string>

#include "core/modeller/triangle_mesh.h"

namespace limber::test {

// A box from `low` to `high`, 12 triangles looking outwards; the first two are its side at high x.
TriangleMesh box_mesh(const Vec3& low, const Vec3& high);

// An icosahedron whose triangles were quartered `times` times, its vertices on the sphere.
TriangleMesh icosphere(double radius, int times, const Vec3& centre = Vec3::Zero());

// Around the y axis, `around` x `across` squares, two triangles each.
TriangleMesh torus_mesh(double major_radius, double minor_radius, int around, int across);

// The half y >= 0 of a sphere in rings of latitude; with a disc in y = 0 whose radius is `disc`
// (0: none) times the sphere's: the rim gap.
TriangleMesh hemisphere(double radius, int rings, double disc);

// Both, the second one's numbers behind the first one's.
TriangleMesh together(TriangleMesh a, const TriangleMesh& b);

// Every triangle with three vertices of its own, as STL has it.
TriangleMesh soup(const TriangleMesh& mesh);

TriangleMesh inside_out(TriangleMesh mesh);

// Every `step`-th triangle turned round.
TriangleMesh with_flipped(TriangleMesh mesh, std::size_t step);

TriangleMesh moved(TriangleMesh mesh, const Mat3& linear, const Vec3& shift);

void write_obj(const TriangleMesh& mesh, const std::filesystem::path& file);
void write_ply(const TriangleMesh& mesh, const std::filesystem::path& file);
void write_ascii_stl(const TriangleMesh& mesh, const std::filesystem::path& file);
void write_binary_stl(const TriangleMesh& mesh, const std::filesystem::path& file);

// A .gltf with its .bin beside it; the mesh twice, by nodes: as it is, and under a parent that is
// moved by `shift` with a child that mirrors x.
void write_gltf_twice(const TriangleMesh& mesh, const Vec3& shift,
                      const std::filesystem::path& file);

}  // namespace limber::test

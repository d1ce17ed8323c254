#pragma once

#include <filesystem>

#include "core/modeller/triangle_mesh.h"

namespace limber {

// Files above this are not read; 512 MiB hold about ten million triangles.
inline constexpr std::uintmax_t kMostMeshBytes = std::uintmax_t{512} << 20;

// And meshes of more triangles are not taken: a file may place one mesh many times.
inline constexpr std::size_t kMostMeshTriangles = 20'000'000;

// The triangles of an OBJ, PLY, STL or glTF file (.obj, .ply, .stl, .gltf, .glb), all its meshes
// where its nodes place them, polygons cut into triangles, lines and points left out. `scale`: m in
// a unit of the file (0.001 for millimetres). The mesh is named after the file. Throws InputError
// with the file, what is wrong and what to do: no such file, a folder, no permission, another kind,
// too large, empty, cut short, no triangles, a scale that is not positive. Positions that are not
// finite are left to mesh_defects().
TriangleMesh read_mesh(const std::filesystem::path& file, double scale = 1.0);

}  // namespace limber

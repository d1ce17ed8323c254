#include "core/modeller/voxel_lattice.h"

#include <utility>

namespace limber {
namespace {

// Points at the corners of kept cells, numbered x fastest like the grid's.
class CornerPoints {
 public:
  CornerPoints(const VoxelGrid& grid, const std::vector<std::int32_t>& kept,
               GeometricModelBuilder& builder)
      : corners_{grid.origin,
                 grid.spacing,
                 {grid.cells[0] + 1, grid.cells[1] + 1, grid.cells[2] + 1}},
        point_(corners_.size()) {
    std::vector<std::uint8_t> used(corners_.size(), 0);
    for (std::int32_t cell : kept)
      for (int c = 0; c < kHexahedronCorners; ++c)
        used[index(grid.place(std::size_t(cell)), c)] = 1;
    for (std::size_t i = 0; i < used.size(); ++i)
      if (used[i]) point_[i] = builder.add_point(corners_.lowest_corner(corners_.place(i)));
  }

  HexahedronCorners of(const VoxelIndex& place) const {
    HexahedronCorners corners;
    for (int c = 0; c < kHexahedronCorners; ++c) corners[c] = point_[index(place, c)];
    return corners;
  }

 private:
  std::size_t index(const VoxelIndex& p, int c) const {
    return corners_.index({p[0] + (c & 1), p[1] + (c >> 1 & 1), p[2] + (c >> 2 & 1)});
  }

  VoxelGrid corners_;  // one "cell" for every corner
  std::vector<PointId> point_;
};

}  // namespace

VoxelLattice voxel_lattice(const VoxelGrid& grid, const std::vector<std::int32_t>& kept,
                           const CellEdges& edges, std::string name) {
  GeometricModelBuilder builder;
  builder.begin_subobject(std::move(name));
  const CornerPoints points(grid, kept, builder);
  const auto pairs = corner_pairs(edges);
  VoxelLattice made;
  made.cells.reserve(kept.size());
  for (std::int32_t i : kept) {
    const VoxelIndex place = grid.place(std::size_t(i));
    const HexahedronCorners corners = points.of(place);
    made.cells.push_back({place, add_hexahedron(builder, corners, pairs), corners});
  }
  made.geometry = builder.finish();
  return made;
}

VoxelMoments voxel_moments(const VoxelGrid& grid, const std::vector<std::int32_t>& kept) {
  const double a = grid.spacing, volume = a * a * a;
  MomentSums full, lumped;
  full.origin = lumped.origin = grid.origin;
  for (std::int32_t cell : kept) {
    const Vec3 middle = grid.lowest_corner(grid.place(std::size_t(cell))) + Vec3::Constant(0.5 * a);
    full.add(volume, middle, volume * a * a / 12.0 * Mat3::Identity());
    lumped.add(volume, middle, volume * a * a / 4.0 * Mat3::Identity());
  }
  return {full.moments(), lumped.moments()};
}

}  // namespace limber

#include "core/modeller/voxels.h"

#include <algorithm>
#include <cmath>

namespace limber {
namespace {

constexpr int kSamples = 3;          // along each axis of a surface cell; odd: one in the middle
constexpr int kMargin = 1;           // cells around the box's
constexpr double kInside = 0.5;      // winding number
constexpr double kAmbiguity = 0.05;  // of winding numbers around kInside

// A cube of side a: its integral of x x^T about its centre, m^5.
Mat3 cube_spread(double a) { return std::pow(a, 5) / 12.0 * Mat3::Identity(); }

std::vector<std::int32_t> surface_cells(const VoxelGrid& grid, const TriangleMesh& fine) {
  std::vector<std::uint8_t> met(grid.size(), 0);
  for (const MeshTriangle& t : fine.triangles) {
    const Vec3 &a = fine.positions[t[0]], &b = fine.positions[t[1]], &c = fine.positions[t[2]];
    const VoxelIndex low = grid.around(a.cwiseMin(b).cwiseMin(c));
    const VoxelIndex high = grid.around(a.cwiseMax(b).cwiseMax(c));
    for (std::int32_t z = low[2]; z <= high[2]; ++z)
      for (std::int32_t y = low[1]; y <= high[1]; ++y)
        for (std::int32_t x = low[0]; x <= high[0]; ++x) met[grid.index({x, y, z})] = 1;
  }
  std::vector<std::int32_t> cells;
  for (std::size_t i = 0; i < met.size(); ++i)
    if (met[i]) cells.push_back(static_cast<std::int32_t>(i));
  return cells;
}

class Sampler {
 public:
  Sampler(const VoxelGrid& grid, const FastWindingNumber& winding)
      : grid_(grid), winding_(winding) {
    shares_.share.assign(grid.size(), 0.0f);
    sums_.origin = grid.origin;
  }

  // One place in the middle of the cell.
  void look_at_middle(std::size_t cell) {
    const Vec3 middle = corner(cell) + Vec3::Constant(0.5 * grid_.spacing);
    const double w = winding_.at(middle);
    note_middle(w);
    set(cell, w > kInside);
    if (w > kInside) note_inside(w, std::pow(grid_.spacing, 3));
  }

  void look_closely(std::size_t cell) {
    const Vec3 low = corner(cell);
    const double step = grid_.spacing / kSamples;
    int inside = 0;
    for (int s = 0; s < kSamples * kSamples * kSamples; ++s) {
      const Vec3 at(s % kSamples, s / kSamples % kSamples, s / (kSamples * kSamples));
      const Vec3 q = low + step * (at + Vec3::Constant(0.5));
      const double w = winding_.at(q);
      if (2 * s + 1 == kSamples * kSamples * kSamples) note_middle(w);
      shares_.highest = std::max(shares_.highest, w);
      if (!(w > kInside)) continue;
      ++inside;
      note_inside(w, step * step * step);
      sums_.add(step * step * step, q, cube_spread(step));
    }
    shares_.share[cell] = static_cast<float>(inside) / (kSamples * kSamples * kSamples);
  }

  // Of a cell away from the surface: all or nothing.
  void set(std::size_t cell, bool inside) {
    shares_.share[cell] = inside ? 1.0f : 0.0f;
    if (!inside) return;
    const Vec3 middle = corner(cell) + Vec3::Constant(0.5 * grid_.spacing);
    sums_.add(std::pow(grid_.spacing, 3), middle, cube_spread(grid_.spacing));
  }

  bool is_inside(std::size_t cell) const { return shares_.share[cell] > 0.5f; }

  VoxelShares take(std::vector<std::int32_t> surface) {
    shares_.surface = std::move(surface);
    shares_.moments = sums_.moments();
    shares_.openness = sums_.zeroth > 0.0 ? open_ / sums_.zeroth : 0.0;
    return std::move(shares_);
  }

 private:
  Vec3 corner(std::size_t cell) const { return grid_.lowest_corner(grid_.place(cell)); }
  void note_middle(double w) {
    if (std::abs(w - kInside) < kAmbiguity) ++shares_.ambiguous;
    shares_.highest = std::max(shares_.highest, w);
  }

  void note_inside(double w, double volume) {
    open_ += volume * std::abs(w - std::max(1.0, std::round(w)));
  }

  const VoxelGrid& grid_;
  const FastWindingNumber& winding_;
  double open_ = 0.0;  // m^3
  VoxelShares shares_;
  MomentSums sums_;
};

}  // namespace

bool VoxelGrid::contains(const VoxelIndex& p) const {
  for (std::size_t k = 0; k < 3; ++k)
    if (p[k] < 0 || p[k] >= cells[k]) return false;
  return true;
}

VoxelIndex VoxelGrid::place(std::size_t index) const {
  const auto nx = std::size_t(cells[0]), ny = std::size_t(cells[1]);
  return {std::int32_t(index % nx), std::int32_t(index / nx % ny), std::int32_t(index / (nx * ny))};
}

Vec3 VoxelGrid::lowest_corner(const VoxelIndex& p) const {
  return origin + spacing * Vec3(p[0], p[1], p[2]);
}

VoxelIndex VoxelGrid::around(const Vec3& x) const {
  VoxelIndex p;
  for (std::size_t k = 0; k < 3; ++k) {
    const double at = std::floor((x[Eigen::Index(k)] - origin[Eigen::Index(k)]) / spacing);
    p[k] = static_cast<std::int32_t>(std::clamp(at, 0.0, double(cells[k] - 1)));
  }
  return p;
}

VoxelGrid grid_around(const TriangleMesh& mesh, double spacing_m) {
  const auto [low, high] = bounding_box(mesh);
  VoxelGrid grid;
  grid.spacing = spacing_m;
  Vec3 size;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double n = std::max(1.0, std::round((high[k] - low[k]) / spacing_m));
    grid.cells[std::size_t(k)] = static_cast<std::int32_t>(n) + 2 * kMargin;
    size[k] = n * spacing_m;
  }
  grid.origin = 0.5 * (low + high - size) - Vec3::Constant(kMargin * spacing_m);
  return grid;
}

VoxelShares voxel_shares(const VoxelGrid& grid, const TriangleMesh& fine,
                         const FastWindingNumber& winding, bool closed) {
  Sampler sampler(grid, winding);
  std::vector<std::int32_t> surface = surface_cells(grid, fine);
  std::size_t next = 0;             // of the surface cells
  bool neighbour_is_clear = false;  // the cell before, in the same row, is no surface cell
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (i % std::size_t(grid.cells[0]) == 0) neighbour_is_clear = false;
    if (next < surface.size() && std::size_t(surface[next]) == i) {
      ++next;
      sampler.look_closely(i);
      neighbour_is_clear = false;
    } else if (closed && neighbour_is_clear) {
      sampler.set(i, sampler.is_inside(i - 1));
    } else {
      sampler.look_at_middle(i);
      neighbour_is_clear = true;
    }
  }
  return sampler.take(std::move(surface));
}

}  // namespace limber

#include "bullet_bridge/proxy_shape.h"

#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "bullet_bridge/shape_material.h"
#include "core/dynamics/components.h"
#include "tests/bridge/models.h"
#include "tests/bridge/random.h"

namespace limber::bullet::test {
namespace {

Lattice lattice_of(const Block& block) {
  Lattice lattice;
  add_object(lattice, make_block(block, Vec3::Zero()));
  return lattice;
}

std::vector<std::int32_t> all_points(const Lattice& lattice) {
  std::vector<std::int32_t> points(lattice.motion.size());
  std::iota(points.begin(), points.end(), 0);
  return points;
}

std::vector<Vec3> positions(const Lattice& lattice, const std::vector<std::int32_t>& points) {
  std::vector<Vec3> places;
  for (std::int32_t p : points) places.push_back(lattice.motion[p].position);
  return places;
}

TEST(FittedShape, OfABrickIsABox) {
  const Lattice lattice = lattice_of({.cells = {4, 3, 2}});
  const std::vector<std::int32_t> points = all_points(lattice);
  const std::vector<Vec3> local = positions(lattice, points);
  const ProxyShape shape = fit_proxy_shape(shape_material(lattice, points, local));
  EXPECT_EQ(shape.shape().getShapeType(), BOX_SHAPE_PROXYTYPE);
}

TEST(FittedShape, OfATaperedBrickRestsOnItsMaterial) {
  const Lattice lattice = lattice_of({.cells = {4, 4, 4}});
  const std::vector<std::int32_t> points = all_points(lattice);
  std::vector<Vec3> local = positions(lattice, points);
  for (Vec3& p : local) p.x() *= 1.0 - p.y();
  const ProxyShape shape = fit_proxy_shape(shape_material(lattice, points, local));
  ASSERT_EQ(shape.shape().getShapeType(), CONVEX_HULL_SHAPE_PROXYTYPE);
  const auto& hull = static_cast<const btConvexHullShape&>(shape.shape());
  EXPECT_EQ(hull.getNumPoints(), 8);
  // Its flat sides lie where the material's do, margin and all.
  for (int axis : {1, 2}) {
    for (double sign : {-1.0, 1.0}) {
      btVector3 direction(0, 0, 0);
      direction[axis] = btScalar(sign);
      const double reach = hull.localGetSupportingVertex(direction).dot(direction);
      EXPECT_NEAR(reach, 0.2, 1e-6);
    }
  }
}

// Its tip is no farther out than the rim in any of the 98 directions.
TEST(FittedShape, OfALowTentIsNoSlab) {
  ShapeMaterial tent;
  tent.points = {{-1.0, 0.0, -0.8}, {1.0, 0.0, -0.9}, {0.1, 0.0, 1.1}, {0.03, 0.02, -0.2}};
  const ProxyShape shape = fit_proxy_shape(tent);
  ASSERT_EQ(shape.shape().getShapeType(), CONVEX_HULL_SHAPE_PROXYTYPE);
  EXPECT_EQ(static_cast<const btConvexHullShape&>(shape.shape()).getNumPoints(), 4);
}

// ---- hollow things -----------------------------------------------------------------------------

// Unit cells in a square of ten by ten, those at its rim alone or all of them.
struct Tiles {
  bool rim_alone;
  int asked = 0;  // for the parts

  bool is_there(int x, int y) const { return !rim_alone || x == 0 || y == 0 || x == 9 || y == 9; }

  ShapeParts parts() const {
    ShapeParts parts;
    parts.points.start.push_back(0);
    for (int x = 0; x < 10; ++x) {
      for (int y = 0; y < 10; ++y) {
        if (!is_there(x, y)) continue;
        for (int corner = 0; corner < 8; ++corner) {
          parts.points.items.push_back(((x + (corner & 1)) * 11 + y + (corner >> 1 & 1)) * 2 +
                                       (corner >> 2));
        }
        parts.points.start.push_back(static_cast<std::int32_t>(parts.points.items.size()));
        parts.volumes.push_back(1.0);
      }
    }
    return parts;
  }

  // Turned about z, so that it is no box.
  ShapeMaterial material() {
    ShapeMaterial material;
    const Mat3 turn = Eigen::AngleAxisd(0.3, Vec3::UnitZ()).toRotationMatrix();
    for (int i = 0; i < 11 * 11 * 2; ++i) {
      material.points.push_back(turn * Vec3(i / 22 - 5, i / 2 % 11 - 5, i % 2 - 0.5));
    }
    material.parts = parts().volumes.size();
    material.volume = static_cast<double>(material.parts);
    material.list_parts = [this] {
      ++asked;
      return parts();
    };
    return material;
  }
};

TEST(FittedShape, OfSolidTilesIsOneHullAndAsksForNoParts) {
  Tiles tiles{.rim_alone = false};
  const ProxyShape shape = fit_proxy_shape(tiles.material());
  EXPECT_EQ(shape.shape().getShapeType(), CONVEX_HULL_SHAPE_PROXYTYPE);
  EXPECT_EQ(tiles.asked, 0);
}

TEST(FittedShape, OfARimIsSeveralHullsThatHoldItsCells) {
  Tiles tiles{.rim_alone = true};
  const ShapeMaterial material = tiles.material();
  const ProxyShape shape = fit_proxy_shape(material);
  ASSERT_EQ(shape.shape().getShapeType(), COMPOUND_SHAPE_PROXYTYPE);
  EXPECT_EQ(tiles.asked, 1);
  const auto& compound = static_cast<const btCompoundShape&>(shape.shape());
  EXPECT_GE(compound.getNumChildShapes(), 2);
  EXPECT_LE(compound.getNumChildShapes(), 8);
  // Each cell's middle lies within one of them: all of its corners are in one group.
  const auto within = [&](const Vec3& place) {
    for (int i = 0; i < compound.getNumChildShapes(); ++i) {
      const auto& hull = static_cast<const btConvexHullShape&>(*compound.getChildShape(i));
      bool inside = true;
      for (int k = 0; k < 64 && inside; ++k) {
        const double turn = 0.1 * k;
        const btVector3 direction(btScalar(std::cos(turn)), btScalar(std::sin(turn)), 0);
        const double reach = hull.localGetSupportingVertex(direction).dot(direction);
        inside = place.x() * std::cos(turn) + place.y() * std::sin(turn) <= reach + 1e-5;
      }
      if (inside) return true;
    }
    return false;
  };
  const ShapeParts parts = tiles.parts();
  for (std::size_t part = 0; part < parts.points.rows(); ++part) {
    Vec3 middle = Vec3::Zero();
    for (std::int32_t p : parts.points[part]) middle += material.points[p] / 8.0;
    EXPECT_TRUE(within(middle)) << middle.transpose();
  }
  EXPECT_FALSE(within(Vec3::Zero()));  // the hole
}

// ---- the material of a piece -------------------------------------------------------------------

// Corners of the whole cells that the points belong to, asked cell by cell: the slow way.
std::vector<std::vector<std::int32_t>> corners_of_cells(const Lattice& lattice,
                                                        const std::vector<std::int32_t>& of) {
  std::vector<std::vector<std::int32_t>> cells;
  for (std::size_t c = 0; c < lattice.breaking.cell_valid.size(); ++c) {
    if (!lattice.breaking.cell_valid[c]) continue;
    std::set<std::int32_t> corners;
    for (std::int32_t e : lattice.topology.cell_edges[c]) {
      corners.insert(lattice.springs[e].a);
      corners.insert(lattice.springs[e].b);
    }
    if (std::binary_search(of.begin(), of.end(), *corners.begin())) {
      cells.emplace_back(corners.begin(), corners.end());
    }
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

// Every thirtieth of its edges, and what that breaks with it.
void break_some(Lattice& lattice, Random& random) {
  std::vector<std::int32_t> edges;
  for (std::size_t e = 0; e < lattice.springs.size(); ++e) {
    if (random.between(0, 30) < 1) edges.push_back(static_cast<std::int32_t>(e));
  }
  break_edges(lattice.topology, lattice.breaking, edges);
  rebuild_active(lattice);
}

void expect_the_same_cells(const Lattice& lattice, const std::vector<std::int32_t>& points) {
  const std::vector<Vec3> local = positions(lattice, points);
  const auto wanted = corners_of_cells(lattice, points);
  const ShapeMaterial material = shape_material(lattice, points, local);
  EXPECT_EQ(material.parts, wanted.size());
  EXPECT_NEAR(material.volume, 1e-3 * static_cast<double>(wanted.size()), 1e-12);
  const ShapeParts parts = material.list_parts();
  std::vector<std::vector<std::int32_t>> got;
  for (std::size_t part = 0; part < parts.points.rows(); ++part) {
    std::vector<std::int32_t> corners;
    for (std::int32_t p : parts.points[part]) {
      const auto at = std::find(local.begin(), local.end(), material.points[p]);
      ASSERT_NE(at, local.end());
      corners.push_back(points[at - local.begin()]);
    }
    std::sort(corners.begin(), corners.end());
    got.push_back(corners);
  }
  std::sort(got.begin(), got.end());
  EXPECT_EQ(got, wanted);
  std::set<std::int32_t> in_cells;
  for (const auto& cell : wanted) in_cells.insert(cell.begin(), cell.end());
  EXPECT_EQ(material.points.size(), wanted.empty() ? points.size() : in_cells.size());
}

TEST(ShapeMaterial, IsTheWholeCellsOfEachPieceOfWhatBroke) {
  Random random(6);
  std::size_t pieces = 0, without_cells = 0;
  for (int run = 0; run < 20; ++run) {
    SCOPED_TRACE(run);
    Lattice lattice = lattice_of({.cells = {4, 3, 3}});
    break_some(lattice, random);
    for (const std::vector<std::int32_t>& points : points_of(components(lattice))) {
      expect_the_same_cells(lattice, points);
      ++pieces;
      without_cells += corners_of_cells(lattice, points).empty();
    }
  }
  EXPECT_GT(pieces, 40u);
  EXPECT_GT(without_cells, 5u);
  EXPECT_LT(without_cells, pieces);
}

}  // namespace
}  // namespace limber::bullet::test

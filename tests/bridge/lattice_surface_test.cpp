#include "bullet_bridge/lattice_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "core/modeller/sheet.h"
#include "core/modeller/thin_material.h"
#include "tests/bridge/models.h"

namespace limber::bullet::test {
namespace {

// A lattice with its boundary, as the bridge keeps them.
struct Subject {
  Lattice lattice;
  BoundaryTracker boundary;

  explicit Subject(const std::vector<PhysicalModel>& models) {
    for (const PhysicalModel& model : models) add_object(lattice, model);
    rebuild_active(lattice);
    boundary.reset(lattice.breaking);
  }
  LatticeSurface surface() const { return {lattice, boundary}; }
  std::size_t break_edge(std::int32_t edge) {  // cells that went with it
    const BreakingResult result =
        break_edges(lattice.topology, lattice.breaking, std::vector<std::int32_t>{edge});
    boundary.update(lattice.topology, result);
    return result.invalid_cells.size();
  }
  std::int32_t edge_between(const Vec3& a, const Vec3& b) const {
    for (std::size_t e = 0; e < lattice.springs.size(); ++e) {
      const Vec3 from = lattice.motion[lattice.springs[e].a].position;
      const Vec3 to = lattice.motion[lattice.springs[e].b].position;
      const bool forwards = (from - a).norm() + (to - b).norm() < 1e-9;
      if (forwards || (from - b).norm() + (to - a).norm() < 1e-9) {
        return static_cast<std::int32_t>(e);
      }
    }
    ADD_FAILURE() << "no such edge";
    return 0;
  }
};

constexpr double kSpacing = 0.1;            // m
constexpr double kCell = 1e-3;              // m^3
const Block kBrick = {.cells = {2, 3, 4}};  // 52 squares outside
const Vec3 kHalf = 0.5 * Vec3(0.2, 0.3, 0.4);

Vec3 twice_area(const Lattice& lattice, const SurfaceFace& face) {
  const auto at = [&](int i) { return lattice.motion[face.corners[i]].position; };
  return (at(1) - at(0)).cross(at(2) - at(0));
}

// What faces enclose, m^3: by the divergence theorem the sum over points of x . (twice the area
// vectors around it) is 2 * 3 corners * 3 volumes. Faces that leave a hole or look inwards spoil
// it.
double enclosed(const Lattice& lattice, const LatticeSurface& surface) {
  double sum = 0.0;
  for (std::size_t p = 0; p < lattice.motion.size(); ++p) {
    sum +=
        lattice.motion[p].position.dot(surface.outwards_at(lattice, static_cast<std::int32_t>(p)));
  }
  return sum / 18.0;
}

std::vector<std::int32_t> numbers(const LatticeSurface& surface) {
  std::vector<std::int32_t> faces;
  for (const SurfaceFace& face : surface.faces()) faces.push_back(face.face);
  return faces;
}

TEST(LatticeSurface, OfABrickLooksOutwards) {
  const Subject brick({make_block(kBrick, Vec3::Zero())});
  const LatticeSurface surface = brick.surface();
  ASSERT_EQ(surface.faces().size(), 2u * 52u);
  for (const SurfaceFace& face : surface.faces()) {
    const Vec3 area = twice_area(brick.lattice, face);
    EXPECT_NEAR(area.norm(), kSpacing * kSpacing, 1e-12);
    const Vec3 normal = area.normalized();
    // On the side that it looks to: each corner lies at that half extent.
    for (std::int32_t p : face.corners) {
      EXPECT_NEAR(normal.dot(brick.lattice.motion[p].position), normal.cwiseAbs().dot(kHalf),
                  1e-12);
    }
    EXPECT_FALSE(face.sheet);
  }
}

TEST(LatticeSurface, ListsEachFaceOnceAndAscending) {
  const Subject two({make_block(kBrick, Vec3::Zero()), make_block({}, {1.0, 0.0, 0.0})});
  const std::vector<std::int32_t> faces = numbers(two.surface());
  EXPECT_EQ(faces.size(), 2u * (52u + 54u));
  EXPECT_EQ(std::adjacent_find(faces.begin(), faces.end(), std::greater_equal<>()), faces.end());
}

TEST(LatticeSurface, KnowsWhichWayEachPointLooks) {
  const Subject brick({make_block(kBrick, Vec3::Zero())});
  const LatticeSurface surface = brick.surface();
  for (std::size_t p = 0; p < brick.lattice.motion.size(); ++p) {
    const Vec3 x = brick.lattice.motion[p].position;
    const Vec3 outwards = surface.outwards_at(brick.lattice, static_cast<std::int32_t>(p));
    for (int i = 0; i < 3; ++i) {
      const bool outside = std::abs(std::abs(x[i]) - kHalf[i]) < 1e-9;
      EXPECT_EQ(outwards[i] * x[i] > 1e-6, outside) << "point " << p;
      EXPECT_GE(outwards[i] * x[i], -1e-15) << "point " << p;
    }
    EXPECT_FALSE(surface.is_of_sheet(static_cast<std::int32_t>(p)));
  }
}

TEST(LatticeSurface, EnclosesTheBrick) {
  Subject brick({make_block(kBrick, {3.0, -2.0, 1.0})});
  EXPECT_NEAR(enclosed(brick.lattice, brick.surface()), 24 * kCell, 1e-12);
}

// An edge at a rim takes one cell with it, one within all four around it.
TEST(LatticeSurface, ClosesAgainWhereCellsHaveBroken) {
  Subject brick({make_block(kBrick, Vec3::Zero())});
  const std::int32_t at_the_rim = brick.edge_between({-0.1, -0.15, -0.2}, {0.0, -0.15, -0.2});
  const std::int32_t inside = brick.edge_between({0.0, -0.05, 0.0}, {0.0, 0.05, 0.0});
  EXPECT_EQ(brick.break_edge(at_the_rim), 1u);
  EXPECT_NEAR(enclosed(brick.lattice, brick.surface()), 23 * kCell, 1e-12);
  EXPECT_EQ(brick.break_edge(inside), 4u);
  EXPECT_NEAR(enclosed(brick.lattice, brick.surface()), 19 * kCell, 1e-12);
}

// Until it is made anew a surface has lost what has gone, and nothing else.
TEST(LatticeSurface, LosesFacesAtOnceWhereCellsBreak) {
  Subject bar({make_block({.cells = {2, 1, 1}}, Vec3::Zero())});
  const LatticeSurface surface = bar.surface();
  bar.break_edge(bar.edge_between({-0.1, -0.05, -0.05}, {-0.1, 0.05, -0.05}));
  for (const SurfaceFace& face : surface.faces()) {
    Vec3 centre = Vec3::Zero();
    for (std::int32_t p : face.corners) centre += bar.lattice.motion[p].position / 3.0;
    EXPECT_EQ(surface.has(face.face), centre.x() > 0.0);
  }
  for (std::size_t p = 0; p < bar.lattice.motion.size(); ++p) {
    if (bar.lattice.motion[p].position.x() > -0.05) continue;
    EXPECT_EQ(surface.outwards_at(bar.lattice, static_cast<std::int32_t>(p)), Vec3::Zero());
  }
}

// The tracker's own order goes by the order of the breaks.
TEST(LatticeSurface, DoesNotDependOnTheOrderOfTheBreaks) {
  Subject one({make_block(kBrick, Vec3::Zero())}), other = one;
  for (std::int32_t edge : {0, 40, 80}) one.break_edge(edge);
  for (std::int32_t edge : {80, 0, 40}) other.break_edge(edge);
  EXPECT_NE(one.boundary.faces(), other.boundary.faces());
  const LatticeSurface a = one.surface(), b = other.surface();
  EXPECT_EQ(numbers(a), numbers(b));
  for (std::size_t p = 0; p < one.lattice.motion.size(); ++p) {
    const auto point = static_cast<std::int32_t>(p);
    EXPECT_EQ(a.outwards_at(one.lattice, point), b.outwards_at(other.lattice, point));
  }
}

TEST(LatticeSurface, IsThatOfFlexiblePiecesAlone) {
  Subject two({make_block(kBrick, Vec3::Zero()), make_block(kBrick, {1.0, 0.0, 0.0})});
  const IdRange<PointId> first = two.lattice.objects[0].points;
  std::fill_n(two.lattice.role.begin(), first.size(), PointRole::kCarried);
  const LatticeSurface surface = two.surface();
  EXPECT_EQ(surface.faces().size(), 104u);
  for (const SurfaceFace& face : surface.faces()) EXPECT_GE(face.corners[0], first.end);
  EXPECT_EQ(surface.outwards_at(two.lattice, 0), Vec3::Zero());
}

// Of either kind: flat cells, as sheet() makes them, or faces that belong to no cell.
PhysicalModel square_sheet(bool with_cells) {
  const auto flat = [](double u, double v) -> Vec3 { return {u, 0.0, -v}; };
  Material material;
  material.density = 1000.0;
  material.youngs_modulus = 1e6;
  PhysicalModel model = with_sheet_material(sheet(flat, {2, 2, SheetCells::kSquares}, "sheet"),
                                            "sheet", material, {.thickness = 0.01});
  if (with_cells) return model;
  for (Face& face : model.geometry.faces) face.cell = {};
  model.geometry.cells = {};
  model.cells = {};
  model.geometry.subobjects[0].cells = {};
  return model;
}

TEST(LatticeSurface, HasTwoSidesWhereItIsASheet) {
  for (bool with_cells : {false, true}) {
    const Subject sheet({square_sheet(with_cells)});
    const LatticeSurface surface = sheet.surface();
    EXPECT_EQ(surface.faces().size(), 8u);
    const auto one_sided = [](const SurfaceFace& face) { return !face.sheet; };
    EXPECT_EQ(std::count_if(surface.faces().begin(), surface.faces().end(), one_sided), 0)
        << (with_cells ? "flat cells" : "faces without a cell");
    EXPECT_EQ(surface.is_of_sheet(0), surface.faces()[0].sheet);
  }
}

}  // namespace
}  // namespace limber::bullet::test

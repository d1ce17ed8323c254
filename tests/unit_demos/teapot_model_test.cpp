#include "demos/scenes/teapot_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/dynamics/stable_step.h"
#include "core/model/validate.h"
#include "core/operators/boundary_operator.h"
#include "tests/support/measure.h"

namespace limber::demos {
namespace {

using ::testing::ElementsAre;

const PhysicalModel& teapot() {
  static const PhysicalModel model = teapot_model();
  return model;
}

double mass_of(const PhysicalModel& model) {
  double mass = 0.0;
  for (const PointAttributes& p : model.points) mass += p.mass;
  return mass;
}

// Area of the outer side of a part: triangles of the boundary that look away from the wall are half
// of it but for the rims, which are narrow.
double half_surface(const SurfaceModel& s) {
  double area = 0.0;
  for (const SurfaceTriangle& t : s.triangles) {
    const Vec3& a = s.points[t.corners[0]];
    area += (s.points[t.corners[1]] - a).cross(s.points[t.corners[2]] - a).norm() / 2.0;
  }
  return area / 2.0;
}

std::size_t connected_pieces(const PhysicalModel& model) {
  std::vector<std::size_t> root(model.points.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  std::size_t pieces = root.size();
  for (const Edge& e : model.geometry.edges) {
    const std::size_t a = find(e.a.index()), b = find(e.b.index());
    if (a == b) continue;
    root[a] = b;
    --pieces;
  }
  return pieces;
}

TEST(TeapotModel, IsFourPartsAndTheirGlue) {
  std::vector<std::string> names;
  for (const Subobject& s : teapot().geometry.subobjects) names.push_back(s.name);
  EXPECT_THAT(names, ElementsAre("body", "lid", "glue: body + lid", "spout", "glue: teapot + spout",
                                 "handle", "glue: teapot + handle"));
}

TEST(TeapotModel, IsValidAndInOnePiece) {
  EXPECT_TRUE(validate(teapot()).empty());
  EXPECT_EQ(connected_pieces(teapot()), 1u);
}

TEST(TeapotModel, HasThePointsAndSizeOfTheScene) {
  EXPECT_GT(teapot().points.size(), 1500u);
  EXPECT_LT(teapot().points.size(), 4000u);
  Vec3 low = Vec3::Constant(1.0), high = -low;
  for (const Vec3& p : teapot().geometry.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  EXPECT_NEAR(high.x() - low.x(), 0.25, 0.01);
  EXPECT_NEAR(low.y(), 0.0, 1e-4);
}

TEST(TeapotModel, HasNoInvertedCell) {
  for (CellId c : ids_of(teapot().geometry.cells))
    EXPECT_GT(cell_volume(teapot().geometry, c), 1e-8);  // 10 mm^3 of a usual 120
}

// Stoneware of 5 mm: density x thickness x mean area of both sides.
TEST(TeapotModel, WeighsWhatItsWallsWeigh) {
  const double walls = half_surface(boundary(teapot())) * 0.005 * 2400.0;
  EXPECT_NEAR(mass_of(teapot()) / walls, 1.0, 0.1);
  EXPECT_GT(mass_of(teapot()), 0.6);
  EXPECT_LT(mass_of(teapot()), 1.0);
}

TEST(TeapotModel, HasAClosedSurface) { EXPECT_EQ(test::unmatched_sides(boundary(teapot())), 0); }

TEST(TeapotModel, EveryPartHangsOnManyBonds) {
  for (const Subobject& s : teapot().geometry.subobjects) {
    const bool is_glue = s.points.size() == 0;
    EXPECT_TRUE(!is_glue || s.edges.size() > 50u) << s.name;
  }
}

TEST(TeapotModel, IsAffordable) {
  const FrequencyBound bound = highest_frequency(teapot());
  EXPECT_TRUE(bound.verified);
  EXPECT_LT(1.0 / 60.0 / (0.95 * stable_step(bound.omega_max, 0.2)), 800.0);
}

TEST(TeapotModel, DampingFitsTheWholeNotTheParts) {
  const double omega = highest_frequency(teapot()).omega_max;
  for (const EdgeAttributes& e : teapot().edges)
    EXPECT_NEAR(e.damping, 2.0 * 0.2 / omega * e.stiffness, 1e-9 * e.stiffness);
}

TEST(TeapotModel, BreaksAtThreePercentGiveOrTakeAndLessOnSeams) {
  int weak = 0;
  for (const EdgeAttributes& e : teapot().edges) {
    const double strain = e.break_threshold / e.rest_length;
    EXPECT_GT(strain, 0.03 * 0.3 * (1.0 - 3 * 0.15) - 1e-12);
    EXPECT_LT(strain, 0.03 * (1.0 + 3 * 0.15) + 1e-12);
    weak += strain < 0.03 * 0.3 * (1.0 + 3 * 0.15);
  }
  const double share = weak / static_cast<double>(teapot().edges.size());
  EXPECT_GT(share, 0.1);
  EXPECT_LT(share, 0.5);
}

TEST(TeapotModel, SofteningTravelsAndKeepsTheMass) {
  EXPECT_EQ(teapot().object.softening, 2000.0);
  const PhysicalModel softer = teapot_model({.softening = 8000.0});
  EXPECT_EQ(softer.object.softening, 8000.0);
  EXPECT_NEAR(mass_of(softer), mass_of(teapot()), 1e-12);
  EXPECT_NEAR(highest_frequency(softer).omega_max, highest_frequency(teapot()).omega_max / 2.0,
              0.04 * highest_frequency(softer).omega_max);
}

TEST(TeapotModel, IsTheSameEveryTimeAndDiffersWithTheSeed) {
  const PhysicalModel again = teapot_model(), other = teapot_model({.seed = 2});
  bool same = true, differs = false;
  for (EdgeId e : ids_of(teapot().edges)) {
    same = same && again.edges[e].break_threshold == teapot().edges[e].break_threshold;
    differs = differs || other.edges[e].break_threshold != teapot().edges[e].break_threshold;
  }
  EXPECT_TRUE(same);
  EXPECT_TRUE(differs);
}

// A finer or coarser teapot is built just as well.
TEST(TeapotModel, CanBeBuiltAtOtherSpacings) {
  for (double spacing : {0.0075, 0.008, 0.01}) {
    EXPECT_TRUE(validate(teapot_model({.spacing = spacing})).empty());
  }
}

}  // namespace
}  // namespace limber::demos

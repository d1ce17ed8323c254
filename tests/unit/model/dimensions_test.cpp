#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/model/validate.h"
#include "core/modeller/cubic_lattice.h"
#include "core/operators/boundary_operator.h"
#include "core/operators/breaking_operator.h"
#include "core/operators/gluing_operator.h"
#include "tests/support/blocks.h"
#include "tests/support/measure.h"

// Particles, ropes, sheets and blocks are the same hierarchy with or without its upper levels, and
// any of them may be glued to any other (paper, section 3).

namespace limber {
namespace {

using ::testing::ElementsAre;

constexpr double kGap = 0.25;  // m, between what is glued

// Numbers that tell the parts apart after whatever happens to them.
void mark(PhysicalModel& model, double number) {
  model.parts[0].surface.colour = Vec3(0.1 * number, 0.5, 0.25);
  model.parts[0].surface.transparency = 0.05 * number;
  model.parts[0].surface.index_of_refraction = 1.0 + number;
  model.parts[0].surface.texture = model.name + ".png";
  model.parts[0].values["temperature"] = 300.0 + number;
  for (PointAttributes& p : model.points) p.mass = number;
}

struct Kind {
  std::string name;
  std::array<int, 3> points;  // per axis, 1 m apart
};

const Kind kKinds[] = {{"particle", {1, 1, 1}},
                       {"rope", {4, 1, 1}},
                       {"triangles", {3, 3, 1}},
                       {"squares", {3, 3, 1}},
                       {"block", {3, 3, 3}}};
constexpr int kKindCount = 5;

// Triangles are faces without a cell, squares are 2-D cells.
PhysicalModel model_of(int kind) {
  const auto& [name, points] = kKinds[kind];
  PhysicalModel model = cubic_lattice({.points = points, .springs = {100, 100, 100}, .name = name});
  if (name == "triangles") {
    model = test::sheet(2, false);
    model.name = model.geometry.subobjects[0].name = name;
  }
  mark(model, kind + 1.0);
  return model;
}

double length_x(int kind) { return kKinds[kind].points[0] - 1.0; }

PhysicalModel model_at(int kind, double x) {
  PhysicalModel model = model_of(kind);
  place(model, Mat3::Identity(), Vec3(x, 0, 0));
  return model;
}

GlueResult glued(int kind_a, int kind_b) {
  return glue(model_of(kind_a), model_at(kind_b, length_x(kind_a) + kGap),
              {.distance = kGap, .stiffness = 50.0});
}

// The end of one and the beginning of the other face each other: as many bonds as both have points.
std::size_t facing_points(int kind_a, int kind_b) {
  std::size_t n = 1;
  for (int axis : {1, 2})
    n *= static_cast<std::size_t>(
        std::min(kKinds[kind_a].points[axis], kKinds[kind_b].points[axis]));
  return n;
}

// Name and everything that mark() did.
void expect_part(const PhysicalModel& m, std::size_t part, int kind) {
  const SubobjectAttributes& found = m.parts.at(part);
  const SubobjectAttributes wanted = model_of(kind).parts[0];
  EXPECT_EQ(m.geometry.subobjects.at(part).name, kKinds[kind].name);
  EXPECT_EQ(found.surface.colour, wanted.surface.colour);
  EXPECT_EQ(found.surface.transparency, wanted.surface.transparency);
  EXPECT_EQ(found.surface.index_of_refraction, wanted.surface.index_of_refraction);
  EXPECT_EQ(found.surface.texture, wanted.surface.texture);
  EXPECT_EQ(found.values, wanted.values);
  const IdRange<PointId> points = m.geometry.subobjects[part].points;
  for (std::int32_t p = points.begin; p < points.end; ++p)
    EXPECT_EQ(m.points[PointId(std::size_t(p))].mass, kind + 1.0);
}

void expect_valid(const PhysicalModel& m) {
  const std::vector<Diagnostic> found = validate(m);
  EXPECT_TRUE(found.empty()) << found.front().text();
}

TEST(Dimensions, LevelsThatAnObjectDoesNotHaveAreEmpty) {
  const auto sizes = [](int kind) {
    const PhysicalModel m = model_of(kind);
    expect_valid(m);
    return std::array{m.points.size(), m.edges.size(), m.faces.size(), m.cells.size()};
  };
  EXPECT_THAT(sizes(0), ElementsAre(1, 0, 0, 0));
  EXPECT_THAT(sizes(1), ElementsAre(4, 3, 0, 0));
  EXPECT_THAT(sizes(2), ElementsAre(9, 12 + 4, 8, 0));
  EXPECT_THAT(sizes(3), ElementsAre(9, 12 + 8, 8, 4));
  EXPECT_THAT(sizes(4), ElementsAre(27, 54 + 72 + 32, 96, 8));
}

TEST(Dimensions, EachGluesToEachOther) {
  for (int a = 0; a < kKindCount; ++a)
    for (int b = 0; b < kKindCount; ++b) {
      SCOPED_TRACE(kKinds[a].name + " and " + kKinds[b].name);
      const GlueResult r = glued(a, b);
      expect_valid(r.model);
      EXPECT_EQ(r.bonds, facing_points(a, b));
      ASSERT_EQ(r.model.parts.size(), 3u);
      expect_part(r.model, 0, a);
      expect_part(r.model, 1, b);
      EXPECT_EQ(test::topology_counts(r.model).at("components_by_edges"), 1);
      EXPECT_EQ(boundary(r.model).triangles.size(),
                boundary(model_of(a)).triangles.size() + boundary(model_of(b)).triangles.size());
    }
}

std::vector<EdgeId> ids_in(IdRange<EdgeId> range) {
  std::vector<EdgeId> ids;
  for (std::int32_t e = range.begin; e < range.end; ++e) ids.push_back(EdgeId(std::size_t(e)));
  return ids;
}

TEST(Dimensions, BreakingAllBondsGivesTheTwoBack) {
  for (int a = 0; a < kKindCount; ++a)
    for (int b = 0; b < kKindCount; ++b) {
      SCOPED_TRACE(kKinds[a].name + " and " + kKinds[b].name);
      PhysicalModel m = glued(a, b).model;
      const std::size_t triangles = boundary(m).triangles.size();
      break_edges(m, ids_in(m.geometry.subobjects[2].edges));
      expect_valid(m);
      const std::map<std::string, int> counts = test::topology_counts(m);
      EXPECT_EQ(counts.at("components_by_edges"), 2);
      EXPECT_EQ(counts.at("edges_live"),
                static_cast<int>(model_of(a).edges.size() + model_of(b).edges.size()));
      EXPECT_EQ(boundary(m).triangles.size(), triangles);
      expect_part(m, 0, a);
      expect_part(m, 1, b);
    }
}

// particle - rope - triangles - squares - block, in a row; parts 0, 1, 3, 5, 7 and the glue
// between.
PhysicalModel all_in_one() {
  PhysicalModel m = model_of(0);
  double x = 0.0;
  for (int kind = 1; kind < kKindCount; ++kind) {
    x += length_x(kind - 1) + kGap;
    m = glue(m, model_at(kind, x), {.distance = kGap, .stiffness = 50.0}).model;
  }
  return m;
}

int part_of(int kind) { return std::max(0, 2 * kind - 1); }

TEST(Dimensions, AllTogetherAreOneObject) {
  const PhysicalModel m = all_in_one();
  expect_valid(m);
  EXPECT_EQ(m.points.size(), 1u + 4u + 9u + 9u + 27u);
  EXPECT_EQ(m.edges.size(), 3u + 16u + 20u + 158u + (1u + 1u + 3u + 3u));
  EXPECT_EQ(test::topology_counts(m).at("components_by_edges"), 1);
  for (int kind = 0; kind < kKindCount; ++kind) expect_part(m, part_of(kind), kind);
}

std::vector<int> triangles_by_part(const PhysicalModel& m) {
  std::vector<int> counts(m.parts.size(), 0);
  for (const SurfaceTriangle& t : boundary(m).triangles) ++counts[t.subobject];
  return counts;
}

// The first edge of every part. The rope falls in two; the sheet of triangles loses the one at its
// lower side; the square goes with two triangles; the corner cell of the block shows 3 of its 6
// sides and leaves 3 others behind.
TEST(Dimensions, AllTogetherBreakAsEachAloneDoes) {
  PhysicalModel m = all_in_one();
  ASSERT_THAT(triangles_by_part(m), ElementsAre(0, 0, 0, 8, 0, 8, 0, 48, 0));
  std::vector<EdgeId> first;
  for (int kind = 1; kind < kKindCount; ++kind)
    first.push_back(ids_in(m.geometry.subobjects[part_of(kind)].edges).front());
  break_edges(m, first);
  expect_valid(m);
  EXPECT_THAT(triangles_by_part(m), ElementsAre(0, 0, 0, 7, 0, 6, 0, 48, 0));
  const auto invalid = std::count_if(m.cells.begin(), m.cells.end(),
                                     [](const CellAttributes& c) { return !c.valid; });
  EXPECT_EQ(invalid, 2);
  for (int kind = 0; kind < kKindCount; ++kind) expect_part(m, part_of(kind), kind);
}

// Figure 2 of the paper: two ropes and a seat, modelled apart, simulated as one. The ropes end
// above the left and right edges of the seat.
TEST(Dimensions, TheSwingOfTheFigure) {
  const auto rope = [](double x, const char* name) {
    return cubic_lattice({.points = {1, 6, 1},
                          .spacing = 0.4,
                          .origin = {x, 0.1, 0.2},
                          .springs = {.axial = 5000.0},
                          .mass = 0.02,
                          .name = name});
  };
  PhysicalModel seat = cubic_lattice({.points = {5, 2, 3},
                                      .spacing = 0.1,
                                      .origin = {0.0, -0.05, 0.1},
                                      .springs = {2e4, 2e4, 2e4},
                                      .mass = 0.2,
                                      .name = "seat"});
  seat.parts[0].surface.colour = Vec3(0.6, 0.3, 0.1);
  const GlueBond knot{.distance = 0.06, .stiffness = 1e4};
  GlueResult left = glue(seat, rope(0.0, "left rope"), knot);
  GlueResult swing = glue(left.model, rope(0.4, "right rope"), knot);
  EXPECT_EQ(left.bonds + swing.bonds, 2u);
  expect_valid(swing.model);
  EXPECT_NEAR(total_mass(swing.model), 30 * 0.2 + 12 * 0.02, 1e-12);
  EXPECT_EQ(swing.model.parts[0].surface.colour, Vec3(0.6, 0.3, 0.1));
  EXPECT_EQ(swing.model.geometry.subobjects[3].name, "right rope");
  EXPECT_EQ(test::topology_counts(swing.model).at("components_by_edges"), 1);
  EXPECT_EQ(test::unmatched_sides(boundary(swing.model)), 0);  // ropes have no faces
}

}  // namespace
}  // namespace limber

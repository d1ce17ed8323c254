#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <utility>

#include "core/model/validate.h"
#include "tests/support/blocks.h"

namespace limber {
namespace {

using testing::HasSubstr;

// One triangle on the second of two cells.
PhysicalModel with_skin() {
  const test::BlockShape shape{.cells = {2, 1, 1}};
  PhysicalModel m = test::block(shape);
  SkinCell cell;
  cell.cell = CellId(1);
  for (int c = 0; c < 8; ++c)
    cell.corners[c] = test::block_point(shape, {1 + (c & 1), c >> 1 & 1, c >> 2 & 1});
  Skin skin;
  skin.cells = {cell};
  skin.vertices = {{0, {0, 0, 0}}, {0, {1, 0, 0}}, {0, {0, 1, 1.5}}};
  skin.triangles = {{{0, 1, 2}, 0}};
  m.skins = {skin};
  return m;
}

std::string first_defect(const std::function<void(Skin&)>& damage) {
  PhysicalModel m = with_skin();
  damage(m.skins[0]);
  const std::vector<Diagnostic> found = validate(m);
  return found.size() == 1 ? found[0].text() : std::to_string(found.size()) + " defects";
}

TEST(ValidateSkins, TakesASoundOne) { EXPECT_TRUE(validate(with_skin()).empty()); }

TEST(ValidateSkins, ChecksEveryIndex) {
  EXPECT_THAT(first_defect([](Skin& s) { s.cells[0].cell = CellId(2); }),
              HasSubstr("skin 0: cell 0: S1 cell 2 does not exist, there are 2"));
  EXPECT_THAT(first_defect([](Skin& s) { s.cells[0].corners[3] = PointId(); }),
              HasSubstr("skin 0: cell 0: S1 corner -1 does not exist"));
  EXPECT_THAT(first_defect([](Skin& s) { s.vertices[1].host = 1; }),
              HasSubstr("skin 0: vertex 1: S1 host 1 does not exist"));
  EXPECT_THAT(first_defect([](Skin& s) { s.triangles[0].corners[2] = 3; }),
              HasSubstr("skin 0: triangle 0: S1 corner 3 does not exist"));
  EXPECT_THAT(first_defect([](Skin& s) { s.triangles[0].owner = -7; }),
              HasSubstr("skin 0: triangle 0: S1 owner -7 does not exist"));
}

TEST(ValidateSkins, WantsTheCellsOwnCorners) {
  EXPECT_THAT(first_defect([](Skin& s) { s.cells[0].cell = CellId(0); }),
              HasSubstr("S2 its corners are not the eight points of cell 0"));
  EXPECT_THAT(first_defect([](Skin& s) { s.cells[0].corners[0] = s.cells[0].corners[1]; }),
              HasSubstr("S2"));
}

TEST(ValidateSkins, WantsTheCornersInOrder) {
  const auto wrong = HasSubstr("skin 0: cell 0: S2 its corners are not in the order of cell 1");
  const auto swap = [](int c, int d) {
    return [=](Skin& s) { std::swap(s.cells[0].corners[c], s.cells[0].corners[d]); };
  };
  EXPECT_THAT(first_defect(swap(0, 1)), wrong);
  EXPECT_THAT(first_defect(swap(2, 3)), wrong);
  EXPECT_THAT(first_defect(swap(0, 7)), wrong);
  // As other formats number a hexahedron: round the lower side, then round the upper one.
  EXPECT_THAT(first_defect([](Skin& s) {
                std::swap(s.cells[0].corners[2], s.cells[0].corners[3]);
                std::swap(s.cells[0].corners[6], s.cells[0].corners[7]);
              }),
              wrong);
  // A mirror image: the x axis turned round.
  EXPECT_THAT(first_defect([](Skin& s) {
                for (int c : {0, 2, 4, 6})
                  std::swap(s.cells[0].corners[c], s.cells[0].corners[c + 1]);
              }),
              wrong);
}

// x, y and z of one lattice are y, z and x of another.
TEST(ValidateSkins, TakesTheAxesAsTheyAre) {
  PhysicalModel m = with_skin();
  const auto corners = m.skins[0].cells[0].corners;
  for (int c = 0; c < 8; ++c) m.skins[0].cells[0].corners[c] = corners[(c << 1 & 6) | c >> 2];
  EXPECT_NE(m.skins[0].cells[0].corners, corners);
  EXPECT_TRUE(validate(m).empty());
}

TEST(ValidateSkins, BoundsPlaces) {
  EXPECT_THAT(first_defect([](Skin& s) { s.vertices[0].place.x() = 17.5; }),
              HasSubstr("skin 0: vertex 0: S3 place is (17.5, 0, 0)"));
  EXPECT_THAT(first_defect([](Skin& s) {
                s.vertices[2].place.z() = std::numeric_limits<double>::quiet_NaN();
              }),
              HasSubstr("S3"));
}

}  // namespace
}  // namespace limber

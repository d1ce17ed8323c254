#include "core/modeller/mesh_lattice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/model/validate.h"
#include "core/modeller/box_lattice.h"
#include "core/modeller/mesh_refinement.h"
#include "tests/support/meshes.h"

namespace limber {
namespace {

using testing::HasSubstr;

MeshLattice lattice(const TriangleMesh& mesh, double spacing) {
  MeshLatticeOptions options;
  options.spacing = spacing;
  return mesh_lattice(mesh, options);
}

std::string refusal(const TriangleMesh& mesh, const MeshLatticeOptions& options) {
  try {
    mesh_lattice(mesh, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "made";
}

std::string refusal(const TriangleMesh& mesh, double spacing) {
  MeshLatticeOptions options;
  options.spacing = spacing;
  return refusal(mesh, options);
}

std::string all_notes(const MeshLattice& made) {
  std::string text;
  for (const Diagnostic& d : made.notes) text += d.text() + "\n";
  return text;
}

// By another route than the report: the lattice's own cells.
double volume_of(const GeometricModel& g) {
  double volume = 0.0;
  for (CellId c : ids_of(g.cells)) volume += cell_volume(g, c);
  return volume;
}

// A body of whole cells is met exactly, and is what box_lattice makes.
TEST(MeshLattice, OfABoxOfWholeCellsIsTheBox) {
  const MeshLattice made = lattice(test::box_mesh({1, 2, 3}, {2, 4, 3.5}), 0.25);
  const GeometricModel wanted = box_lattice({4, 8, 2}, {0.25, 0.25, 0.25}, {1, 2, 3}, "box");
  ASSERT_EQ(made.geometry.points.size(), wanted.points.size());
  for (PointId p : ids_of(wanted.points))
    EXPECT_LT((made.geometry.points[p] - wanted.points[p]).norm(), 1e-12);
  EXPECT_EQ(made.geometry.edges.size(), wanted.edges.size());
  EXPECT_EQ(made.geometry.faces.size(), wanted.faces.size());
  EXPECT_NEAR(made.report.volume_error, 0.0, 1e-12);
  EXPECT_NEAR(made.report.centre_error, 0.0, 1e-12);
  EXPECT_NEAR(made.report.inertia_error, 0.0, 1e-12);
  EXPECT_TRUE(made.report.mesh_is_exact);
  EXPECT_TRUE(made.notes.empty()) << all_notes(made);
}

TEST(MeshLattice, IsAValidModel) {
  for (const TriangleMesh& mesh : {test::icosphere(1, 3), test::torus_mesh(2, 0.6, 40, 20)}) {
    const MeshLattice made = lattice(mesh, 0.2);
    PhysicalModel model = with_default_attributes(made.geometry, mesh.name);
    for (PointAttributes& point : model.points) point.mass = 1.0;
    model.skins.push_back(made.skin);
    EXPECT_TRUE(validate(made.geometry, mesh.name).empty());
    EXPECT_TRUE(validate(model).empty());
    EXPECT_NEAR(volume_of(made.geometry), made.report.cells.volume, 1e-12);
    EXPECT_EQ(made.geometry.subobjects.front().name, mesh.name);
  }
}

// Twenty cells across a sphere: 0.1 of the layer of one cell under its surface, and no worse.
TEST(MeshLattice, AgreesWithRoundBodiesWithinTheCells) {
  for (const TriangleMesh& mesh :
       {test::icosphere(1, 4, {0.3, 5, -2}), test::torus_mesh(1, 0.4, 80, 40)}) {
    const MeshLatticeReport r = lattice(mesh, 0.1).report;
    EXPECT_LT(std::abs(r.volume_error), 0.1 * r.layer_share) << mesh.name;
    EXPECT_LT(r.inertia_error, 0.1 * r.layer_share) << mesh.name;
    EXPECT_LT(r.centre_error, 0.1) << mesh.name;
    EXPECT_EQ(r.pieces, 1u);
  }
}

// Lumped at the corners, a cube's inertia is V s^2 / 2 instead of V s^2 / 6.
TEST(MeshLattice, ReportsTheInertiaOfPoints) {
  const MeshLatticeReport r = lattice(test::icosphere(1, 3), 0.2).report;
  const Mat3 excess = r.points.inertia - r.cells.inertia;
  EXPECT_LT((excess - r.cells.volume * 0.04 / 3.0 * Mat3::Identity()).norm(), 1e-12);
}

TEST(MeshLattice, SamplesComeNearTheExactMoments) {
  const TriangleMesh mesh = test::torus_mesh(1, 0.4, 80, 40);
  const SolidMoments exact = solid_moments(mesh), sampled = sampled_moments(mesh, 0.05);
  EXPECT_NEAR(sampled.volume / exact.volume, 1.0, 0.01);
  EXPECT_LT((sampled.inertia - exact.inertia).norm(), 0.01 * exact.inertia.norm());
}

// Each of these is the sphere to anybody who looks at it.
TEST(MeshLattice, MakesTheSameOfDamagedMeshes) {
  const TriangleMesh ball = test::icosphere(1, 3);
  const std::size_t cells = lattice(ball, 0.2).geometry.cells.size();
  TriangleMesh doubled = ball, pricked = ball;
  doubled.triangles.push_back(ball.triangles[7]);
  pricked.triangles.erase(pricked.triangles.begin() + 100, pricked.triangles.begin() + 103);
  const std::vector<std::pair<TriangleMesh, std::string>> cases = {
      {test::soup(ball), ""},
      {test::inside_out(ball), "was inside out"},
      {test::with_flipped(ball, 4), "320 triangles ran against their neighbours"},
      {doubled, "1 triangle too many: there already"},
      {pricked, "has holes"}};
  for (const auto& [mesh, note] : cases) {
    const MeshLattice made = lattice(mesh, 0.2);
    EXPECT_NEAR(double(made.geometry.cells.size()), double(cells), 0.01 * cells) << note;
    if (note.empty())
      EXPECT_TRUE(made.notes.empty()) << all_notes(made);
    else
      EXPECT_THAT(all_notes(made), HasSubstr(note));
  }
}

// Overlapping parts count once; the sum over the triangles would count them twice.
TEST(MeshLattice, CountsOverlapsOnce) {
  const MeshLattice made = lattice(
      test::together(test::box_mesh({0, 0, 0}, {2, 1, 1}), test::box_mesh({1, 0, 0}, {3, 1, 1})),
      0.125);
  EXPECT_NEAR(made.report.cells.volume, 3.0, 1e-10);
  EXPECT_NEAR(made.report.mesh.volume, 3.0, 1e-10);
  EXPECT_FALSE(made.report.mesh_is_exact);
  EXPECT_THAT(all_notes(made), HasSubstr("overlap"));
}

// The winding number closes a missing side by a bulge, a rim gap hardly with any.
TEST(MeshLattice, ClosesHoles) {
  TriangleMesh box = test::box_mesh({0, 0, 0}, {1, 1, 1});
  box.triangles.erase(box.triangles.begin(), box.triangles.begin() + 2);
  const MeshLattice open = lattice(box, 0.1);
  EXPECT_THAT(all_notes(open), HasSubstr("has holes: 4 sides of its triangles have no neighbour"));
  EXPECT_NEAR(open.report.cells.volume, 1.0, 0.2);

  const MeshLattice dome = lattice(test::hemisphere(1, 24, 0.95), 0.1);
  EXPECT_NEAR(dome.report.cells.volume, 2.0 / 3.0 * M_PI, 0.05 * 2.0 / 3.0 * M_PI);
}

// The mean over a cube of the solid angle of one of its six sides is a sixth of all, by symmetry.
TEST(MeshLattice, SaysHowOpenAMeshIs) {
  TriangleMesh box = test::box_mesh({0, 0, 0}, {1, 1, 1});
  box.triangles.erase(box.triangles.begin(), box.triangles.begin() + 2);
  EXPECT_THAT(all_notes(lattice(box, 0.05)), HasSubstr("seen from inside, 16."));
}

// Two halves that meet but for a rounding error are closed to anybody who looks.
TEST(MeshLattice, DoesNotMindSeams) {
  const TriangleMesh lower =
      test::moved(test::hemisphere(1, 24, 0.0), Vec3(1, -1, -1).asDiagonal(), {1e-7, 0, 1e-7});
  const MeshLattice made = lattice(test::together(test::hemisphere(1, 24, 0.0), lower), 0.1);
  EXPECT_NEAR(made.report.cells.volume, 4.0 / 3.0 * M_PI, 0.02 * 4.0 / 3.0 * M_PI);
  EXPECT_LT(made.report.openness, 0.02);
}

TEST(MeshLattice, KeepsCavities) {
  const MeshLattice shell = lattice(
      test::together(test::icosphere(1, 3), test::inside_out(test::icosphere(0.6, 3))), 0.1);
  EXPECT_NEAR(shell.report.cells.volume, 4.0 / 3.0 * M_PI * (1 - 0.216), 0.1);
  EXPECT_TRUE(shell.notes.empty()) << all_notes(shell);
}

TEST(MeshLattice, KeepsPartsThatLieApart) {
  const MeshLattice two =
      lattice(test::together(test::icosphere(1, 3), test::icosphere(1, 3, {3, 0, 0})), 0.2);
  EXPECT_EQ(two.report.pieces, 2u);
  EXPECT_EQ(two.report.separate_pieces, 2u);
  EXPECT_THAT(all_notes(two), HasSubstr("2 parts without a common point"));
}

TEST(MeshLattice, DropsSpecks) {
  const MeshLattice made = lattice(
      test::together(test::icosphere(1, 3), test::box_mesh({1.4, 0, 0}, {1.5, 0.1, 0.1})), 0.1);
  EXPECT_EQ(made.report.pieces, 1u);
  EXPECT_GE(made.report.dropped_cells, 1u);
  EXPECT_THAT(all_notes(made), HasSubstr("1 of 4225 cells is a speck"));
}

TEST(MeshLattice, RefusesWhatBoundsNoVolume) {
  EXPECT_THAT(refusal(TriangleMesh{"none", {}, {}}, 0.1), HasSubstr("none: has no triangles"));
  const TriangleMesh bowl = test::hemisphere(1, 12, 0.0);
  EXPECT_THAT(
      refusal(bowl, 0.1),
      HasSubstr("is open: 48 sides of its triangles have no neighbour, and seen from inside, "));
  TriangleMesh flat{"flat", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};
  EXPECT_THAT(refusal(flat, 0.1), HasSubstr("is a sheet: encloses nothing, a volume of 0 m^3"));
  flat.triangles.pop_back();
  EXPECT_THAT(refusal(flat, 0.1), HasSubstr("is a sheet: encloses nothing, a volume of 0 m^3"));
}

// A square of 20 x 20, in waves of `height`.
TriangleMesh cloth(double height) {
  TriangleMesh mesh{"cloth", {}, {}};
  for (int i = 0; i < 21 * 21; ++i) {
    const double x = 0.05 * (i % 21), z = 0.05 * (i / 21);
    mesh.positions.push_back({x, height * std::sin(9 * x) * std::cos(7 * z), z});
    if (i % 21 == 20 || i / 21 == 20) continue;
    mesh.triangles.push_back({i, i + 21, i + 1});
    mesh.triangles.push_back({i + 1, i + 21, i + 22});
  }
  return mesh;
}

// At spacings that a box of this size would take and at one that it would not.
TEST(MeshLattice, RefusesSheetsBeforeItNamesASpacing) {
  TriangleMesh tilted = cloth(0.0);
  for (Vec3& p : tilted.positions) p.y() = 0.3 * p.x() + 0.7 * p.z() + 2.0;
  TriangleMesh two_sided = cloth(0.03);
  two_sided = test::together(two_sided, test::inside_out(two_sided));
  for (double spacing : {0.3, 0.04, 1e-4})
    for (const TriangleMesh& mesh : {cloth(0.0), tilted, two_sided})
      EXPECT_THAT(refusal(mesh, spacing), HasSubstr("is a sheet: encloses nothing"));
  for (double spacing : {0.3, 0.04, 1e-4})
    EXPECT_THAT(refusal(cloth(0.03), spacing), HasSubstr("is a sheet: encloses nothing"));
}

// One triangle less is still a plate 0.29 m thick, of which one layer of cells holds 0.2 m. Samples
// are a third of a cell apart: the two sides are off by that much at most.
TEST(MeshLattice, JudgesAMeshWithAHoleLikeItsClosedTwin) {
  const TriangleMesh plate = refined(test::box_mesh({0, 0, 0}, {2, 0.29, 2}), 0.2, 100'000).mesh;
  TriangleMesh pricked = plate;
  pricked.triangles.pop_back();
  EXPECT_THAT(refusal(plate, 0.2), HasSubstr("is too thin for cells of 0.2 m"));
  EXPECT_THAT(refusal(pricked, 0.2), HasSubstr("is too thin for cells of 0.2 m"));
  EXPECT_NEAR(sampled_moments(pricked, 0.2).volume, 1.16, 4 * 0.2 / 3.0);
}

// As a reader fills up a PLY that breaks off: with the last triangle, or with the first vertex.
TEST(MeshLattice, RefusesManyCopies) {
  const TriangleMesh ball = test::icosphere(1, 3);
  for (const MeshTriangle& filler : {ball.triangles[1100], MeshTriangle{0, 0, 0}}) {
    TriangleMesh broken = ball;
    std::fill(broken.triangles.begin() + 1100, broken.triangles.end(), filler);
    EXPECT_THAT(refusal(broken, 0.2), HasSubstr("179 of 1280 triangles are copies of one"));
  }
}

// As exports of real meshes have them: each of a few triangles twice.
TEST(MeshLattice, TakesDoubledTriangles) {
  TriangleMesh ball = test::icosphere(1, 3);
  for (std::size_t t = 0; t < 200; ++t) ball.triangles.push_back(ball.triangles[t]);
  EXPECT_THAT(all_notes(lattice(ball, 0.2)), HasSubstr("200 triangles too many"));
}

// 1 m^3 and what of the handle of 0.6 x 0.5 x 0.5 m sticks out: 0.4 m of its length. The first of
// its vertices is outside on one side, inside on the other.
TEST(MeshLattice, TurnsAnInvertedHandle) {
  const TriangleMesh pot = test::box_mesh({0, 0, 0}, {1, 1, 1});
  for (double x : {0.8, -0.4}) {
    const TriangleMesh handle = test::box_mesh({x, 0.25, 0.25}, {x + 0.6, 0.75, 0.75});
    const MeshLattice made = lattice(test::together(pot, test::inside_out(handle)), 0.05);
    EXPECT_NEAR(made.report.cells.volume, 1.1, 1e-9);
    EXPECT_NEAR(made.report.mesh.volume, 1.1, 1e-9);
    EXPECT_THAT(all_notes(made), HasSubstr("1 of its parts was inside out"));
  }
}

// Shells keep their vertices: joined, the common side would belong to neither.
TEST(MeshLattice, OrientsShellsThatTouch) {
  const TriangleMesh box = test::box_mesh({0, 0, 0}, {1, 1, 1});
  for (const TriangleMesh& other : {test::inside_out(test::box_mesh({1, 0, 0}, {2, 1, 1})),
                                    test::moved(box, Vec3(-1, 1, 1).asDiagonal(), {2, 0, 0})}) {
    const MeshLattice two = lattice(test::together(box, other), 0.1);
    EXPECT_NEAR(two.report.mesh.volume, 2.0, 1e-9);
    EXPECT_NEAR(two.report.cells.volume, 2.0, 1e-9);
    EXPECT_THAT(all_notes(two), HasSubstr("1 of its parts was inside out"));
  }
}

// Twice the same box is that box, whichever way they face.
TEST(MeshLattice, CountsEqualShellsOnce) {
  const TriangleMesh box = test::box_mesh({0, 0, 0}, {1, 1, 1});
  for (const TriangleMesh& other : {box, test::inside_out(box)})
    EXPECT_NEAR(lattice(test::together(box, other), 0.1).report.mesh.volume, 1.0, 1e-9);
}

TEST(MeshLattice, RefusesNumbersThatAreNone) {
  TriangleMesh ball = test::icosphere(1, 1);
  EXPECT_THAT(refusal(ball, 0.0), HasSubstr("spacing of its lattice is 0"));
  EXPECT_THAT(refusal(ball, std::numeric_limits<double>::infinity()),
              HasSubstr("positive spacing"));
  ball.triangles[3][1] = 42;
  EXPECT_THAT(refusal(ball, 0.1), HasSubstr("1 of 80 triangles have corners that do not exist"));
  ball = test::icosphere(1, 1);
  ball.positions[5].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(ball, 0.1), HasSubstr("1 of 42 positions are not finite"));
}

// A plate of a third of a cell; with the spacing that the refusal names, half its mean thickness
// V / A = 0.06 / 2.24, it is made.
TEST(MeshLattice, RefusesWhatIsTooThinAndNamesASpacing) {
  const TriangleMesh plate = test::box_mesh({0, 0, 0}, {1, 0.06, 1});
  EXPECT_THAT(refusal(plate, 0.2), HasSubstr("thinner than a cell of 0.2 m: none is half full"));
  EXPECT_THAT(refusal(plate, 0.2),
              HasSubstr("give a spacing of 0.026 m or less, which makes about 3400 cells"));
  EXPECT_LT(std::abs(lattice(plate, 0.026).report.volume_error), 0.2);
  EXPECT_THAT(refusal(test::box_mesh({0, 0, 0}, {2, 0.15, 2}), 0.2), HasSubstr("off by 33.3 %"));
}

// A long needle on a ball: light, so that the moments agree, but far from any cell.
TEST(MeshLattice, RefusesWhatSticksOutTooFar) {
  const TriangleMesh needle =
      test::together(test::icosphere(1, 3), test::box_mesh({0, 0, 0}, {4, 0.01, 0.01}));
  EXPECT_THAT(refusal(needle, 0.1), HasSubstr("more than 16 cells of 0.1 m away"));
  const MeshLattice coarse = lattice(needle, 0.25);
  EXPECT_THAT(all_notes(coarse), HasSubstr("sticks out"));
}

TEST(MeshLattice, RefusesTooManyCellsAndNamesASpacing) {
  const TriangleMesh ball = test::icosphere(1, 2);
  EXPECT_THAT(refusal(ball, 1e-4), HasSubstr("its box takes 8e+12 cells of 0.0001 m"));
  MeshLatticeOptions options;
  options.spacing = 0.1;
  options.most_cells = 1000;
  EXPECT_THAT(refusal(ball, options), HasSubstr("more than 1000; give a spacing of 0.1"));
  options.spacing = 0.17;
  EXPECT_EQ(refusal(ball, options), "made");
}

// Where the diagonals of a box's sides are too long, its 12 triangles become 24.
TEST(MeshLattice, SaysWhenItsSkinStaysCoarse) {
  MeshLatticeOptions options;
  options.spacing = 0.8;
  options.most_skin_triangles = 23;
  const TriangleMesh box = test::box_mesh({0, 0, 0}, {0.8, 0.8, 0.8});
  const MeshLattice coarse = mesh_lattice(box, options);
  EXPECT_EQ(coarse.skin.triangles.size(), 12u);
  EXPECT_THAT(all_notes(coarse),
              HasSubstr("its skin would take more than 23 triangles to have no edge longer than a "
                        "cell of 0.8 m; the longest is 1.13 m"));
  options.most_skin_triangles = 24;
  EXPECT_EQ(all_notes(mesh_lattice(box, options)), "");
}

TEST(SampledMoments, RefuseAGridThatIsTooLarge) {
  const TriangleMesh ball = test::icosphere(1, 2);
  const auto refusal_of = [&](const TriangleMesh& mesh, double spacing) -> std::string {
    try {
      sampled_moments(mesh, spacing);
    } catch (const InputError& error) {
      return error.what();
    }
    return "made";
  };
  EXPECT_THAT(refusal_of(ball, 1e-4),
              HasSubstr("its box takes 8e+12 cells of 0.0001 m, more than"));
  EXPECT_THAT(refusal_of(ball, -1.0), HasSubstr("give a positive spacing"));
  EXPECT_THAT(refusal_of(TriangleMesh{"none", {}, {}}, 0.1), HasSubstr("has no triangles"));
}

// A cell is either kept or its neighbours carry what was in it.
TEST(MeshLattice, HangsTheSkinOnTheNearestCells) {
  const MeshLattice made = lattice(test::icosphere(1, 3), 0.2);
  for (const SkinVertex& v : made.skin.vertices) {
    EXPECT_GE(v.place.minCoeff(), -1.0);
    EXPECT_LE(v.place.maxCoeff(), 2.0);
  }
  EXPECT_LT(made.report.skin_reach, 0.2);
}

}  // namespace
}  // namespace limber

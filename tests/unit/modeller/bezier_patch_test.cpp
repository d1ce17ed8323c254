#include "core/modeller/bezier_patch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "core/model/errors.h"

namespace limber {
namespace {

using ::testing::HasSubstr;

std::vector<PatchPart> teapot() {
  std::ifstream file(LIMBER_TEST_DATA "/../../assets/teapot/teapot_patches.txt");
  std::stringstream text;
  text << file.rdbuf();
  return parse_bezier_patches(text.str(), "teapot_patches.txt");
}

const std::vector<BezierPatch>& patches_of(const std::vector<PatchPart>& parts,
                                           const std::string& name) {
  for (const PatchPart& part : parts)
    if (part.name == name) return part.patches;
  throw std::runtime_error("no part " + name);
}

BezierPatch uneven_patch() {
  BezierPatch patch;
  for (int i = 0; i < 16; ++i)
    patch.control[i] = Vec3(i % 4, 0.3 * (i * 7 % 5), i / 4) + 0.1 * Vec3(i % 3, 0, i % 5);
  return patch;
}

template <class Check>
void on_grid(Check check) {
  for (double u : {0.0, 0.1, 0.35, 0.5, 0.8, 1.0})
    for (double v : {0.0, 0.2, 0.5, 0.65, 0.9, 1.0}) check(u, v);
}

TEST(Bernstein, PolynomialsSumToOne) {
  for (double t = 0.0; t <= 1.0; t += 0.05) {
    const auto b = bernstein(t);
    const auto d = bernstein_derivative(t);
    EXPECT_NEAR(b[0] + b[1] + b[2] + b[3], 1.0, 1e-15);
    EXPECT_NEAR(d[0] + d[1] + d[2] + d[3], 0.0, 1e-14);
  }
}

TEST(BezierPatch, PassesThroughItsCorners) {
  const BezierPatch patch = uneven_patch();
  EXPECT_TRUE(patch.position(0.0, 0.0).isApprox(patch.control[0]));
  EXPECT_TRUE(patch.position(1.0, 0.0).isApprox(patch.control[3]));
  EXPECT_TRUE(patch.position(0.0, 1.0).isApprox(patch.control[12]));
  EXPECT_TRUE(patch.position(1.0, 1.0).isApprox(patch.control[15]));
}

TEST(BezierPatch, DerivativesAreThoseOfFiniteDifferences) {
  const BezierPatch patch = uneven_patch();
  constexpr double h = 1e-5;
  on_grid([&](double u, double v) {
    const Vec3 du = (patch.position(u + h, v) - patch.position(u - h, v)) / (2 * h);
    const Vec3 dv = (patch.position(u, v + h) - patch.position(u, v - h)) / (2 * h);
    EXPECT_LT((patch.derivative_u(u, v) - du).norm(), 1e-8);
    EXPECT_LT((patch.derivative_v(u, v) - dv).norm(), 1e-8);
  });
}

TEST(BezierPatch, NormalIsAUnitVectorAcrossBothDerivatives) {
  const BezierPatch patch = uneven_patch();
  on_grid([&](double u, double v) {
    const Vec3 n = patch.normal(u, v);
    EXPECT_NEAR(n.norm(), 1.0, 1e-14);
    EXPECT_NEAR(n.dot(patch.derivative_u(u, v)), 0.0, 1e-12);
    EXPECT_NEAR(n.dot(patch.derivative_v(u, v)), 0.0, 1e-12);
  });
}

TEST(TeapotPatches, AreTheClassic32) {
  const std::vector<PatchPart> parts = teapot();
  std::vector<std::pair<std::string, std::size_t>> counts;
  for (const PatchPart& part : parts) counts.emplace_back(part.name, part.patches.size());
  EXPECT_THAT(counts, ::testing::ElementsAre(std::pair("rim", 4u), std::pair("body", 8u),
                                             std::pair("handle", 4u), std::pair("spout", 4u),
                                             std::pair("lid", 8u), std::pair("bottom", 4u)));
}

// The well-known extents, in Newell's units: 3.15 high, 4 wide, from the handle at -3 to the tip.
TEST(TeapotPatches, HaveTheWellKnownBoundingBox) {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
  for (const PatchPart& part : teapot()) {
    for (const BezierPatch& patch : part.patches) {
      for (int i = 0; i <= 40; ++i) {
        for (int j = 0; j <= 40; ++j) {
          const Vec3 p = patch.position(i / 40.0, j / 40.0);
          low = low.cwiseMin(p);
          high = high.cwiseMax(p);
        }
      }
    }
  }
  EXPECT_LT((low - Vec3(-3.0, 0.0, -2.0)).norm(), 1e-3);
  EXPECT_LT((high - Vec3(3.434, 3.15, 2.0)).norm(), 1e-3);
}

TEST(TeapotPatches, PolesAreSinglePointsWithANormalAlongTheAxis) {
  const std::vector<PatchPart> parts = teapot();
  for (double u : {0.0, 0.3, 1.0}) {
    const BezierPatch& lid = patches_of(parts, "lid")[0];
    EXPECT_LT((lid.position(u, 0.0) - Vec3(0.0, 3.15, 0.0)).norm(), 1e-15);
    EXPECT_LT((lid.normal(u, 0.0) - Vec3::UnitY()).norm(), 1e-4);
    const BezierPatch& bottom = patches_of(parts, "bottom")[0];
    EXPECT_LT(bottom.position(u, 0.0).norm(), 1e-15);
    EXPECT_LT((bottom.normal(u, 0.0) + Vec3::UnitY()).norm(), 1e-4);
  }
}

// Each row of patches closes: the last column of one is the first of the next.
TEST(TeapotPatches, CloseAroundEveryPart) {
  for (const PatchPart& part : teapot()) {
    const std::size_t columns = part.name == "handle" || part.name == "spout" ? 2 : 4;
    for (std::size_t i = 0; i < part.patches.size(); ++i) {
      const std::size_t next = i - i % columns + (i + 1) % columns;
      for (int row = 0; row < 4; ++row)
        EXPECT_EQ(part.patches[i].control[4 * row + 3], part.patches[next].control[4 * row]);
    }
  }
}

// Rotation by a quarter turn about y maps the parts of revolution onto themselves.
TEST(TeapotPatches, OfRevolutionAreTheSameAfterAQuarterTurn) {
  const auto turned = [](const Vec3& p) { return Vec3(-p.z(), p.y(), p.x()); };
  for (const PatchPart& part : teapot()) {
    if (part.name == "handle" || part.name == "spout") continue;
    const double sense = part.name == "bottom" ? -1.0 : 1.0;
    for (std::size_t i = 0; i < part.patches.size(); ++i) {
      const BezierPatch& here = part.patches[i];
      const BezierPatch& next = part.patches[i - i % 4 + (i + 1) % 4];
      for (int c = 0; c < 16; ++c) {
        const Vec3 expected = sense > 0 ? turned(here.control[c]) : here.control[c];
        const Vec3 found = sense > 0 ? next.control[c] : turned(next.control[c]);
        EXPECT_LT((found - expected).norm(), 1e-12) << part.name;
      }
    }
  }
}

TEST(TeapotPatches, FaceOutward) {
  for (const PatchPart& part : teapot()) {
    if (part.name != "body") continue;
    for (const BezierPatch& patch : part.patches) {
      const Vec3 p = patch.position(0.5, 0.5);
      EXPECT_GT(patch.normal(0.5, 0.5).dot(Vec3(p.x(), 0.0, p.z())), 0.0);
    }
  }
}

void expect_refused(const std::string& text, const std::string& where, const std::string& what) {
  try {
    parse_bezier_patches(text, "file");
    ADD_FAILURE() << text;
  } catch (const InputError& error) {
    EXPECT_EQ(error.diagnostic.where, where);
    EXPECT_THAT(error.diagnostic.what, HasSubstr(what));
  }
}

TEST(PatchFile, RefusalsNameTheLine) {
  expect_refused("points 1\n0 0\n", "file: line 2", "number");
  expect_refused("points 2\n0 0 0\n", "file: line 2", "ends");
  expect_refused("points 1\n0 0 0 0\n", "file: line 2", "too much");
  expect_refused("# hello\nballs 1\n", "file: line 2", "balls");
  expect_refused("points 1\n0 0 0\npart p 1\n0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 1\n", "file: line 4",
                 "no point 1");
  expect_refused("points -1\n", "file: line 1", "-1");
}

}  // namespace
}  // namespace limber

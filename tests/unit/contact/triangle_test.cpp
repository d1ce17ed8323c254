#include "core/contact/triangle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/lattices.h"

namespace limber {
namespace {

Triangle random_triangle(std::mt19937& random) {
  return {test::random_vector(random, 1.0), test::random_vector(random, 1.0),
          test::random_vector(random, 1.0)};
}

// Against all places of a fine grid over the triangle: none is nearer, one is as near as the grid
// is fine.
TEST(Triangle, NearestPointIsNearerThanAnyOther) {
  std::mt19937 random(1);
  constexpr int kParts = 60;
  for (int trial = 0; trial < 100; ++trial) {
    const Triangle t = random_triangle(random);
    const Vec3 x = test::random_vector(random, 2.0);
    const NearestPoint nearest = nearest_on_triangle(x, t);
    EXPECT_NEAR((x - point_at(t, nearest.weights)).squaredNorm(), nearest.squared_distance, 1e-14);
    EXPECT_NEAR(nearest.weights.sum(), 1.0, 1e-14);
    double least = 1e300;
    for (int i = 0; i <= kParts; ++i) {
      for (int j = 0; i + j <= kParts; ++j) {
        const Vec3 w = Vec3(i, j, kParts - i - j) / kParts;
        least = std::min(least, (x - point_at(t, w)).norm());
      }
    }
    const double distance = std::sqrt(nearest.squared_distance);
    EXPECT_LE(distance, least + 1e-12);
    EXPECT_GE(distance, least - 4.0 / kParts);
  }
}

TEST(Triangle, NearestPointOfALineIsOnIt) {
  const Triangle line = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(3, 0, 0)};
  EXPECT_NEAR(nearest_on_triangle({2.0, 1.0, 0.0}, line).squared_distance, 1.0, 1e-15);
  EXPECT_NEAR(nearest_on_triangle({4.0, 0.0, 0.0}, line).squared_distance, 1.0, 1e-15);
}

// A metre long and w wide, turned; points above it: their distance is their height.
TEST(Triangle, NearestPointOfASliverIsAsExactAsOfOthers) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (double w : {1e-2, 1e-4, 1e-6, 1e-8, 1e-12}) {
    for (int trial = 0; trial < 1000; ++trial) {
      const Vec3 axis = test::random_vector(random, 1.0).normalized();
      const Mat3 turn = Eigen::AngleAxisd(random() % 7, axis).toRotationMatrix();
      const Triangle t = {Vec3::Zero(), turn * Vec3(1, 0, 0), turn * Vec3(0.6, w, 0)};
      const double u = share(random), v = (1.0 - u) * share(random), height = share(random);
      const Vec3 above = point_at(t, {1.0 - u - v, u, v}) + height * turn.col(2);
      const double distance = std::sqrt(nearest_on_triangle(above, t).squared_distance);
      ASSERT_NEAR(distance, height, 1e-12) << "width " << w;
    }
  }
}

TEST(Triangle, NearestPointKnowsItsSides) {
  const Triangle t = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  const auto sides = [&](const Vec3& x) {
    const NearestPoint nearest = nearest_on_triangle(x, t);
    return std::array{nearest.on_side(0), nearest.on_side(1), nearest.on_side(2)};
  };
  EXPECT_EQ(sides({0.2, 0.2, 1}), (std::array{false, false, false}));
  EXPECT_EQ(sides({0.5, -1, 1}), (std::array{true, false, false}));
  EXPECT_EQ(sides({1, 1, 0}), (std::array{false, true, false}));
  EXPECT_EQ(sides({-1, 0.5, 0}), (std::array{false, false, true}));
  EXPECT_EQ(sides({-1, -1, 0}), (std::array{true, false, true}));
  EXPECT_EQ(sides({3, 0, 0}), (std::array{true, true, false}));
  EXPECT_EQ(sides({0, 3, 0}), (std::array{false, true, true}));
}

// Through a place of known barycentric weights, from any direction.
TEST(Triangle, LinesPassWhereTheirWeightsArePositive) {
  std::mt19937 random(6);
  for (int trial = 0; trial < 1000; ++trial) {
    const Triangle t = random_triangle(random);
    Vec3 weights = test::random_vector(random, 1.0);
    weights[2] = 1.0 - weights[0] - weights[1];
    const Vec3 way = test::random_vector(random, 1.0), through = point_at(t, weights);
    if (std::abs(way.dot(twice_area_vector(t))) < 1e-3 || std::abs(weights.minCoeff()) < 1e-6) {
      continue;
    }
    EXPECT_EQ(line_passes(t, through - way, through + 0.5 * way), weights.minCoeff() > 0.0);
    const Vec3 on_side = t[0] + 0.3 * (t[1] - t[0]);
    EXPECT_TRUE(line_passes(t, on_side - way, on_side + way));
  }
}

// Central differences of the weights of a moving place in the plane.
TEST(Triangle, WeightGradientsAreThoseOfFiniteDifferences) {
  std::mt19937 random(2);
  constexpr double kStep = 1e-6;
  for (int trial = 0; trial < 50; ++trial) {
    const Triangle t = random_triangle(random);
    if (twice_area_vector(t).norm() < 0.2) continue;
    const auto gradients = weight_gradients(t);
    const Vec3 in_plane = (t[1] - t[0]) + 0.3 * (t[2] - t[0]);
    const Vec3 centre = (t[0] + t[1] + t[2]) / 3.0;
    const Vec3 change = nearest_on_triangle(centre + kStep * in_plane, t).weights -
                        nearest_on_triangle(centre - kStep * in_plane, t).weights;
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(gradients[i].dot(in_plane), change[i] / (2.0 * kStep), 1e-7);
      EXPECT_NEAR(gradients[i].dot(twice_area_vector(t)), 0.0, 1e-12);
    }
  }
}

Triangle between(const Triangle& from, const Triangle& to, double t) {
  Triangle then;
  for (int i = 0; i < 3; ++i) then[i] = from[i] + t * (to[i] - from[i]);
  return then;
}

// In many looks on the way.
int passages_seen(const Vec3& from, const Vec3& to, const Triangle& t0, const Triangle& t1) {
  constexpr int kLooks = 20000;
  int count = 0;
  bool before = is_before(from, t0);
  for (int i = 1; i <= kLooks; ++i) {
    const double t = double(i) / kLooks;
    const Triangle then = between(t0, t1, t);
    const Vec3 x = from + t * (to - from);
    const bool now = is_before(x, then);
    if (now != before && nearest_on_triangle(x, then).squared_distance < 1e-6) ++count;
    before = now;
  }
  return count;
}

TEST(Triangle, CrossingsAreThoseThatAreSeenOnTheWay) {
  std::mt19937 random(3);
  int passages = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Triangle t0 = random_triangle(random), t1 = random_triangle(random);
    const Vec3 from = test::random_vector(random, 0.5), to = test::random_vector(random, 0.5);
    const Crossings found = crossings(from, to, t0, t1);
    EXPECT_EQ(found.count, passages_seen(from, to, t0, t1)) << "trial " << trial;
    passages += found.count;
    for (int i = 0; i < found.count; ++i) {
      const double t = found.at[i].time;
      const double volume = signed_volume(from + t * (to - from), between(t0, t1, t));
      EXPECT_NEAR(volume, 0.0, 1e-14);
    }
  }
  EXPECT_GT(passages, 20);
}

// Two triangles with a common side that move at random, and points that pass through that side to
// rounding: each is caught by one of the two.
TEST(Triangle, NothingSlipsThroughASeam) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 drift = test::random_vector(random, 0.1);
    const auto moved = [&](const Vec3& x) -> Vec3 {
      return x + drift + test::random_vector(random, 0.2);
    };
    const Vec3 a(0, 0, 0), b(1, 0, 0), c(0.5, 1, 0), d(0.5, -1, 0);
    const Vec3 a1 = moved(a), b1 = moved(b), c1 = moved(c), d1 = moved(d);
    const double along = 0.1 + 0.8 * (random() / 4294967296.0);
    const double time = 0.1 + 0.8 * (random() / 4294967296.0);
    const Vec3 seam = (1.0 - along) * (a + time * (a1 - a)) + along * (b + time * (b1 - b));
    const Vec3 way = Vec3(0, 0, -1) + test::random_vector(random, 0.05);
    const Vec3 from = seam - time * way, to = seam + (1.0 - time) * way;
    const int caught = crossings(from, to, {a, b, c}, {a1, b1, c1}).count +
                       crossings(from, to, {b, a, d}, {b1, a1, d1}).count;
    EXPECT_GE(caught, 1) << "trial " << trial;
  }
}

}  // namespace
}  // namespace limber

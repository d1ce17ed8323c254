#include "core/modeller/particle_cloud.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/model/errors.h"
#include "core/model/validate.h"

namespace limber {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const Vec3 kLow(1.0, 2.0, 3.0), kHigh(2.0, 2.5, 4.5);

double least_distance(const std::vector<Vec3>& places) {
  double least = INFINITY;
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) least = std::min(least, (places[i] - places[j]).norm());
  }
  return least;
}

TEST(ParticleCloud, HasThePointsAndNothingElse) {
  const std::vector<Vec3> places = {{0, 0, 0}, {1, 2, 3}};
  const GeometricModel g = particle_cloud(places, "dust");
  EXPECT_EQ(g.points.raw(), places);
  EXPECT_EQ(g.edges.size() + g.faces.size() + g.cells.size(), 0u);
  EXPECT_TRUE(validate(g, "dust").empty());
}

TEST(ParticleCloud, GridFillsTheBoxWithGrainsOfItsSpacing) {
  const std::vector<Vec3> places = grid_in_box(kLow, kHigh, 0.1);
  EXPECT_EQ(places.size(), 10u * 5u * 15u);
  EXPECT_NEAR(least_distance(places), 0.1, 1e-14);
  for (const Vec3& p : places) {
    EXPECT_GE((p - kLow).minCoeff(), 0.05 - 1e-14);
    EXPECT_GE((kHigh - p).minCoeff(), 0.05 - 1e-14);
  }
}

// 7, 33 and 123 points of a cubic grid lie within 1, 2 and 3 steps of one of them: Gauss's circle
// problem in space (OEIS A000605).
TEST(ParticleCloud, GridInASphereHasTheKnownCounts) {
  EXPECT_EQ(grid_in_sphere(kLow, 0.1, 0.1).size(), 7u);
  EXPECT_EQ(grid_in_sphere(kLow, 0.2, 0.1).size(), 33u);
  EXPECT_EQ(grid_in_sphere(kLow, 0.3, 0.1).size(), 123u);
  EXPECT_EQ(grid_in_sphere(Vec3::Constant(1e4), 0.3, 0.1).size(), 123u);
}

TEST(ParticleCloud, ScatteredPlacesKeepTheirDistanceAndLeaveNoRoom) {
  const double distance = 0.12;
  const std::vector<Vec3> places = scattered_in_box(kLow, kHigh, distance, 7);
  EXPECT_GE(least_distance(places), distance);
  double widest_gap = 0.0;
  for (const Vec3& p : grid_in_box(kLow, kHigh, 0.03)) {
    double nearest = INFINITY;
    for (const Vec3& q : places) nearest = std::min(nearest, (p - q).norm());
    widest_gap = std::max(widest_gap, nearest);
    EXPECT_TRUE(((places[0] - kLow).array() >= 0.0).all());
  }
  EXPECT_LT(widest_gap, 1.5 * distance);
}

// Along a bar as thick as the distance no gap has room for another place: neighbours along it are
// less than two distances apart.
TEST(ParticleCloud, ScatteredPlacesFillThinBoxes) {
  const double d = 0.01;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    std::vector<Vec3> places = scattered_in_box(Vec3::Zero(), {1.0, d, d}, d, seed);
    EXPECT_GE(least_distance(places), d);
    std::sort(places.begin(), places.end(),
              [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); });
    double widest = std::max(places.front().x(), 1.0 - places.back().x());
    for (std::size_t i = 1; i < places.size(); ++i)
      widest = std::max(widest, places[i].x() - places[i - 1].x());
    EXPECT_LT(widest, 2.0 * d) << "seed " << seed << ", " << places.size() << " places";
  }
}

// As many places as along a line, though the box is a millionth of the distance thick.
TEST(ParticleCloud, EstimatesTheCountOfThinBoxes) {
  const Vec3 high(1e4, 1e-7, 1e-7);
  EXPECT_THAT([&] { scattered_in_box(Vec3::Zero(), high, 1e-4, 1); },
              ThrowsMessage<InputError>(HasSubstr("100000000 points")));
}

TEST(ParticleCloud, ScatteredPlacesAreThoseOfTheSeed) {
  const std::vector<Vec3> places = scattered_in_sphere(kLow, 0.5, 0.1, 1);
  EXPECT_EQ(places, scattered_in_sphere(kLow, 0.5, 0.1, 1));
  EXPECT_NE(places, scattered_in_sphere(kLow, 0.5, 0.1, 2));
  for (const Vec3& p : places) EXPECT_LE((p - kLow).norm(), 0.5);
  // Balls of half the distance fill 0.2 to 0.4 of space, the usual density of such samples.
  const double filled = double(places.size()) * std::pow(0.05, 3) / std::pow(0.55, 3);
  EXPECT_GT(filled, 0.2);
  EXPECT_LT(filled, 0.4);
}

TEST(ParticleCloud, RefusesWhatIsNoCloud) {
  const auto box = [](double spacing) { return [=] { grid_in_box(kLow, kHigh, spacing); }; };
  EXPECT_THAT(box(0.0), ThrowsMessage<InputError>(HasSubstr("spacing is 0 m")));
  EXPECT_THAT(box(0.6), ThrowsMessage<InputError>(HasSubstr("less than the spacing")));
  EXPECT_THAT(box(1e-4), ThrowsMessage<InputError>(HasSubstr("7.5e+11 points")));
  EXPECT_THROW(grid_in_box(kHigh, kLow, 0.1), InputError);
  EXPECT_THROW(grid_in_sphere(kLow, NAN, 0.1), InputError);
  EXPECT_THROW(scattered_in_box(kLow, Vec3::Constant(INFINITY), 0.1, 1), InputError);
  EXPECT_THROW(particle_cloud({}, "none"), InputError);
  EXPECT_THROW(particle_cloud(std::vector<Vec3>{{0, NAN, 0}}, "dust"), InputError);
}

}  // namespace
}  // namespace limber

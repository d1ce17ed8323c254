#include "core/contact/half_space.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>
#include <random>
#include <vector>

namespace limber {
namespace {

using HalfSpaces = std::vector<HalfSpace>;

HalfSpaces unit_cube() {
  HalfSpaces sides;
  for (int axis = 0; axis < 3; ++axis) {
    sides.push_back({Vec3::Unit(axis), 1.0});
    sides.push_back({-Vec3::Unit(axis), 1.0});
  }
  return sides;
}

TEST(NearestWithin, LeavesWhatIsInsideWhereItIs) {
  const Vec3 inside(0.3, -1.0, 0.999);
  EXPECT_EQ(nearest_within(inside, unit_cube(), 1e-12), inside);
}

TEST(NearestWithin, OfACubeIsOnItsSideEdgeOrCorner) {
  EXPECT_LT((nearest_within({3, 0.2, 0.1}, unit_cube(), 1e-12) - Vec3(1, 0.2, 0.1)).norm(), 1e-15);
  EXPECT_LT((nearest_within({3, -2, 0.1}, unit_cube(), 1e-12) - Vec3(1, -1, 0.1)).norm(), 1e-15);
  EXPECT_LT((nearest_within({3, -2, 9}, unit_cube(), 1e-12) - Vec3(1, -1, 1)).norm(), 1e-15);
}

class Random {
 public:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vec3 in_cube(double half) {
    return {between(-half, half), between(-half, half), between(-half, half)};
  }

 private:
  std::mt19937 engine_{7};
};

// Around the origin, some with nearly the same normal.
HalfSpaces random_sides(Random& random) {
  HalfSpaces sides = unit_cube();
  for (int i = 0; i < 12; ++i) {
    const Vec3 fresh = random.in_cube(1.0).normalized();
    const Vec3 turned = (sides.back().normal + random.in_cube(1e-3)).normalized();
    sides.push_back({i % 3 == 2 ? turned : fresh, random.between(0.3, 1.0)});
  }
  return sides;
}

// Every one, two and three planes: the nearest of the projections on them that lie within.
Vec3 nearest_of_all(const Vec3& from, const HalfSpaces& sides) {
  Vec3 best = Vec3::Constant(std::numeric_limits<double>::infinity());
  const auto consider = [&](const std::vector<const HalfSpace*>& planes) {
    const auto count = static_cast<Eigen::Index>(planes.size());
    Eigen::MatrixXd normals(count, 3);
    Eigen::VectorXd excess(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      normals.row(i) = planes[i]->normal.transpose();
      excess[i] = planes[i]->excess(from);
    }
    const Eigen::FullPivLU<Eigen::MatrixXd> gram(normals * normals.transpose());
    if (!gram.isInvertible()) return;
    const Vec3 place = from - normals.transpose() * gram.solve(excess);
    for (const HalfSpace& side : sides) {
      if (side.excess(place) > 1e-9) return;
    }
    if ((place - from).norm() < (best - from).norm()) best = place;
  };
  for (std::size_t i = 0; i < sides.size(); ++i) {
    consider({&sides[i]});
    for (std::size_t j = 0; j < i; ++j) {
      consider({&sides[i], &sides[j]});
      for (std::size_t k = 0; k < j; ++k) consider({&sides[i], &sides[j], &sides[k]});
    }
  }
  return best;
}

TEST(NearestWithin, IsTheNearestOfAllThatThreePlanesHold) {
  Random random;
  for (int run = 0; run < 300; ++run) {
    SCOPED_TRACE(run);
    const HalfSpaces sides = random_sides(random);
    const Vec3 from = 2.0 * random.in_cube(1.0).normalized();
    const Vec3 place = nearest_within(from, sides, 1e-9);
    const Vec3 wanted = nearest_of_all(from, sides);
    // Where planes meet at 1e-3 rad, the slack shows a thousand times as large.
    EXPECT_LT((place - wanted).norm(), 1e-5);
    EXPECT_NEAR((place - from).norm(), (wanted - from).norm(), 1e-8);
  }
}

}  // namespace
}  // namespace limber

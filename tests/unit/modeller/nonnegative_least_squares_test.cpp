#include "core/modeller/nonnegative_least_squares.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <vector>

namespace limber {
namespace {

double objective(const Eigen::MatrixXd& H, const Eigen::VectorXd& g, const Eigen::VectorXd& x) {
  return 0.5 * x.dot(H * x) - g.dot(x);
}

// The best of the 2^n sets of variables that may differ from zero.
double least_by_trying_all(const Eigen::MatrixXd& H, const Eigen::VectorXd& g) {
  const int n = static_cast<int>(g.size());
  double least = 0.0;
  for (int set = 1; set < 1 << n; ++set) {
    std::vector<int> free;
    for (int i = 0; i < n; ++i)
      if (set >> i & 1) free.push_back(i);
    const Eigen::MatrixXd block = H(free, free);
    const Eigen::VectorXd right = g(free);
    const Eigen::VectorXd z = block.ldlt().solve(right);
    if (z.minCoeff() >= 0.0) least = std::min(least, objective(block, right, z));
  }
  return least;
}

TEST(NonnegativeMinimum, IsThePlainOneWhereThatIsPositive) {
  const Eigen::Matrix2d H{{2.0, 1.0}, {1.0, 2.0}};
  const Eigen::Vector2d x = nonnegative_minimum(H, Eigen::Vector2d(5.0, 4.0));
  EXPECT_TRUE(x.isApprox(Eigen::Vector2d(2.0, 1.0)));
}

TEST(NonnegativeMinimum, PutsAtZeroWhatWouldBeNegative) {
  const Eigen::Matrix2d H{{2.0, 1.0}, {1.0, 2.0}};
  const Eigen::VectorXd x = nonnegative_minimum(H, Eigen::Vector2d(4.0, -1.0));
  EXPECT_NEAR(x[0], 2.0, 1e-15);
  EXPECT_EQ(x[1], 0.0);
}

TEST(NonnegativeMinimum, IsAsGoodAsTheBestOfAllSets) {
  std::srand(1);
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::MatrixXd A = Eigen::MatrixXd::Random(9, 7);
    const Eigen::MatrixXd H = A.transpose() * A + 1e-3 * Eigen::MatrixXd::Identity(7, 7);
    const Eigen::VectorXd g = A.transpose() * Eigen::VectorXd::Random(9);
    const Eigen::VectorXd x = nonnegative_minimum(H, g);
    EXPECT_GE(x.minCoeff(), 0.0);
    EXPECT_NEAR(objective(H, g, x), least_by_trying_all(H, g), 1e-10);
  }
}

}  // namespace
}  // namespace limber

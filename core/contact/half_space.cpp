#include "core/contact/half_space.h"

#include <Eigen/LU>
#include <array>
#include <optional>

namespace limber {
namespace {

constexpr int kMostExchanges = 64;           // a few are enough; cycles are for rounding alone
constexpr double kLeastIndependent = 1e-12;  // squared volume of unit normals that still count

// The planes that hold the place, at most three.
struct Holders {
  std::array<const HalfSpace*, 3> plane = {};
  int count = 0;
};

// The place nearest to `from` on one to three planes; none if they do not hold it, but pull it, or
// if their normals are as good as dependent.
template <int N>
std::optional<Vec3> held_by(const Vec3& from, const std::array<const HalfSpace*, 3>& plane) {
  Eigen::Matrix<double, 3, N> normals;
  Eigen::Matrix<double, N, 1> excess;
  for (int i = 0; i < N; ++i) {
    normals.col(i) = plane[i]->normal;
    excess[i] = plane[i]->excess(from);
  }
  const Eigen::Matrix<double, N, N> gram = normals.transpose() * normals;
  Eigen::Matrix<double, N, N> inverse;
  bool independent = false;
  gram.computeInverseWithCheck(inverse, independent, kLeastIndependent);
  if (!independent) return {};
  const Eigen::Matrix<double, N, 1> push = inverse * excess;
  if (push.minCoeff() < 0.0) return {};
  return from - normals * push;
}

std::optional<Vec3> held_by(const Vec3& from, const Holders& holders) {
  if (holders.count == 1) return held_by<1>(from, holders.plane);
  if (holders.count == 2) return held_by<2>(from, holders.plane);
  return held_by<3>(from, holders.plane);
}

bool lies_within(const Vec3& place, const Holders& holders, double slack) {
  for (int i = 0; i < holders.count; ++i) {
    if (holders.plane[i]->excess(place) > slack) return false;
  }
  return true;
}

// Which of the present holders stay beside the new one: every choice, as bits. One of them alone is
// right; most often it is one that keeps two.
constexpr std::array<int, 7> kChoices = {0b011, 0b101, 0b110, 0b001, 0b010, 0b100, 0b000};

// Takes one more plane in. False where rounding leaves no choice of holders.
bool take_in(const HalfSpace& fresh, const Vec3& from, double slack, Holders& holders,
             Vec3& place) {
  for (int choice : kChoices) {
    if (choice >> holders.count != 0) continue;
    Holders tried{{&fresh}, 1};
    for (int i = 0; i < holders.count; ++i) {
      if (choice >> i & 1) tried.plane[tried.count++] = holders.plane[i];
    }
    const std::optional<Vec3> held = held_by(from, tried);
    if (!held || !lies_within(*held, holders, slack)) continue;
    holders = tried;
    place = *held;
    return true;
  }
  return false;
}

}  // namespace

Vec3 nearest_within(const Vec3& from, std::span<const HalfSpace> half_spaces, double slack) {
  Vec3 place = from;
  Holders holders;
  for (int n = 0; n < kMostExchanges; ++n) {
    const HalfSpace* missed = nullptr;
    double most = slack;
    for (const HalfSpace& one : half_spaces) {
      const double excess = one.excess(place);
      if (excess > most) most = excess, missed = &one;
    }
    if (!missed || !take_in(*missed, from, slack, holders, place)) break;
  }
  return place;
}

}  // namespace limber

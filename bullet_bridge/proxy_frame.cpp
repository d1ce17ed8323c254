#include "bullet_bridge/proxy_frame.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

namespace {

struct PrincipalAxes {
  Mat3 axes;     // columns, right-handed
  Vec3 moments;  // kg m^2
};

// Off-diagonals below this share of the largest moment are what summing up leaves: turning by them
// changes L by less than its own rounding.
constexpr double kRounding = 1e-14;

PrincipalAxes principal_axes(const Mat3& inertia, const Mat3& wanted) {
  const Mat3 seen = wanted.transpose() * inertia * wanted;
  const Vec3 moments = seen.diagonal();
  const double mixed = (seen - Mat3(moments.asDiagonal())).cwiseAbs().maxCoeff();
  if (mixed <= kRounding * moments.maxCoeff()) return {wanted, moments};
  const Eigen::SelfAdjointEigenSolver<Mat3> principal(inertia);
  Mat3 axes = principal.eigenvectors();
  if (axes.determinant() < 0.0) axes.col(2) = -axes.col(2);
  return {axes, principal.eigenvalues()};
}

}  // namespace

ProxyFrame proxy_frame(const RigidMotion& motion, const Mat3& wanted) {
  const auto [axes, moments] = principal_axes(motion.inertia, wanted);
  ProxyFrame frame;
  frame.mass = motion.mass;
  frame.centre = motion.centre;
  frame.orientation = Eigen::Quaterniond(axes).normalized();
  // Points all in one place have no moment at all: they count as a tenth of a millimetre from their
  // centre, of which the share below leaves a micrometre.
  const double largest = std::max(moments.maxCoeff(), 1e-8 * motion.mass);
  frame.moments = moments.cwiseMax(kSmallestMomentShare * largest);
  frame.regularised = frame.moments != moments;
  frame.velocity = motion.velocity;
  frame.angular_velocity =
      axes * (axes.transpose() * motion.angular_momentum).cwiseQuotient(frame.moments);
  return frame;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet

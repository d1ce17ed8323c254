#include "bullet_bridge/proxy_frame.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

ProxyFrame proxy_frame(const RigidMotion& motion) {
  const Eigen::SelfAdjointEigenSolver<Mat3> principal(motion.inertia);
  Mat3 axes = principal.eigenvectors();
  if (axes.determinant() < 0.0) axes.col(2) = -axes.col(2);
  ProxyFrame frame;
  frame.mass = motion.mass;
  frame.centre = motion.centre;
  frame.orientation = Eigen::Quaterniond(axes).normalized();
  // Points all in one place have no moment at all: they count as a tenth of a millimetre from their
  // centre, of which the share below leaves a micrometre.
  const double largest = std::max(principal.eigenvalues()[2], 1e-8 * motion.mass);
  frame.moments = principal.eigenvalues().cwiseMax(kSmallestMomentShare * largest);
  frame.regularised = frame.moments != principal.eigenvalues();
  frame.velocity = motion.velocity;
  frame.angular_velocity =
      axes * (axes.transpose() * motion.angular_momentum).cwiseQuotient(frame.moments);
  return frame;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet

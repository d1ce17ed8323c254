#include "bullet_bridge/hand_over.h"

#include <cmath>
#include <utility>

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

// What the defects are measured against: sums of magnitudes, which do not vanish for a body that
// vibrates at rest.
struct MotionScale {
  double momentum = 0.0;          // sum m |v|
  double angular_momentum = 0.0;  // sum m |r| |v|
};

MotionScale scale_of(const Lattice& lattice, std::span<const std::int32_t> points,
                     const Vec3& centre) {
  MotionScale scale;
  for (std::int32_t p : points) {
    const PointMotion& point = lattice.motion[p];
    const double momentum = lattice.mass[p] * point.velocity.norm();
    scale.momentum += momentum;
    scale.angular_momentum += momentum * (point.position - centre).norm();
  }
  return scale;
}

double relative(double defect, double scale) { return scale > 0.0 ? defect / scale : defect; }

void note_defects(HandOver& books, const RigidMotion& lattice_side, const RigidMotion& body_side,
                  const MotionScale& scale) {
  books.momentum_defect_rel =
      relative((lattice_side.momentum() - body_side.momentum()).norm(), scale.momentum);
  books.angular_momentum_defect_rel = relative(
      (lattice_side.angular_momentum - body_side.angular_momentum).norm(), scale.angular_momentum);
}

// Adds the rigid motion that the points lack to the body's P and L. Spin about a line of points
// stays out: a moment that had to be raised for Bullet would give it back many times faster.
void give_motion(Lattice& lattice, std::span<const std::int32_t> points, const RigidMotion& body) {
  const RigidMotion now = rigid_motion(lattice.motion, lattice.mass, points);
  const Vec3 dv = (body.momentum() - now.momentum()) / now.mass;
  const Vec3 domega = angular_velocity_of(now.inertia, body.angular_momentum - now.angular_momentum,
                                          kSmallestMomentShare);
  for (std::int32_t p : points) {
    PointMotion& point = lattice.motion[p];
    point.velocity += dv + domega.cross(point.position - now.centre);
  }
}

void close_books(HandOver& books, bool regularised) {
  double missing = books.kinetic_before_J - books.kinetic_after_J - books.discarded_J;
  if (regularised) books.regularised_J = std::exchange(missing, 0.0);
  books.unaccounted_rel = relative(std::abs(missing), books.kinetic_before_J);
}

}  // namespace

RigidState take_state(const Lattice& lattice, std::span<const std::int32_t> points,
                      HandOver& books) {
  RigidState state = rigid_state(lattice, points);
  books.kinetic_before_J = kinetic_energy(lattice.motion, lattice.mass, points);
  books.elastic_J = elastic_energy(lattice, points);
  for (std::int32_t p : points) {
    const Vec3 vibration =
        lattice.motion[p].velocity - state.motion.velocity_at(lattice.motion[p].position);
    books.discarded_J += 0.5 * lattice.mass[p] * vibration.squaredNorm();
  }
  return state;
}

HandOver freeze(btDiscreteDynamicsWorld& world, const Lattice& lattice,
                std::span<const std::int32_t> points, std::unique_ptr<RigidProxy>& proxy,
                std::shared_ptr<PieceBody> body) {
  HandOver books;
  RigidState state = take_state(lattice, points, books);
  const RigidMotion before = state.motion;
  proxy = std::make_unique<RigidProxy>(world, lattice, points, std::move(state), std::move(body));
  const RigidMotion after = proxy->motion();
  books.kinetic_after_J = after.kinetic_energy();
  note_defects(books, before, after, scale_of(lattice, points, before.centre));
  close_books(books, proxy->regularised());
  return books;
}

HandOver thaw(Lattice& lattice, std::span<const std::int32_t> points, const RigidProxy& proxy) {
  HandOver books;
  books.to_flexible = true;
  const RigidMotion before = proxy.motion();
  books.kinetic_before_J = before.kinetic_energy();
  proxy.write_points(lattice, points);
  give_motion(lattice, points, before);
  const RigidMotion after = rigid_motion(lattice.motion, lattice.mass, points);
  books.kinetic_after_J = kinetic_energy(lattice.motion, lattice.mass, points);
  books.elastic_J = elastic_energy(lattice, points);
  note_defects(books, after, before, scale_of(lattice, points, after.centre));
  close_books(books, proxy.regularised());
  return books;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet

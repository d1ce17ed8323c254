#include <BulletDynamics/ConstraintSolver/btTypedConstraint.h>
#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>

#include <algorithm>
#include <limits>

#include "bullet_bridge/co_simulation_impl.h"
#include "bullet_bridge/conversions.h"
#include "bullet_bridge/waking.h"

// What a game sees of the pieces in its world, and what it does to them: bodies that follow the
// lattices, forces and teleports, joints and who inherits them.

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

double squared_distance(const Lattice& lattice, std::span<const std::int32_t> points,
                        const Vec3& place) {
  double least = std::numeric_limits<double>::infinity();
  for (std::int32_t p : points) {
    least = std::min(least, (lattice.motion[p].position - place).squaredNorm());
  }
  return least;
}

double mass_of(const Lattice& lattice, std::span<const std::int32_t> points) {
  double mass = 0.0;
  for (std::int32_t p : points) mass += lattice.mass[p];
  return mass;
}

// The same impulse about another point.
Impulse about(const Impulse& impulse, const Vec3& from, const Vec3& to) {
  return {impulse.linear, impulse.angular + (from - to).cross(impulse.linear)};
}

}  // namespace

void CoSimulation::Impl::take_changes_of_game(Piece& piece, double dt) {
  if (!piece.seen->take_changes(lattice_, piece.points, dt)) return;
  contacts_.forget();  // nothing came where it is on its way
  roles_stale_ = true;
}

void CoSimulation::Impl::gather_loads(double dt) {
  for (const Push& push : std::exchange(pushes_, {})) {
    const std::vector<PointLoad> loads = spread(lattice_, push.points, push.impulse, dt);
    loads_.insert(loads_.end(), loads.begin(), loads.end());
  }
  // What became rigid since then is strained by nothing.
  std::erase_if(loads_, [&](const PointLoad& load) {
    return lattice_.role[load.point] != PointRole::kDynamic;
  });
  contacts_.bear(std::exchange(loads_, {}));
}

void CoSimulation::Impl::show_velocities(double dt) {
  for (Piece* piece : flexible_pieces()) {
    if (!jointed(*piece)) continue;
    piece->seen->show_velocity(lattice_, piece->points, dt);
    wake_what_hangs_on(*piece);
  }
}

// A joint that is new: Bullet has put its bodies on islands before this piece was one that it
// solves (show_lattices()).
void CoSimulation::Impl::wake_what_hangs_on(const Piece& piece) {
  for (btTypedConstraint* joint : joints_of(world_, piece.body())) {
    if (!joint->isEnabled()) continue;
    for (btRigidBody* body : {&joint->getRigidBodyA(), &joint->getRigidBodyB()}) {
      if (!body->isStaticOrKinematicObject()) wake(world_, *body);
    }
  }
}

bool CoSimulation::Impl::jointed(const Piece& piece) const {
  return jointed_.contains(&piece.body());
}

// What joints did to the bodies of lattices. A free piece moves as the body that Bullet solved, so
// that its joints hold as those of any body do; in the next tick the same force strains it, from
// the points around the joints against the inertia of them all. What pins hold bears it there and
// does not move.
void CoSimulation::Impl::take_joints(double dt) {
  for (Piece* piece : flexible_pieces()) {
    if (!jointed(*piece)) continue;
    const Impulse impulse = piece->seen->joint_impulse();
    if (impulse.is_zero()) continue;
    const Vec3 centre = rigid_motion(lattice_.motion, lattice_.mass, piece->points).centre;
    const std::vector<std::int32_t> bearing = points_at_joints(*piece);
    const Vec3 there = rigid_motion(lattice_.motion, lattice_.mass, bearing).centre;
    const auto loads = spread(lattice_, bearing, about(impulse, centre, there), dt);
    loads_.insert(loads_.end(), loads.begin(), loads.end());
    if (piece->pinned) continue;
    for (PointLoad load : spread(lattice_, piece->points, impulse, dt)) {
      loads_.push_back({load.point, -load.force});
    }
    // Bullet's joints count on Bullet's step, which falls g dt^2 / 2 farther than the lattice did.
    move_rigidly(lattice_, piece->points, impulse, dt, 0.5 * dt * dt * environment_.gravity);
  }
}

std::vector<std::int32_t> CoSimulation::Impl::points_at_joints(const Piece& piece) const {
  // The lattice has gone through the tick, the body has not moved yet.
  const RigidMotion motion = rigid_motion(lattice_.motion, lattice_.mass, piece.points);
  std::vector<std::int32_t> points;
  for (btTypedConstraint* joint : joints_of(world_, piece.body())) {
    if (!joint->isEnabled()) continue;
    const Vec3 place = from_bullet(place_of_joint(*joint, piece.body()));
    const std::vector<std::int32_t> near =
        points_around(lattice_, piece.points, place + tick_ * motion.velocity_at(place));
    points.insert(points.end(), near.begin(), near.end());
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

void CoSimulation::Impl::show_lattices() {
  for (Piece* piece : flexible_pieces()) {
    piece->seen->show(world_, lattice_, piece->points, jointed(*piece));
  }
}

// The part that a broken piece's body goes on with: the one that its first joint holds, without
// joints the heaviest.
std::optional<std::size_t> CoSimulation::Impl::heir_among(
    const Piece& piece, const std::vector<std::vector<std::int32_t>>& groups) {
  std::optional<std::size_t> heir;
  double heaviest = 0.0;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const double mass = mass_of(lattice_, groups[i]);
    if (becomes_debris(groups[i]) || mass <= heaviest) continue;
    heir = i;
    heaviest = mass;
  }
  bool held = false;
  for (btTypedConstraint* joint : joints_of(world_, piece.body())) {
    if (!joint->isEnabled()) continue;
    const std::size_t holder = group_at(groups, from_bullet(place_of_joint(*joint, piece.body())));
    const bool lost = becomes_debris(groups[holder]) || (held && holder != *heir);
    if (lost) {
      disable(*joint, piece.object);
    } else {
      heir = holder;
      held = true;
    }
  }
  return heir;
}

std::size_t CoSimulation::Impl::group_at(const std::vector<std::vector<std::int32_t>>& groups,
                                         const Vec3& place) const {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const double distance = squared_distance(lattice_, groups[i], place);
    if (distance >= least) continue;
    least = distance;
    nearest = i;
  }
  return nearest;
}

// A joint names its bodies for good: it cannot go with another part.
void CoSimulation::Impl::disable(btTypedConstraint& joint, std::size_t object) {
  joint.setEnabled(false);
  notes_.push_back({lattice_.objects[object].authored.name,
                    "what a constraint held came off the part that keeps the body; the constraint "
                    "is disabled",
                    "remove it from the world, or attach another one to the fragment's body"});
}

// Joints go on naming a body of which nothing is left but debris: it has to outlive them.
void CoSimulation::Impl::keep_for_joints(std::size_t object, std::shared_ptr<PieceBody> body) {
  if (joints_of(world_, *body).empty()) return;
  body->leave();
  body->setCollisionShape(nullptr);
  body->setIslandTag(-1);
  orphans_.push_back({object, std::move(body)});
}

void CoSimulation::Impl::apply_impulse(std::size_t object, const Vec3& impulse, const Vec3& at) {
  sync_points();
  Piece* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& piece : pieces_) {
    if (piece->object != object) continue;
    const double distance = squared_distance(lattice_, piece->points, at);
    if (distance >= least) continue;
    least = distance;
    nearest = piece.get();
  }
  if (!nearest) return;  // debris
  if (nearest->flexible()) {
    std::vector<std::int32_t> points = points_around(lattice_, nearest->points, at);
    const Vec3 centre = rigid_motion(lattice_.motion, lattice_.mass, points).centre;
    pushes_.push_back({std::move(points), about({impulse, Vec3::Zero()}, at, centre)});
    return;
  }
  btRigidBody& body = nearest->body();
  body.activate();
  body.applyImpulse(to_bullet(impulse), to_bullet(at) - body.getCenterOfMassPosition());
  nearest->proxy->impulse += impulse.norm();  // strains it as that of a contact does
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet

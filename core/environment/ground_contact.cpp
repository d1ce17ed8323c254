#include "core/environment/ground_contact.h"

#include <cmath>
#include <string>
#include <utility>

#include "core/model/errors.h"

namespace limber {
namespace {

bool is_hard(const Ground& ground) { return std::isinf(ground.stiffness); }

double depth_of(const Ground& ground, const Vec3& position) {
  return ground.height - ground.normal.dot(position);
}

// The penalty without its ends: it pulls a point that has left.
double linear_force(const Ground& ground, double depth, double outward_speed) {
  return ground.stiffness * depth - ground.damping * outward_speed;
}

// A point that starts deep in a hard ground would be put onto it at once, and stretch its springs.
void require_above(const Lattice& lattice, const Ground& ground, std::int32_t p) {
  constexpr double kRounding = 1e-6;  // m
  const double depth = depth_of(ground, lattice.motion[p].position);
  if (depth <= kRounding) return;
  const LatticeObject& object = lattice.objects[lattice.point_object[p]];
  throw InputError({object.authored.name + ": point " + std::to_string(p - object.points.begin),
                    "it lies " + std::to_string(depth) + " m deep in a hard ground",
                    "lift the object, or give the ground a stiffness"});
}

}  // namespace

void GroundContact::resize(std::size_t points) {
  if (held_.size() == points) return;
  normal_force_.resize(points, 0.0);
  held_.resize(points, 0);
  stuck_.resize(points, 1);  // what starts at rest stays so; what slides is found out in a step
}

void GroundContact::stop_what_enters(Lattice& lattice, const Ground& ground, GroundReport& report) {
  if (!is_hard(ground)) return;
  resize(lattice.motion.size());
  for (std::int32_t p : lattice.dynamic_points) {
    if (lattice.inverse_mass[p] == 0.0) continue;
    require_above(lattice, ground, p);
    stop_at_surface(lattice, ground, p, report);
  }
}

void GroundContact::add_forces(Lattice& lattice, const Ground& ground,
                               std::span<const std::int32_t> points, double weight) {
  resize(lattice.motion.size());
  for (std::int32_t p : points) {
    const PointMotion& motion = lattice.motion[p];
    double push = 0.0;
    if (is_hard(ground)) {
      const double outward = ground.normal.dot(lattice.force[p]);
      held_[p] = held_[p] && outward <= 0.0;
      push = held_[p] ? -outward : 0.0;
    } else {
      const double depth = depth_of(ground, motion.position);
      if (depth <= 0.0) continue;
      push = ground_force(ground, depth, -ground.normal.dot(motion.velocity));
    }
    lattice.force[p] += push * ground.normal;
    normal_force_[p] += weight * push;
  }
}

std::span<const PointSupport> GroundContact::support(Lattice& lattice, const Ground& ground,
                                                     std::span<const std::int32_t> points,
                                                     double dt) {
  supports_.clear();
  if (is_hard(ground)) add_forces(lattice, ground, points, 1.0);
  if (is_hard(ground)) return {};
  resize(lattice.motion.size());
  for (std::int32_t p : points) {
    const double depth = depth_of(ground, lattice.motion[p].position);
    const double outward = ground.normal.dot(lattice.motion[p].velocity);
    const double pull = ground.normal.dot(lattice.force[p]) * lattice.inverse_mass[p];
    const bool leaves = depth <= (outward + pull * dt) * dt;
    if (depth <= 0.0 || leaves || lattice.inverse_mass[p] == 0.0) continue;
    lattice.force[p] += linear_force(ground, depth, outward) * ground.normal;
    supports_.push_back({p, ground.normal, ground.stiffness, ground.damping});
  }
  return supports_;
}

// Implicit Euler's force is that of the step's end.
void GroundContact::book_supports(const Lattice& lattice, const Ground& ground) {
  for (const PointSupport& s : supports_) {
    const PointMotion& end = lattice.motion[s.point];
    normal_force_[s.point] =
        linear_force(ground, depth_of(ground, end.position), ground.normal.dot(end.velocity));
  }
  supports_.clear();
}

void GroundContact::finish_step(Lattice& lattice, const Ground& ground, double dt,
                                double moved_share, GroundReport& report) {
  resize(lattice.motion.size());
  book_supports(lattice, ground);
  for (std::int32_t p : lattice.dynamic_points) {
    double normal_impulse = std::exchange(normal_force_[p], 0.0) * dt;
    report.impulse += normal_impulse * ground.normal;
    if (lattice.inverse_mass[p] == 0.0) continue;
    if (is_hard(ground)) normal_impulse += stop_at_surface(lattice, ground, p, report);
    rub(lattice, ground, p, normal_impulse, moved_share * dt, report);
  }
}

// Returns the impulse it took, N s.
double GroundContact::stop_at_surface(Lattice& lattice, const Ground& ground, std::int32_t p,
                                      GroundReport& report) {
  PointMotion& motion = lattice.motion[p];
  const double depth = depth_of(ground, motion.position);
  if (depth < 0.0) {
    held_[p] = 0;
    return 0.0;
  }
  motion.position += depth * ground.normal;
  const double inward = -ground.normal.dot(motion.velocity);
  if (inward < 0.0) return 0.0;
  held_[p] = 1;
  motion.velocity += inward * ground.normal;
  const double impulse = lattice.mass[p] * inward;
  report.impulse += impulse * ground.normal;
  report.impact_J += 0.5 * impulse * inward;
  return impulse;
}

void GroundContact::rub(Lattice& lattice, const Ground& ground, std::int32_t p,
                        double normal_impulse, double moved_by, GroundReport& report) {
  const bool was_stuck = stuck_[p] != 0;
  stuck_[p] = 0;
  if (normal_impulse <= 0.0 || ground.static_friction <= 0.0) return;
  PointMotion& motion = lattice.motion[p];
  const Vec3 slip = motion.velocity - ground.normal.dot(motion.velocity) * ground.normal;
  const double to_stop = lattice.mass[p] * slip.norm();  // N s
  const double friction = was_stuck ? ground.static_friction : ground.kinetic_friction;
  stuck_[p] = to_stop <= friction * normal_impulse;
  if (to_stop == 0.0) return;
  const double share =
      stuck_[p] ? 1.0 : ground.kinetic_friction * normal_impulse / to_stop;  // of the slip
  motion.velocity -= share * slip;
  motion.position -= share * moved_by * slip;
  report.impulse -= share * lattice.mass[p] * slip;
  report.friction_J +=
      0.5 * lattice.mass[p] * (1.0 - (1.0 - share) * (1.0 - share)) * slip.squaredNorm();
}

}  // namespace limber

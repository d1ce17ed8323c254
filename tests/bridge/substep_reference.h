#pragma once

#include <vector>

#include "bullet_bridge/obstacle.h"
#include "bullet_bridge/shapes/shape_cache.h"
#include "core/operators/boundary_tracker.h"
#include "core/operators/time_operator.h"
#include "tests/bridge/world.h"

namespace limber::bullet::test {

// A lattice among Bullet's bodies without the bridge's ticks: in every substep the lattice is
// integrated against the bodies' present poses, the opposite impulses go to the bodies, and Bullet
// takes a step of the same length, in which it solves all of its own contacts. What a body presses
// with is the library's; that there are no shadows, no support contacts, no corrections and no
// ticks is what it is compared with.
class SubstepReference : public SubstepCoupling {
 public:
  SubstepReference(World& world, const PhysicalModel& model) : world_(world) {
    add_object(lattice_, model);
    rebuild_active(lattice_);
    time_.keep_boundary(&boundary_);
    time_.roles_changed();
    boundary_.reset(lattice_.breaking);
    surface_ = LatticeSurface(lattice_, boundary_);
    for (const auto& body : world_.bodies()) {
      obstacles_.emplace_back(*body, 0, make_shadow(*body), Vec3::Constant(-100.0),
                              Vec3::Constant(100.0), 0.0, shapes_);
    }
  }

  void step(double dt) {
    const double gravity = world_->getGravity().y();
    time_.advance(1, dt, {.gravity = {0.0, gravity, 0.0}}, this);
    world_.step(dt);
  }

  PhysicalModel model() const { return extract_model(lattice_, 0); }

  void add_forces(Lattice& lattice, double dt) override {
    // What two things at 40 m/s each close on one another until the next listing.
    const bool list_now = substep_++ % kListInterval == 0;
    const ListingReach reach{80.0 * kListInterval * dt, 0.0};
    for (std::size_t i = 0; i < obstacles_.size(); ++i) {
      btRigidBody& body = *world_.bodies()[i];
      ShadowBody shadow = make_shadow(body);
      if (list_now) obstacles_[i].list(lattice, surface_, shadow, reach, dt);
      obstacles_[i].press(lattice, surface_, shadow, all_pairs(obstacles_[i]), dt);
      if (!shadow.touched) continue;
      body.applyCentralImpulse(to_bullet(Vec3(shadow.force * dt)));
      body.applyTorqueImpulse(to_bullet(Vec3(shadow.torque * dt)));
    }
  }
  void advance(Lattice&, double) override {}

 private:
  static constexpr int kListInterval = 8;

  ObstacleShare all_pairs(const Obstacle& obstacle) const {
    const std::vector<std::int32_t> one_piece(lattice_.motion.size(), 0), one_share(1, 0);
    std::vector<ObstacleShare> shares(1);
    obstacle.share_out(one_piece, one_share, shares);
    return shares[0];
  }

  World& world_;
  Lattice lattice_;
  TimeOperator time_{lattice_};
  BoundaryTracker boundary_;
  LatticeSurface surface_;
  ShapeCache shapes_;
  std::vector<Obstacle> obstacles_;
  int substep_ = 0;
};

}  // namespace limber::bullet::test

// Group 8: a lattice that flies into a face of a free rigid box.

#include <algorithm>

#include "core/dynamics/rigid_body.h"
#include "core/operators/time_operator.h"
#include "tests/reference/cubic.h"
#include "tests/reference/kinds.h"
#include "tests/reference/readings.h"

namespace limber::reference {
namespace {

constexpr double kStepShare = 0.005;  // of the largest stable step

// A linear penalty without friction between points and the plane of a box's face towards -x; the
// box is integrated with the lattice.
class FaceContact : public SubstepCoupling {
 public:
  FaceContact(const RigidBody& box, double half_length, double stiffness)
      : box_(box), half_length_(half_length), stiffness_(stiffness) {}

  void add_forces(Lattice& lattice, double) override {
    for (std::int32_t p : lattice.dynamic_points) {
      const Vec3& at = lattice.motion[p].position;
      const double press = stiffness_ * std::max(0.0, depth(at));
      if (press == 0.0) continue;
      lattice.force[p] -= press * outwards();
      box_.add_force(press * outwards(), at);
    }
  }

  void advance(Lattice&, double dt) override {
    apply_forces(box_, dt);
    advance_pose(box_, dt);
  }

  const RigidBody& box() const { return box_; }
  double depth(const Vec3& at) const { return (at - box_.position).dot(outwards()) + half_length_; }

 private:
  Vec3 outwards() const { return box_.rotation.col(0); }  // from the points into the box

  RigidBody box_;
  double half_length_;  // m
  double stiffness_;    // N/m
};

RigidBody box_of(const Json& p) {
  RigidBody box;
  box.inverse_mass = 1.0 / p.at("box_mass").get<double>();
  box.inverse_inertia_local = vec3(p.at("box_inertia")).cwiseInverse().asDiagonal();
  box.position = p.at("box_half").at(0).get<double>() * Vec3::UnitX();
  refresh_rotation(box);
  return box;
}

PhysicalModel lattice_of(const Json& p) {
  PhysicalModel model = cubic_model(p);
  place(model, Mat3::Identity(), vec3(p.at("positions_first_point")));
  set_in_motion(model, p.at("v").get<double>() * Vec3::UnitX(), vec3(p.at("spin")));
  return model;
}

// Velocities of symplectic Euler are those of half a step before: the other half, in which nothing
// touches, with the forces as they are.
void catch_up_half_a_step(Lattice& lattice, double dt) {
  const std::vector<PointMotion> now = lattice.motion;
  TimeOperator(lattice).advance_springs_only(1, 0.5 * dt);
  for (std::size_t p = 0; p < now.size(); ++p) lattice.motion[p].position = now[p].position;
}

Json lattice_vs_box(const Case& c) {
  const double stiffness = c.params.at("k_penalty"), t_end = c.params.at("t_end");
  Lattice lattice = compiled(lattice_of(c.params));
  const double largest = kStepShare * largest_step(lattice.objects[0], stiffness);
  const int steps = 1 + static_cast<int>(t_end / largest);
  FaceContact contact(box_of(c.params), c.params.at("box_half").at(0), stiffness);
  TimeOperator(lattice).advance(steps, t_end / steps, kEmptySpace, &contact);
  catch_up_half_a_step(lattice, t_end / steps);

  const RigidBody& box = contact.box();
  const RigidMotion body = rigid_motion(lattice);
  const Vec3 momentum_of_box = box.velocity / box.inverse_mass;
  const Vec3 L = body.centre.cross(body.momentum()) + body.angular_momentum +
                 box.position.cross(momentum_of_box) + angular_momentum(box);
  const bool separated =
      std::all_of(lattice.motion.begin(), lattice.motion.end(),
                  [&](const PointMotion& point) { return contact.depth(point.position) < 0.0; });
  return {{"P_total", to_json(Vec3(body.momentum() + momentum_of_box))},
          {"L_total_about_origin", to_json(L)},
          {"E_total", energy(lattice) + kinetic_energy(box)},
          {"box_velocity_after", to_json(box.velocity)},
          {"box_omega_after", to_json(box.angular_velocity)},
          {"box_angular_momentum_after", to_json(angular_momentum(box))},
          {"lattice_com_velocity_after", to_json(body.velocity)},
          {"lattice_L_about_own_com_after", to_json(body.angular_momentum)},
          {"lattice_internal_energy_after", energy_about_centre(lattice)},
          {"separated_at_t_end", separated}};
}

}  // namespace

Kinds box_collision_kinds() { return {{"lattice_vs_box", lattice_vs_box}}; }

}  // namespace limber::reference

#pragma once

#include "tests/contact_scenes/scene.h"

// What scenes have in common.

namespace limber::bullet::test {

// m/s: Bullet's soft bodies keep 0.05 to 0.46 where they should rest.
inline constexpr double kAtRest = 0.02;

// m: where "no lower" and "no higher" are asked for.
inline constexpr double kSlack = 0.005;

// A wide static box with its top at y = 0.
RigidSpec ground();

// m, of the shape without what Bullet keeps around it.
double lowest(const btRigidBody& body);
double highest(const PhysicalModel& model);
Vec3 centre_of(const btRigidBody& body);
bool is_broken(const PhysicalModel& model);

// The rigid body's lowest corner in the floor.
Demand stays_above_ground(std::size_t rigid);
// The lattice's lowest point, by half of its spacing.
Demand lattice_stays_above_ground(std::size_t flexible, double spacing);
// Its centre, above the start.
Demand is_not_thrown_up(std::size_t rigid, double start_height);
// A sphere or rod below all of an unbroken sheet that it fell on.
Demand does_not_pass_sheet(std::size_t rigid, std::size_t flexible);
// What breaks something pays for it: its speed at the end, as a share of what free fall would have
// made of the start's. 10 cm about the middle of a sheet of 1 kg/m^2 weigh 3 % of a ball of 1 kg.
Demand is_slowed(std::size_t rigid, double start_speed, double start_height);

}  // namespace limber::bullet::test

#include "bullet_bridge/support_contacts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/bridge/measure.h"
#include "tests/bridge/world.h"

namespace limber::bullet::test {
namespace {

// Sliding 1.5 m/s in any direction, whatever the contact's tangents are: friction is against the
// slip (limited along each tangent alone, it would be up to 45 degrees beside it), and slows the
// box by mu g.
TEST(SupportContacts, SlowABoxAlongItsWay) {
  for (double angle : {0.0, 0.3, 0.7, 2.0}) {
    World world;
    btRigidBody& ground = world.add_ground();
    btRigidBody& box = world.add_box({0.4, 0.05, 0.4}, 2.0, {0.0, 0.05, 0.0});
    ground.setFriction(btScalar(0.5));
    box.setFriction(btScalar(0.6));
    world.run(0.2, kTick);
    ShadowSet shadows;
    ShadowBody& shadow = shadows[shadows.shadow_of(box)];
    const Vec3 way(std::cos(angle), 0.0, std::sin(angle));
    shadow.velocity = 1.5 * way;
    shadow.angular_velocity.setZero();
    std::vector<SupportContact> contacts =
        gather_support_contacts(*world->getDispatcher(), shadows);
    ASSERT_GE(contacts.size(), 3u);
    constexpr int kSubsteps = 100;
    constexpr double kSubstep = kTick / kSubsteps;
    const int index = shadows.find(box);
    for (int n = 0; n < kSubsteps; ++n) {
      shadows[index].velocity.y() -= kGravity * kSubstep;
      solve_support_contacts(contacts, shadows, kSubstep);
      advance_pose(shadows[index], kSubstep);
    }
    const double slowed = 1.5 - 0.3 * kGravity * kTick;
    // Of the 0.05 m/s up to 0.007: Bullet's contacts are open by micrometres at first. Friction
    // along a diagonal would push it aside by 0.03 m/s.
    EXPECT_NEAR(shadows[index].velocity.dot(way), slowed, 0.01) << angle;
    EXPECT_LT(shadows[index].velocity.cross(way).norm(), 0.005) << angle;
  }
}

}  // namespace
}  // namespace limber::bullet::test

// Points followed along their ways: nothing tunnels, and every point goes back to where it came
// from.

#include <gtest/gtest.h>

#include "bullet_bridge/shapes/convex_distance.h"
#include "bullet_bridge/shapes/convex_planes.h"
#include "tests/bridge/shapes.h"
#include "tests/bridge/world.h"

namespace limber::bullet::test {
namespace {

struct Body {
  std::string name;
  std::shared_ptr<btCollisionShape> shape;
};

std::vector<Body> convex_bodies() {
  return {{"box", std::make_shared<btBoxShape>(bt(0.3, 0.2, 0.4))},
          {"sphere", std::make_shared<btSphereShape>(btScalar(0.3))},
          {"capsule", std::make_shared<btCapsuleShapeZ>(btScalar(0.2), btScalar(0.4))},
          {"cylinder", std::make_shared<btCylinderShapeX>(bt(0.4, 0.2, 0.2))},
          {"cone", std::make_shared<btConeShape>(btScalar(0.3), btScalar(0.4))},
          {"hull of 8", hull_of(box_corners({0.3, 0.2, 0.4}))},
          {"hull of 100", hull_of(sphere_points(100, 0.35))}};
}

// Against looking at the way every 1/500 of it.
TEST(WayInto, IsWhereDenseSamplesFirstLieInside) {
  constexpr int kSamples = 500;
  Random random(1);
  for (const Body& body : convex_bodies()) {
    const ContactPart part = only_part(*body.shape);
    int entered = 0;
    for (int i = 0; i < 1000; ++i) {
      const Vec3 a = random.in_cube(0.8), b = random.in_cube(0.8);
      if (penetration(part, a).depth > 0.0) continue;
      const WayIn in = way_into(part, part.to_part_frame(a), part.to_part_frame(b));
      int first = 0;
      while (first <= kSamples &&
             penetration(part, a + double(first) / kSamples * (b - a)).depth <= 0.0) {
        ++first;
      }
      ASSERT_TRUE(in.enters || first > kSamples) << body.name;
      if (!in.enters) continue;
      ++entered;
      const Penetration at = penetration(part, a + in.share * (b - a));
      ASSERT_NEAR(at.depth, 0.0, 1e-9) << body.name;
      ASSERT_LE(in.normal.dot(part.direction_to_part_frame(b - a)), 1e-9) << body.name;
      if (first <= kSamples) {
        ASSERT_LE(in.share, double(first) / kSamples + 1e-9) << body.name;
      }
      // What lies between two samples is a graze, and stays shallow.
      for (int k = 0; k < std::min(first, kSamples) && k < in.share * kSamples; ++k) {
        ASSERT_LE(penetration(part, a + double(k) / kSamples * (b - a)).depth, 0.0);
      }
    }
    EXPECT_GT(entered, 50) << body.name;
  }
}

// Plates with their upper side at y = 0, thicker downwards.
struct Plate {
  std::string name;
  std::vector<std::shared_ptr<void>> owned;
  const btCollisionShape* shape;
  double top = 0.0;  // y of the upper side in the shape's frame, m
};

template <class Shape, class... Arguments>
Plate plate_of(const std::string& name, double top, Arguments&&... arguments) {
  auto shape = std::make_shared<Shape>(std::forward<Arguments>(arguments)...);
  shape->setMargin(0);
  return {name, {shape}, shape.get(), top};
}

std::vector<Plate> plates(double thickness) {
  const double half = 0.5 * thickness;
  std::vector<Plate> all;
  auto box = std::make_shared<btBoxShape>(bt(1, half, 1));
  all.push_back({"box", {box}, box.get(), half});
  auto disc = std::make_shared<btCylinderShape>(bt(1, half, 1));
  all.push_back({"disc", {disc}, disc.get(), half});
  std::shared_ptr<btConvexHullShape> hull = hull_of(box_corners({1, half, 1}));
  hull->setMargin(0);
  all.push_back({"hull", {hull}, hull.get(), half});
  auto closed = std::make_shared<Mesh>();
  add_box(*closed, {1, half, 1});
  all.push_back({"closed mesh", {closed}, &closed->shape(), half});
  auto net = std::make_shared<Mesh>();
  add_net(*net, 40, 0.05, [](double, double) { return 0.0; });
  all.push_back({"net", {net}, &net->shape(), 0.0});
  auto heights = std::make_shared<std::vector<float>>(41 * 41, 0.0f);
  auto field = std::make_shared<btHeightfieldTerrainShape>(41, 41, heights->data(), btScalar(-1),
                                                           btScalar(1), 1, false);
  field->setLocalScaling(bt(0.05, 1, 0.05));
  all.push_back({"height field", {heights, field}, field.get(), 0.0});
  return all;
}

// One way through, fast: it is met at once, led back to its side, and left there.
void expect_plate_holds(const Plate& plate, const ContactPart& part, const Vec3& start,
                        const Vec3& step) {
  PointTrack track = start_track(part, start);
  Vec3 at = start;
  for (int i = 0; i < 8; ++i) {
    at += step;
    const Penetration contact = follow(part, at, track);
    const double below = plate.top - at.y();
    if (below <= 0.0) {
      ASSERT_LE(contact.depth, 0.0);
      continue;
    }
    if (std::max(std::abs(at.x()), std::abs(at.z())) > 0.6) return;
    ASSERT_TRUE(track.inside) << plate.name << " step " << i << " at " << at.transpose();
    ASSERT_NEAR(contact.depth, below, 1e-6) << plate.name;
    ASSERT_GT(contact.normal.y(), 1.0 - 1e-9) << plate.name;
    if (below > 0.5) break;
  }
  for (int i = 0; track.inside && i < 1000; ++i) {
    at += 0.05 * Vec3::UnitY();
    const double below = plate.top - at.y();
    const Penetration contact = follow(part, at, track);
    if (below > 1e-6) {
      ASSERT_NEAR(contact.depth, below, 1e-6) << plate.name;
    }
  }
  ASSERT_FALSE(track.inside);
  ASSERT_GT(at.y(), plate.top - 1e-6);
}

TEST(ThinPlates, AreMetAtAnySpeed) {
  Random random(2);
  for (double thickness : {1e-4, 1e-3, 1e-2}) {
    for (const Plate& plate : plates(thickness)) {
      const ContactPart part = only_part(*plate.shape);
      for (double speed : {1.0, 10.0, 50.0, 200.0}) {
        for (double dt : {1e-4, 1e-3, 1e-2}) {
          for (int i = 0; i < 30; ++i) {
            Vec3 way = random.direction();
            way.y() = -std::abs(way.y()) - 0.5;
            const Vec3 start(random.between(-0.3, 0.3), plate.top + random.between(1e-6, 0.01),
                             random.between(-0.3, 0.3));
            expect_plate_holds(plate, part, start, speed * dt * way.normalized());
            if (HasFatalFailure()) return;
          }
        }
      }
    }
  }
}

// From below the same plates are met from below.
TEST(ThinPlates, AreTwoSided) {
  for (const Plate& plate : plates(1e-3)) {
    const ContactPart part = only_part(*plate.shape);
    PointTrack track = start_track(part, {0.11, -0.3, 0.07});
    const Penetration contact = follow(part, {0.11, 0.2, 0.07}, track);
    EXPECT_TRUE(track.inside) << plate.name;
    EXPECT_NEAR(contact.depth, 0.2 + plate.top, 1e-6) << plate.name;
    EXPECT_LT((contact.normal + Vec3::UnitY()).norm(), 1e-6) << plate.name;
  }
}

TEST(ThinPlates, LetGoBesideTheirEdge) {
  for (const Plate& plate : plates(1e-2)) {
    const ContactPart part = only_part(*plate.shape);
    Vec3 at(0.95, plate.top + 0.001, 0.1);
    PointTrack track = start_track(part, at);
    at.y() = plate.top - 0.001;
    EXPECT_GT(follow(part, at, track).depth, 0.0) << plate.name;
    for (; at.x() < 1.04; at.x() += 0.003) follow(part, at, track);
    EXPECT_FALSE(track.inside) << plate.name;
    EXPECT_LE(follow(part, at - 0.5 * Vec3::UnitY(), track).depth, 0.0) << plate.name;
  }
}

// A point that is pressed slowly through a plate never changes sides, and its depth grows by its
// way.
TEST(ThinPlates, PressedThroughSlowlyLeadBackToo) {
  for (const Plate& plate : plates(1e-3)) {
    const ContactPart part = only_part(*plate.shape);
    Vec3 at(0.213, plate.top + 1e-5, 0.377);
    PointTrack track = start_track(part, at);
    for (int i = 0; i < 400; ++i) {
      at.y() -= 1.1e-5;
      const Penetration contact = follow(part, at, track);
      if (at.y() > plate.top) continue;
      ASSERT_NEAR(contact.depth, plate.top - at.y(), 1e-7) << plate.name << " " << i;
      ASSERT_GT(contact.normal.y(), 1.0 - 1e-9) << plate.name;
    }
  }
}

// Balls smaller than the way of one substep are hit, not passed.
TEST(SmallBalls, AreMetByWaysRightThroughThem) {
  Random random(3);
  Mesh mesh;
  const auto ball_hull = hull_of(sphere_points(60, 0.01));
  ball_hull->setMargin(0);
  const ContactPart hull = only_part(*ball_hull);
  const auto corners = sphere_points(60, 0.01);
  for (const HullFace& f : hull_faces(corners)) {
    for (std::size_t k = 1; k + 1 < f.corners.size(); ++k) {
      mesh.add(corners[f.corners[0]], corners[f.corners[k]], corners[f.corners[k + 1]]);
    }
  }
  const btSphereShape sphere(btScalar(0.01));
  for (const ContactPart& part : {only_part(sphere), hull, only_part(mesh.shape())}) {
    for (int i = 0; i < 2000; ++i) {
      const Vec3 way = 0.05 * random.direction();
      const Vec3 aim = 0.005 * random.direction();
      Vec3 at = aim - 0.6 * way;
      PointTrack track = start_track(part, at);
      ASSERT_GT(follow(part, at += way, track).depth, 0.0);
      ASSERT_TRUE(track.inside);
      ASSERT_LT(track.normal.dot(way), 0.0);
      const Vec3 normal = track.normal;
      // It is held until it is out again on the side it came from.
      ASSERT_GT(follow(part, at += 0.2 * way, track).depth, 0.0);
      for (int k = 0; track.inside && k < 100; ++k) follow(part, at += 0.01 * normal, track);
      ASSERT_FALSE(track.inside);
    }
  }
}

// Around a ball, 1 mm deep: never lost, always that deep as far as the facets allow, and without
// jumps of the normal.
void expect_contact_all_around(const ContactPart& part, double radius, double sagging,
                               double largest_turn) {
  const double depth = sagging + 0.001;
  PointTrack track = start_track(part, {radius + 0.05, 1e-4, 0.0});
  follow(part, {radius - depth, 1e-4, 0.0}, track);
  Vec3 normal = track.normal;
  for (int i = 0; i < 4000; ++i) {
    const double a = 2.0 * M_PI * i / 2000.0;
    const Vec3 at((radius - depth) * std::cos(a), 1e-4, (radius - depth) * std::sin(a));
    const Penetration contact = follow(part, at, track);
    ASSERT_TRUE(track.inside) << i;
    ASSERT_GT(contact.depth, 0.0009) << i;
    ASSERT_LT(contact.depth, depth + 1e-4) << i;
    ASSERT_GT(contact.normal.dot(normal), std::cos(largest_turn)) << i;
    normal = contact.normal;
  }
}

TEST(Sliding, AroundRoundThingsKeepsContact) {
  expect_contact_all_around(only_part(btSphereShape(btScalar(0.3))), 0.3, 0.0, 0.005);
  expect_contact_all_around(only_part(btCapsuleShape(btScalar(0.3), btScalar(0.4))), 0.3, 0.0,
                            0.005);
  expect_contact_all_around(only_part(btCylinderShape(bt(0.3, 0.4, 0.3))), 0.3, 0.0, 0.005);
  const auto corners = sphere_points(400, 0.3);
  const auto ball = hull_of(corners);
  ball->setMargin(0);
  expect_contact_all_around(only_part(*ball), 0.3, 0.004, 0.3);
  Mesh mesh;
  for (const HullFace& f : hull_faces(corners)) {
    for (std::size_t k = 1; k + 1 < f.corners.size(); ++k) {
      mesh.add(corners[f.corners[0]], corners[f.corners[k]], corners[f.corners[k + 1]]);
    }
  }
  expect_contact_all_around(only_part(mesh.shape()), 0.3, 0.004, 0.3);
}

TEST(Sliding, AcrossABoxKeepsToItsSide) {
  const ContactPart part = only_part(btBoxShape(bt(0.3, 0.2, 0.4)));
  PointTrack track = start_track(part, {0.0, 0.3, 0.0});
  follow(part, {0.0, 0.19, 0.0}, track);
  for (double x = 0.0; x < 0.2999; x += 1e-3) {
    const Penetration contact = follow(part, {x, 0.19, 0.0}, track);
    ASSERT_NEAR(contact.depth, 0.01, 1e-7);  // also where the other side is nearer
    ASSERT_EQ(contact.normal, Vec3::UnitY());
  }
  EXPECT_LE(follow(part, {0.301, 0.19, 0.0}, track).depth, 0.0);
}

TEST(StartTrack, TakesTheNearestSideOfWhatItIsIn) {
  Random random(5);
  for (const Body& body : convex_bodies()) {
    const ContactPart part = only_part(*body.shape);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 at = random.in_cube(0.4);
      const Penetration nearest = penetration(part, at);
      PointTrack track = start_track(part, at);
      ASSERT_EQ(track.inside, nearest.depth > 0.0);
      if (!track.inside) continue;
      ASSERT_EQ(track.normal, nearest.normal);
      ASSERT_EQ(follow(part, at, track).depth, nearest.depth);
    }
  }
}

// Random walks in steps of every size, half of them under water: what follow() says agrees with the
// plain distance while the point is shallow.
TEST(Follow, AgreesWithTheDistanceOnShallowWays) {
  Random random(6);
  for (const Body& body : convex_bodies()) {
    const ContactPart part = only_part(*body.shape);
    Vec3 at(0.0, 1.0, 0.0);
    PointTrack track = start_track(part, at);
    int touched = 0;
    for (int i = 0; i < 100000; ++i) {
      // Drawn to the surface.
      const Penetration nearest = penetration(part, at);
      at += random.between(0.0, 2e-3) * random.direction() + 0.1 * nearest.depth * nearest.normal;
      const Penetration now = penetration(part, at);
      const Penetration contact = follow(part, at, track);
      touched += contact.depth > 0.0;
      ASSERT_EQ(track.inside, now.depth > 0.0) << body.name << " " << i;
      if (now.depth > 0.0) {
        ASSERT_GE(contact.depth, now.depth * (1.0 - 1e-12)) << body.name;
      }
    }
    EXPECT_GT(touched, 20000) << body.name;
  }
}

// The same in a part that is placed in the world and turned.
TEST(Follow, GoesWithThePlaceOfThePart) {
  const btCylinderShapeX cylinder(bt(0.4, 0.2, 0.2));
  const ContactPart own = only_part(cylinder);
  const Vec3 position(3, -2, 5);
  const Mat3 rotation = Eigen::AngleAxisd(1.0, Vec3(1, 2, 3).normalized()).matrix();
  const ContactPart there = placed(own, position, rotation);
  Random random(7);
  for (int i = 0; i < 10000; ++i) {
    const Vec3 a = random.in_cube(0.5), b = random.in_cube(0.5);
    PointTrack here_track = start_track(own, a);
    PointTrack there_track = start_track(there, position + rotation * a);
    const Penetration here_contact = follow(own, b, here_track);
    const Penetration contact = follow(there, position + rotation * b, there_track);
    if (penetration(own, b).depth < 1e-9) continue;
    ASSERT_TRUE(here_track.inside && there_track.inside);
    ASSERT_NEAR(contact.depth, here_contact.depth, 1e-10);
    ASSERT_LT((contact.normal - rotation * here_contact.normal).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace limber::bullet::test

// Triangles of meshes and height fields under points.

#include <gtest/gtest.h>

#include <array>

#include "tests/bridge/shapes.h"
#include "tests/bridge/world.h"

namespace limber::bullet::test {
namespace {

double hills(double x, double z) { return 0.1 * std::sin(3.0 * x) * std::cos(2.0 * z); }

// 41 x 41 samples of hills() every 5 cm, in each of Bullet's number formats.
struct Field {
  static constexpr int kSide = 41;
  static constexpr double kStep = 0.05, kQuantum = 1e-5;  // m
  std::vector<float> floats;
  std::vector<double> doubles;
  std::vector<short> shorts;

  Field() {
    for (int k = 0; k < kSide; ++k) {
      for (int i = 0; i < kSide; ++i) {
        const double y = hills((i - 20) * kStep, (k - 20) * kStep);
        floats.push_back(static_cast<float>(y));
        doubles.push_back(y);
        shorts.push_back(static_cast<short>(std::lround(y / kQuantum)));
      }
    }
  }
};

// The lattice point i, k of the field in a shape's frame.
Vec3 sample(const Field& field, int i, int k) {
  return {(i - 20) * Field::kStep, field.doubles[k * Field::kSide + i], (k - 20) * Field::kStep};
}

TEST(HeightField, OfEveryFormatHasItsSamplesOnTheSurface) {
  const Field field;
  const btScalar low(-0.25), high(0.25);
  std::vector<std::unique_ptr<btHeightfieldTerrainShape>> shapes;
  for (bool flip : {false, true}) {
    shapes.push_back(std::make_unique<btHeightfieldTerrainShape>(41, 41, field.floats.data(), low,
                                                                 high, 1, flip));
    shapes.push_back(std::make_unique<btHeightfieldTerrainShape>(41, 41, field.doubles.data(), low,
                                                                 high, 1, flip));
    shapes.push_back(std::make_unique<btHeightfieldTerrainShape>(
        41, 41, field.shorts.data(), btScalar(Field::kQuantum), low, high, 1, flip));
  }
  shapes.back()->setUseDiamondSubdivision(true);
  shapes[0]->setUseZigzagSubdivision(true);
  shapes[1]->setFlipTriangleWinding(true);
  for (auto& shape : shapes) {
    shape->setLocalScaling(bt(Field::kStep, 1, Field::kStep));
    const ContactPart part = only_part(*shape);
    ASSERT_EQ(part.kind, ContactPart::Kind::kTriangles);
    EXPECT_EQ(part.triangles->triangles().size(), 2u * 40u * 40u);
    for (const PatchTriangle& t : part.triangles->triangles()) ASSERT_GT(t.normal.y(), 0.0);
    for (int i = 1; i < 40; i += 3) {
      for (int k = 1; k < 40; k += 3) {
        ASSERT_NEAR(penetration(part, sample(field, i, k)).depth, 0.0, 1.1e-5);
      }
    }
  }
}

TEST(HeightField, MayStandUpAlongAnyAxis) {
  const Field field;
  for (int up = 0; up < 3; ++up) {
    const btHeightfieldTerrainShape shape(41, 41, field.floats.data(), btScalar(-0.25),
                                          btScalar(0.25), up, false);
    const ContactPart part = only_part(shape, 30.0);
    PointTrack track = start_track(part, 0.3 * Vec3::Unit(up));
    const Penetration contact = follow(part, -0.3 * Vec3::Unit(up), track);
    EXPECT_NEAR(contact.depth, 0.3, 1e-3) << up;
    EXPECT_GT(contact.normal[up], 0.9) << up;
  }
}

// Only what is near is gathered, and what is gathered has the same keys in every tick.
TEST(TrianglePatch, IsGatheredAroundTheLattice) {
  Mesh mesh;
  add_net(mesh, 100, 0.05, hills);
  ShapeCache cache;
  const auto near = contact_parts(mesh.shape(), {-0.1, -1, -0.1}, {0.1, 1, 0.1}, cache);
  const ContactPart all = only_part(mesh.shape());
  EXPECT_EQ(all.triangles->triangles().size(), 20000u);
  ASSERT_EQ(near.size(), 1u);
  EXPECT_LT(near[0].triangles->triangles().size(), 100u);
  for (const PatchTriangle& t : near[0].triangles->triangles()) {
    const std::int32_t there = all.triangles->index_of(t.key);
    ASSERT_GE(there, 0);
    ASSERT_EQ(all.triangles->triangles()[there].corners, t.corners);
  }
  EXPECT_TRUE(contact_parts(mesh.shape(), {-0.1, 0.5, -0.1}, {0.1, 1, 0.1}, cache).empty());
}

// A contact outlives the gathering of the next tick.
TEST(TrianglePatch, TracksGoOnInTheNextTick) {
  Mesh mesh;
  add_net(mesh, 100, 0.05, [](double, double) { return 0.0; });
  ShapeCache cache;
  PointTrack track;
  Vec3 at(-1.0, 1e-3, 0.033);
  track.last = at;
  at.y() = -1e-3;
  for (int tick = 0; tick < 100; ++tick) {
    const Vec3 reach = Vec3::Constant(0.03);
    const auto parts = contact_parts(mesh.shape(), at - reach, at + reach, cache);
    ASSERT_EQ(parts.size(), 1u);
    for (int substep = 0; substep < 10; ++substep) {
      const Penetration contact = follow(parts[0], at, track);
      ASSERT_NEAR(contact.depth, 1e-3, 1e-7) << tick;
      at += Vec3(0.002, 0.0, 0.0003);
    }
  }
}

// Ways straight through corners and along edges of a net leak nowhere.
TEST(TrianglePatch, HasNoHolesAtCornersAndEdges) {
  Mesh mesh;
  add_net(mesh, 20, 0.05, hills);
  const ContactPart part = only_part(mesh.shape());
  Random random(1);
  for (const Triangle& c : mesh.corners) {
    for (int k = 0; k < 3; ++k) {
      for (double share : {0.0, 0.25, 0.5, random.between(0.0, 1.0)}) {
        const Vec3 on = c[k] + share * (c[(k + 1) % 3] - c[k]);
        if (std::max(std::abs(on.x()), std::abs(on.z())) > 0.49) continue;
        for (const Vec3& way : {Vec3(0, -0.02, 0), Vec3(0.003, -0.02, -0.002)}) {
          PointTrack track = start_track(part, on - 0.7 * way);
          ASSERT_GT(follow(part, on + 0.3 * way, track).depth, 0.0) << on.transpose();
          ASSERT_GT(track.normal.y(), 0.5);
        }
      }
    }
  }
}

double brute_force_distance(const Mesh& mesh, const Vec3& at) {
  double nearest = 1e300;
  for (const Triangle& c : mesh.corners) {
    nearest = std::min(nearest, std::sqrt(nearest_on_triangle(at, c).squared_distance));
  }
  return nearest;
}

TEST(TrianglePatch, DepthIsTheDistanceByBruteForce) {
  Mesh mesh;
  add_net(mesh, 20, 0.05, hills);
  const ContactPart part = only_part(mesh.shape());
  Random random(2);
  for (int i = 0; i < 3000; ++i) {
    const double x = random.between(-0.45, 0.45), z = random.between(-0.45, 0.45);
    const Vec3 above(x, hills(x, z) + 0.02, z), below(x, hills(x, z) - 0.01, z);
    ASSERT_NEAR(penetration(part, above).depth, -brute_force_distance(mesh, above), 1e-7);
    PointTrack track = start_track(part, above);
    const Penetration contact = follow(part, below, track);
    ASSERT_NEAR(contact.depth, brute_force_distance(mesh, below), 1e-7);
    // The way out along the normal ends on the surface.
    ASSERT_LT(brute_force_distance(mesh, below + contact.depth * contact.normal), 1e-7);
  }
}

// A random walk under the hills, and over them: the side is never lost, the depth is the distance.
void walk_on_hills(const ContactPart& part, const Mesh& mesh, double tolerance) {
  Random random(3);
  Vec3 at(0.0, 0.2, 0.0);
  PointTrack track = start_track(part, at);
  double was = 1e300;
  int touches = 0;
  for (int i = 0; i < 100000; ++i) {
    Vec3 next = at + random.between(0.0, 0.004) * random.direction();
    next.x() = std::clamp(next.x(), -0.4, 0.4);
    next.z() = std::clamp(next.z(), -0.4, 0.4);
    // Towards the surface, from far off on either side.
    next.y() += 0.02 * (hills(next.x(), next.z()) - next.y());
    const Penetration contact = follow(part, next, track);
    const double under = hills(next.x(), next.z()) - next.y();
    // The facets leave hills() by up to 1 mm.
    if (under > 0.002) {
      ASSERT_TRUE(track.inside) << i << " " << next.transpose();
    }
    if (under < -0.002) {
      ASSERT_FALSE(track.inside) << i << " " << next.transpose();
    }
    if (track.inside && i % 10 == 0) {
      ASSERT_NEAR(contact.depth, brute_force_distance(mesh, next), tolerance) << i;
    }
    if (track.inside && was < 1e299) {
      ASSERT_LE(std::abs(contact.depth - was), (next - at).norm() + tolerance) << i;
    }
    was = track.inside ? contact.depth : 1e300;
    touches += track.inside;
    at = next;
  }
  EXPECT_GT(touches, 20000);
}

TEST(TrianglePatch, RandomWalksKeepTheirSide) {
  Mesh mesh;
  add_net(mesh, 20, 0.05, hills);
  walk_on_hills(only_part(mesh.shape()), mesh, 1e-6);
}

// Squares of a floor that only touch: without common edges, and with T-junctions.
TEST(TrianglePatch, SlidingOverSeamsWithoutCommonEdgesKeepsContact) {
  Mesh mesh;
  for (int i = -10; i < 10; ++i) {
    const double x = 0.1 * i, shift = i % 2 == 0 ? 0.0 : 0.037, gap = 2e-6;
    for (int k = -10; k < 10; ++k) {
      const double z = 0.1 * k + shift;
      const Vec3 a(x, 0, z), b(x + 0.1 - gap, 0, z), c(x + 0.1 - gap, 0, z + 0.1), d(x, 0, z + 0.1);
      mesh.add(a, d, b);
      mesh.add(b, d, c);
    }
  }
  const ContactPart part = only_part(mesh.shape());
  Random random(4);
  for (double depth : {1e-6, 1e-4, 1e-2}) {
    for (int walk = 0; walk < 50; ++walk) {
      Vec3 at(random.between(-0.5, 0.5), 1e-3, random.between(-0.5, 0.5));
      PointTrack track = start_track(part, at);
      at.y() = -depth;
      Vec3 step = 1e-3 * random.direction();
      step.y() = 0.0;
      for (int i = 0; i < 400; ++i, at += step) {
        const Penetration contact = follow(part, at, track);
        ASSERT_TRUE(track.inside) << depth << " " << i;
        // Over a gap the depth is that to the nearest rim.
        ASSERT_NEAR(contact.depth, depth, 3e-6) << i;
      }
    }
  }
}

// A floor with a wall of the same mesh: pressed on the floor, a point does not pass the wall.
TEST(TrianglePatch, ValleysHoldOnBothSlopes) {
  Mesh mesh;
  mesh.add({-1, 0, -1}, {-1, 0, 1}, {0, 0, 1});
  mesh.add({-1, 0, -1}, {0, 0, 1}, {0, 0, -1});
  mesh.add({0, 0, -1}, {0, 0, 1}, {0, 1, 1});
  mesh.add({0, 0, -1}, {0, 1, 1}, {0, 1, -1});
  // The floor goes on behind the wall: three triangles on an edge.
  mesh.add({0, 0, -1}, {0, 0, 1}, {1, 0, 1});
  mesh.add({0, 0, -1}, {1, 0, 1}, {1, 0, -1});
  const ContactPart part = only_part(mesh.shape());
  for (double side : {-1.0, 1.0}) {
    Vec3 at(0.05 * side, 0.01, 0.2);
    PointTrack track = start_track(part, at);
    at.y() = -0.001;
    for (; at.x() * side > -0.02; at.x() -= side * 1e-3) {
      const Penetration contact = follow(part, at, track);
      ASSERT_TRUE(track.inside);
      const double past = std::max(0.0, -at.x() * side);
      ASSERT_NEAR(contact.depth, std::hypot(0.001, past), 1e-7);
      ASSERT_GE(contact.normal.x() * side, -1e-7);
      ASSERT_GT(contact.normal.y(), 0.0);
    }
  }
}

TEST(TrianglePatch, MarginsAreAroundBothSides) {
  Mesh mesh;
  add_net(mesh, 20, 0.05, [](double, double) { return 0.0; });
  auto& shape = const_cast<btBvhTriangleMeshShape&>(mesh.shape());
  shape.setMargin(btScalar(0.03));
  const ContactPart part = only_part(shape);
  for (double side : {-1.0, 1.0}) {
    PointTrack track = start_track(part, side * Vec3(0.1, 0.05, 0.1));
    EXPECT_LE(follow(part, side * Vec3(0.1, 0.031, 0.1), track).depth, 0.0);
    for (double height : {0.029, 0.01, 0.0, -0.01, -0.05, 0.02}) {
      const Penetration contact = follow(part, side * Vec3(0.11, height, 0.12), track);
      EXPECT_NEAR(contact.depth, 0.03 - height, 1e-7);
      EXPECT_NEAR(contact.normal.y(), side, 1e-7);
    }
    EXPECT_LE(follow(part, side * Vec3(0.1, 0.031, 0.1), track).depth, 0.0);
    EXPECT_FALSE(track.inside);
  }
}

// What lies on a mesh to rounding when it is first seen lies on the side that the triangles face.
TEST(TrianglePatch, StartOnTheSurfaceIsAStartAboveIt) {
  Mesh mesh;
  add_net(mesh, 20, 0.05, [](double, double) { return 0.0; });
  const ContactPart part = only_part(mesh.shape());
  for (double height : {1e-7, 0.0, -1e-7}) {
    PointTrack track = start_track(part, {0.12, height, 0.13});
    const Penetration contact = follow(part, {0.12, -1e-3, 0.13}, track);
    EXPECT_NEAR(contact.depth, 1e-3, 1e-6);
    EXPECT_GT(contact.normal.y(), 0.99);
  }
}

TEST(TrianglePatch, OfScaledAndGImpactMeshesAreTheSame) {
  Mesh mesh;
  add_net(mesh, 20, 0.05, hills);
  btBvhTriangleMeshShape plain(&mesh.triangles(), true);
  const btScaledBvhTriangleMeshShape scaled(&plain, bt(2, 3, 2));
  btGImpactMeshShape impact(&mesh.triangles());
  impact.setMargin(0);
  impact.updateBound();
  const ContactPart one = only_part(plain), large = only_part(scaled), other = only_part(impact);
  EXPECT_EQ(other.triangles->triangles().size(), one.triangles->triangles().size());
  for (const PatchTriangle& t : one.triangles->triangles()) {
    const Vec3 middle = (t.corners[0] + t.corners[1] + t.corners[2]) / 3.0;
    ASSERT_NEAR(penetration(other, middle).depth, 0.0, 1e-6);
    ASSERT_NEAR(penetration(large, middle.cwiseProduct(Vec3(2, 3, 2))).depth, 0.0, 1e-6);
  }
}

TEST(TrianglePatch, InACompoundIsTurnedAndShifted) {
  Mesh mesh;
  add_net(mesh, 20, 0.05, [](double, double) { return 0.0; });
  auto& shape = const_cast<btBvhTriangleMeshShape&>(mesh.shape());
  btCompoundShape compound;
  compound.addChildShape(btTransform(btQuaternion(btVector3(0, 0, 1), SIMD_HALF_PI), bt(2, 1, 0)),
                         &shape);
  ShapeCache cache;
  const auto parts = contact_parts(compound, {1.9, 0.9, -0.1}, {2.1, 1.1, 0.1}, cache);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_LT(parts[0].triangles->triangles().size(), 100u);
  PointTrack track = start_track(parts[0], {1.98, 1.01, 0.02});
  const Penetration contact = follow(parts[0], {2.004, 1.01, 0.02}, track);
  EXPECT_NEAR(contact.depth, 0.004, 1e-6);
  EXPECT_NEAR(contact.normal.x(), -1.0, 1e-6);
}

}  // namespace
}  // namespace limber::bullet::test

// What it costs to ask a collision shape for one point of a lattice: contact/points/SHAPE, and the
// same points through Bullet's general query beside it. The points fill the shape's bounds and a
// tenth around them, and move to and fro by 10 um, as in a substep.

#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <benchmark/benchmark.h>
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "bullet_bridge/conversions.h"
#include "bullet_bridge/shapes/bullet_query.h"
#include "bullet_bridge/shapes/contact_shape.h"
#include "bullet_bridge/shapes/point_track.h"
#include "bullet_bridge/shapes/shape_cache.h"

namespace limber::bullet {
namespace {

struct Shape {
  std::vector<std::shared_ptr<void>> owned;
  std::shared_ptr<btCollisionShape> shape;
  Vec3 low, high;  // where points are asked for, m
};

std::shared_ptr<btConvexHullShape> hull_of_sphere(int points) {
  auto hull = std::make_shared<btConvexHullShape>();
  for (int i = 0; i < points; ++i) {
    const double y = 1.0 - (2.0 * i + 1.0) / points, r = std::sqrt(1.0 - y * y);
    hull->addPoint(to_bullet(0.5 * Vec3(r * std::cos(2.39996 * i), y, r * std::sin(2.39996 * i))),
                   false);
  }
  hull->recalcLocalAabb();
  return hull;
}

Shape around(std::shared_ptr<btCollisionShape> shape) {
  btVector3 low, high;
  shape->getAabb(btTransform::getIdentity(), low, high);
  const Vec3 a = from_bullet(low), b = from_bullet(high), more = 0.1 * (b - a);
  return {{}, std::move(shape), a - more, b + more};
}

Shape hull_8() {
  auto hull = std::make_shared<btConvexHullShape>();
  for (int i = 0; i < 8; ++i) {
    hull->addPoint(to_bullet(Vec3(i & 1 ? 0.5 : -0.5, i & 2 ? 0.3 : -0.3, i & 4 ? 0.4 : -0.4)),
                   false);
  }
  hull->recalcLocalAabb();
  return around(hull);
}

Shape compound_20() {
  auto box = std::make_shared<btBoxShape>(to_bullet(Vec3(0.1, 0.15, 0.05)));
  auto compound = std::make_shared<btCompoundShape>();
  for (int i = 0; i < 20; ++i) {
    const btQuaternion turn(btVector3(0, 1, 0), static_cast<btScalar>(0.3 * i));
    compound->addChildShape(btTransform(turn, to_bullet(Vec3(0.2 * (i % 5), 0.3 * (i / 5), 0.0))),
                            box.get());
  }
  Shape shape = around(compound);
  shape.owned.push_back(box);
  return shape;
}

double hills(double x, double z) { return 0.1 * std::sin(3.0 * x) * std::cos(2.0 * z); }

// Points within 25 cm of the origin, as those of a lattice on the ground.
Shape near_origin(std::shared_ptr<btCollisionShape> shape,
                  std::vector<std::shared_ptr<void>> owned) {
  return {std::move(owned), std::move(shape), {-0.25, -0.05, -0.25}, {0.25, 0.45, 0.25}};
}

Shape mesh_10k() {
  auto triangles = std::make_shared<btTriangleMesh>();
  const auto at = [](int i, int k) -> btVector3 {
    const double x = 0.1 * (i - 35), z = 0.1 * (k - 35);
    return to_bullet(Vec3(x, hills(x, z), z));
  };
  for (int i = 0; i < 71; ++i) {
    for (int k = 0; k < 71; ++k) {
      triangles->addTriangle(at(i, k), at(i, k + 1), at(i + 1, k));
      triangles->addTriangle(at(i + 1, k), at(i, k + 1), at(i + 1, k + 1));
    }
  }
  return near_origin(std::make_shared<btBvhTriangleMeshShape>(triangles.get(), true), {triangles});
}

Shape height_field() {
  auto heights = std::make_shared<std::vector<float>>();
  for (int k = 0; k < 71; ++k) {
    for (int i = 0; i < 71; ++i) {
      heights->push_back(static_cast<float>(hills(0.1 * (i - 35), 0.1 * (k - 35))));
    }
  }
  auto field = std::make_shared<btHeightfieldTerrainShape>(71, 71, heights->data(), btScalar(-0.25),
                                                           btScalar(0.25), 1, false);
  field->setLocalScaling(to_bullet(Vec3(0.1, 1.0, 0.1)));
  return near_origin(field, {heights});
}

std::vector<Vec3> points_in(const Vec3& low, const Vec3& high) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::vector<Vec3> points;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 at(share(engine), share(engine), share(engine));
    points.emplace_back(low + at.cwiseProduct(high - low));
  }
  return points;
}

void points(benchmark::State& state, Shape (*make)()) {
  const Shape shape = make();
  ShapeCache cache;
  const auto parts = contact_parts(*shape.shape, shape.low, shape.high, cache);
  const std::vector<Vec3> places = points_in(shape.low, shape.high);
  std::vector<PointTrack> tracks;
  for (const ContactPart& part : parts) {
    for (const Vec3& at : places) tracks.push_back(start_track(part, at));
  }
  const Vec3 there = Vec3::Constant(1e-5);
  bool back = false;
  for (auto _ : state) {
    back = !back;
    auto track = tracks.begin();
    for (const ContactPart& part : parts) {
      for (const Vec3& at : places) {
        benchmark::DoNotOptimize(follow(part, back ? at : Vec3(at + there), *track++).depth);
      }
    }
  }
  using benchmark::Counter;
  state.counters["s_per_point"] =
      Counter(double(places.size()), Counter::kIsIterationInvariantRate | Counter::kInvert);
}

// Once a tick and body: the parts, or the triangles, in reach.
void gather(benchmark::State& state, Shape (*make)()) {
  const Shape shape = make();
  ShapeCache cache;
  for (auto _ : state) {
    benchmark::DoNotOptimize(contact_parts(*shape.shape, shape.low, shape.high, cache).size());
  }
}

// GJK, and EPA inside.
void bullet_query(benchmark::State& state, Shape (*make)()) {
  const Shape shape = make();
  const auto& convex = static_cast<const btConvexShape&>(*shape.shape);
  const std::vector<Vec3> places = points_in(shape.low, shape.high);
  for (auto _ : state) {
    for (const Vec3& at : places) benchmark::DoNotOptimize(bullet_penetration(convex, at).depth);
  }
  using benchmark::Counter;
  state.counters["s_per_point"] =
      Counter(double(places.size()), Counter::kIsIterationInvariantRate | Counter::kInvert);
}

Shape box() { return around(std::make_shared<btBoxShape>(to_bullet(Vec3(0.5, 0.3, 0.4)))); }
Shape sphere() { return around(std::make_shared<btSphereShape>(btScalar(0.5))); }
Shape capsule() { return around(std::make_shared<btCapsuleShape>(btScalar(0.3), btScalar(0.4))); }
Shape cylinder() {
  return around(std::make_shared<btCylinderShape>(to_bullet(Vec3(0.3, 0.5, 0.3))));
}
Shape cone() { return around(std::make_shared<btConeShape>(btScalar(0.3), btScalar(0.7))); }
Shape hull_100() { return around(hull_of_sphere(100)); }

BENCHMARK_CAPTURE(points, box, box)->Name("contact/points/box");
BENCHMARK_CAPTURE(points, sphere, sphere)->Name("contact/points/sphere");
BENCHMARK_CAPTURE(points, capsule, capsule)->Name("contact/points/capsule");
BENCHMARK_CAPTURE(points, cylinder, cylinder)->Name("contact/points/cylinder");
BENCHMARK_CAPTURE(points, cone, cone)->Name("contact/points/cone");
BENCHMARK_CAPTURE(points, hull8, hull_8)->Name("contact/points/hull8");
BENCHMARK_CAPTURE(points, hull100, hull_100)->Name("contact/points/hull100");
BENCHMARK_CAPTURE(points, compound20, compound_20)->Name("contact/points/compound20");
BENCHMARK_CAPTURE(points, mesh10k, mesh_10k)->Name("contact/points/mesh10k");
BENCHMARK_CAPTURE(points, heightfield, height_field)->Name("contact/points/heightfield");

BENCHMARK_CAPTURE(gather, hull100, hull_100)->Name("contact/gather/hull100");
BENCHMARK_CAPTURE(gather, compound20, compound_20)->Name("contact/gather/compound20");
BENCHMARK_CAPTURE(gather, mesh10k, mesh_10k)->Name("contact/gather/mesh10k");
BENCHMARK_CAPTURE(gather, heightfield, height_field)->Name("contact/gather/heightfield");

BENCHMARK_CAPTURE(bullet_query, box, box)->Name("bullet/points/box");
BENCHMARK_CAPTURE(bullet_query, sphere, sphere)->Name("bullet/points/sphere");
BENCHMARK_CAPTURE(bullet_query, hull8, hull_8)->Name("bullet/points/hull8");
BENCHMARK_CAPTURE(bullet_query, hull100, hull_100)->Name("bullet/points/hull100");

}  // namespace
}  // namespace limber::bullet

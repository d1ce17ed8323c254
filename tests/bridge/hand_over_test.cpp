#include "bullet_bridge/hand_over.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numeric>

#include "tests/bridge/measure.h"
#include "tests/bridge/models.h"
#include "tests/bridge/random.h"
#include "tests/bridge/world.h"

namespace limber::bullet::test {
namespace {

constexpr int kRuns = 30;

// One object's lattice in a world without gravity, and all its points.
struct Subject {
  World world{0.0};
  Lattice lattice;
  std::vector<std::int32_t> points;

  explicit Subject(PhysicalModel model) {
    add_object(lattice, std::move(model));
    points.resize(lattice.motion.size());
    std::iota(points.begin(), points.end(), 0);
  }
  Sums sums() const { return sums_of(extract_model(lattice, 0)); }
};

// Deformed by a few per cent, vibrating, spinning, anywhere.
std::unique_ptr<Subject> random_subject(Random& random) {
  const Block block{.cells = {3, 2, 1}, .spacing = 0.1, .mass = random.between(0.1, 50.0)};
  PhysicalModel model = make_block(block, Vec3::Zero());
  for (Vec3& x : model.geometry.points) x += random.in_cube(0.004);
  place(model, random.rotation(), random.in_cube(10.0));
  set_in_motion(model, random.in_cube(5.0), random.in_cube(10.0));
  for (PointAttributes& point : model.points) point.velocity += random.in_cube(0.5);
  return std::make_unique<Subject>(std::move(model));
}

// m |r| |v| of the whole: what angular momentum about the centre is compared with.
double angular_scale(const Sums& sums) { return std::sqrt(2.0 * sums.kinetic * sums.mass) * 0.3; }

// About the centre of mass.
Vec3 spin_of(const Sums& sums) {
  return sums.angular_momentum - sums.centre().cross(sums.momentum);
}

// Kinetic energy of the rigid motion with the same P and L, by an inertia summed here.
double rigid_kinetic(const PhysicalModel& model) {
  const Sums sums = sums_of(model);
  Mat3 inertia = Mat3::Zero();
  for (PointId p : ids_of(model.points)) {
    const Vec3 r = model.geometry.points[p] - sums.centre();
    inertia += model.points[p].mass * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
  }
  const Vec3 spin = spin_of(sums);
  const Vec3 omega = inertia.ldlt().solve(spin);
  return 0.5 * sums.momentum.squaredNorm() / sums.mass + 0.5 * omega.dot(spin);
}

void expect_same_motion(const Sums& got, const Sums& wanted, double tolerance) {
  const double momentum_scale = std::sqrt(2.0 * wanted.kinetic * wanted.mass);
  EXPECT_NEAR(got.mass, wanted.mass, tolerance * wanted.mass);
  EXPECT_LT((got.momentum - wanted.momentum).norm(), tolerance * momentum_scale);
  EXPECT_LT((spin_of(got) - spin_of(wanted)).norm(), tolerance * angular_scale(wanted));
  // Positions are stored as such: their rounding is relative to the distance from the origin.
  EXPECT_LT((got.centre() - wanted.centre()).norm(),
            tolerance * std::max(1.0, wanted.centre().norm()));
}

TEST(HandOver, FreezeKeepsMomentumAngularMomentumAndCentre) {
  Random random(1);
  for (int run = 0; run < kRuns; ++run) {
    SCOPED_TRACE(run);
    const auto subject = random_subject(random);
    const Sums before = subject->sums();
    std::unique_ptr<RigidProxy> proxy;
    freeze(*subject->world, subject->lattice, subject->points, proxy);
    expect_same_motion(sums_of(proxy->body()), before, by_precision(1e-6, 1e-12));
  }
}

TEST(HandOver, FreezeLosesExactlyTheVibration) {
  Random random(2);
  for (int run = 0; run < kRuns; ++run) {
    SCOPED_TRACE(run);
    const auto subject = random_subject(random);
    const Sums before = subject->sums();
    const double rigid = rigid_kinetic(extract_model(subject->lattice, 0));
    std::unique_ptr<RigidProxy> proxy;
    const HandOver books = freeze(*subject->world, subject->lattice, subject->points, proxy);
    const double tolerance = by_precision(2e-6, 1e-12) * before.kinetic;
    EXPECT_NEAR(sums_of(proxy->body()).kinetic, rigid, tolerance);
    EXPECT_NEAR(books.discarded_J, before.kinetic - rigid, tolerance);
    EXPECT_NEAR(books.kinetic_before_J, before.kinetic, tolerance);
    EXPECT_NEAR(books.kinetic_after_J, rigid, tolerance);
    EXPECT_NEAR(books.elastic_J, before.elastic, 1e-12 * before.elastic);
    EXPECT_GT(books.discarded_J, 0.0);
  }
}

TEST(HandOver, ThawGivesTheDeformedShapeAndItsElasticEnergyBack) {
  Random random(3);
  for (int run = 0; run < kRuns; ++run) {
    SCOPED_TRACE(run);
    const auto subject = random_subject(random);
    const PhysicalModel before = extract_model(subject->lattice, 0);
    std::unique_ptr<RigidProxy> proxy;
    freeze(*subject->world, subject->lattice, subject->points, proxy);
    for (PointMotion& point : subject->lattice.motion) point = {Vec3::Zero(), Vec3::Zero()};
    thaw(subject->lattice, subject->points, *proxy);
    const PhysicalModel after = extract_model(subject->lattice, 0);
    // Ten metres from the origin a float has 1e-6 m.
    for (PointId p : ids_of(before.points)) {
      EXPECT_LT((after.geometry.points[p] - before.geometry.points[p]).norm(),
                by_precision(3e-6, 1e-13));
    }
    EXPECT_NEAR(sums_of(after).elastic, sums_of(before).elastic, 1e-10 * sums_of(before).elastic);
    expect_same_motion(sums_of(after), sums_of(before), by_precision(1e-6, 1e-12));
    EXPECT_NEAR(sums_of(after).kinetic, rigid_kinetic(before),
                by_precision(2e-6, 1e-12) * sums_of(before).kinetic);
  }
}

TEST(HandOver, AThousandTimesForthAndBackChangesNothingMore) {
  Random random(4);
  for (int run = 0; run < 5; ++run) {
    SCOPED_TRACE(run);
    const auto subject = random_subject(random);
    const Sums before = subject->sums();
    const double rigid = rigid_kinetic(extract_model(subject->lattice, 0));
    for (int i = 0; i < 1000; ++i) {
      std::unique_ptr<RigidProxy> proxy;
      freeze(*subject->world, subject->lattice, subject->points, proxy);
      thaw(subject->lattice, subject->points, *proxy);
    }
    // A thousand roundings of a float, 6e-8 each, were they all to one side.
    expect_same_motion(subject->sums(), before, by_precision(6e-5, 1e-11));
    EXPECT_NEAR(subject->sums().kinetic, rigid, by_precision(1.2e-4, 1e-11) * before.kinetic);
    EXPECT_NEAR(subject->sums().elastic, before.elastic, 1e-9 * before.elastic);
  }
}

// Points with edges between neighbours, without a cell.
PhysicalModel skeleton(const std::vector<Vec3>& points) {
  GeometricModelBuilder builder;
  builder.begin_subobject("skeleton");
  std::vector<PointId> ids;
  for (const Vec3& x : points) ids.push_back(builder.add_point(x));
  for (std::size_t i = 1; i < ids.size(); ++i) builder.edge(ids[i - 1], ids[i]);
  PhysicalModel model = with_default_attributes(builder.finish(), "skeleton");
  for (PointAttributes& point : model.points) point.mass = 0.3;
  for (EdgeAttributes& edge : model.edges) edge.stiffness = 1e4;
  return model;
}

void expect_kept(PhysicalModel model, Random& random) {
  place(model, random.rotation(), random.in_cube(1.0));
  set_in_motion(model, random.in_cube(3.0), random.in_cube(5.0));
  for (PointAttributes& point : model.points) point.velocity += random.in_cube(0.5);
  Subject subject(std::move(model));
  const Sums before = subject.sums();
  std::unique_ptr<RigidProxy> proxy;
  freeze(*subject.world, subject.lattice, subject.points, proxy);
  expect_same_motion(sums_of(proxy->body()), before, by_precision(1e-6, 1e-12));
  thaw(subject.lattice, subject.points, *proxy);
  expect_same_motion(subject.sums(), before, by_precision(1e-6, 1e-12));
}

TEST(HandOver, OfTwoPointsKeepsMomentumAndAngularMomentum) {
  Random random(5);
  for (int run = 0; run < kRuns; ++run)
    expect_kept(skeleton({Vec3::Zero(), Vec3::UnitX()}), random);
}

TEST(HandOver, OfAStraightRopeKeepsMomentumAndAngularMomentum) {
  Random random(6);
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) points.push_back(0.1 * i * Vec3::UnitX());
  for (int run = 0; run < kRuns; ++run) expect_kept(skeleton(points), random);
}

TEST(HandOver, OfAFlatPieceKeepsMomentumAndAngularMomentum) {
  Random random(7);
  const std::vector<Vec3> square = {{0, 0, 0}, {0.2, 0, 0}, {0.2, 0.3, 0}, {0, 0.3, 0}};
  for (int run = 0; run < kRuns; ++run) expect_kept(skeleton(square), random);
}

}  // namespace
}  // namespace limber::bullet::test

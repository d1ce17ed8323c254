#include "core/contact/surface_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/dynamics/spring_forces.h"
#include "tests/support/blocks.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

constexpr double kSpacing = 0.02;  // m
constexpr double kMass = 8e-3;     // kg, of a block's point: 1000 kg/m^3

// Springs and contacts with faces alone; symplectic Euler.
class World {
 public:
  explicit World(std::vector<PhysicalModel> models)
      : lattice(test::lattice_of(std::move(models))),
        springs_(lattice, SpringPrecision::kDouble),
        pieces_(components(lattice)) {
    springs_.active_changed();
  }

  void advance(int steps, double dt) {
    for (int n = 0; n < steps; ++n) {
      for (std::int32_t p : lattice.dynamic_points) lattice.force[p] = lattice.mass[p] * gravity;
      springs_.add(dt);
      if (step_++ % 4 == 0) contacts.refresh(lattice, pieces_, step_ == 1, false);
      contacts.add_forces(lattice, dt);
      for (std::int32_t p : lattice.dynamic_points) {
        PointMotion& motion = lattice.motion[p];
        motion.velocity += dt * lattice.inverse_mass[p] * lattice.force[p];
        motion.position += dt * motion.velocity;
      }
    }
  }

  double step_limit() const {
    double step = kUnbreakable;
    for (const LatticeObject& object : lattice.objects) step = std::min(step, object.largest_step);
    return step;
  }

  Lattice lattice;
  SurfaceContacts contacts;
  Vec3 gravity = Vec3::Zero();

 private:
  SpringForces springs_;
  Components pieces_;
  int step_ = 0;
};

// Waves run through it at about `wave_speed`, m/s.
PhysicalModel unbreakable_block(std::array<int, 3> cells, double spacing, const Vec3& origin,
                                double wave_speed) {
  PhysicalModel model = test::block({.cells = cells, .spacing = spacing, .origin = origin});
  const double mass = kMass * std::pow(spacing / kSpacing, 3);
  for (PointAttributes& p : model.points) p.mass = mass;
  for (EdgeAttributes& e : model.edges) {
    e.stiffness = mass * wave_speed * wave_speed / (spacing * spacing);
    e.damping = 0.0;
    e.break_threshold = kUnbreakable;
  }
  model.object.friction = 0.0;
  model.object.restitution = 1.0;
  return model;
}

PhysicalModel grains(const std::vector<Vec3>& at, const std::vector<Vec3>& velocity) {
  GeometricModelBuilder builder;
  builder.begin_subobject("grains");
  for (const Vec3& x : at) builder.add_point(x);
  PhysicalModel model = with_default_attributes(builder.finish(), "grains");
  for (PointId p : ids_of(model.points)) {
    model.points[p].mass = 2e-5;
    model.points[p].velocity = velocity[p.index()];
  }
  model.object.friction = 0.0;
  model.object.restitution = 1.0;
  model.object.particle_radius = 1e-5;
  return model;
}

// Is it inside the first object? By the solid angles of the outer faces (Van Oosterom and Strackee,
// IEEE Trans. Biomed. Eng. 1983).
bool is_inside(const Lattice& lattice, const Vec3& x) {
  const LatticeObject& object = lattice.objects[0];
  double angle = 0.0;
  for (FaceId f : ids_of(object.authored.geometry.faces)) {
    if (!lattice.breaking.face_external[f.index()]) continue;
    const auto& c = object.authored.geometry.faces[f].corners;
    const Vec3 a = lattice.motion[c[0].index()].position - x;
    const Vec3 b = lattice.motion[c[1].index()].position - x;
    const Vec3 d = lattice.motion[c[2].index()].position - x;
    const double na = a.norm(), nb = b.norm(), nd = d.norm();
    angle += 2.0 * std::atan2(a.dot(b.cross(d)),
                              na * nb * nd + a.dot(b) * nd + a.dot(d) * nb + b.dot(d) * na);
  }
  return angle > 2.0 * std::numbers::pi;
}

bool is_held(const World& world, std::int32_t point) {
  const auto held = world.contacts.held();
  return std::any_of(held.begin(), held.end(), [&](const auto& h) { return h.point == point; });
}

// Grains from all sides into a block that trembles.
World bombarded(double speed, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Vec3> at, velocity;
  for (int i = 0; i < 200; ++i) {
    at.push_back(test::random_vector(random, 1.0).normalized() * (0.09 + 0.0002 * i));
    velocity.push_back(-speed * at.back().normalized() + test::random_vector(random, 0.3 * speed));
  }
  World world(
      {unbreakable_block({3, 3, 3}, kSpacing, Vec3::Constant(-0.03), 300.0), grains(at, velocity)});
  for (int p = 0; p < 64; ++p) {
    world.lattice.motion[p].velocity += test::random_vector(random, 10.0);
  }
  return world;
}

// Whoever is inside is held, and nobody else: no seam leaks, at any speed.
TEST(SurfaceContacts, HoldWhatIsInsideAndNothingElse) {
  for (double speed : {5.0, 150.0}) {
    World world = bombarded(speed, 7);
    const double dt = world.step_limit();
    int inside = 0;
    for (int look = 0; look < 120; ++look) {
      world.advance(1 + static_cast<int>(0.002 / (speed * dt)), dt);
      // Contacts know the positions before the last step: look where everything was then.
      Lattice then = world.lattice;
      for (PointMotion& m : then.motion) m.position -= dt * m.velocity;
      for (std::int32_t p = 64; p < 264; ++p) {
        const bool in = is_inside(then, then.motion[p].position);
        EXPECT_EQ(in, is_held(world, p)) << "grain " << p << " at " << speed << " m/s";
        inside += in;
      }
    }
    EXPECT_GT(inside, 20) << speed;
  }
}

// At a small step: the springs' own energy error is proportional to it.
TEST(SurfaceContacts, KeepMomentaAndGainNoEnergy) {
  for (double speed : {5.0, 50.0}) {
    World world = bombarded(speed, 8);
    for (int p = 0; p < 64; ++p) world.lattice.motion[p].velocity.setZero();
    const test::Totals before = test::totals(world.lattice);
    const double dt = 0.05 * world.step_limit();
    for (int look = 0; look < 10; ++look) {
      world.advance(static_cast<int>(0.02 / (speed * dt)), dt);
      const test::Totals now = test::totals(world.lattice);
      test::expect_same_momenta(before, now, 1e-13);
      EXPECT_LE(now.energy(), (1.0 + 1e-6) * before.energy());
    }
    EXPECT_LT(test::totals(world.lattice).momentum.norm(), 1.0);
  }
}

// A block slides on another one that is pinned: m a = -mu m g, and the energy falls.
TEST(SurfaceContacts, FrictionBrakesASlidingBlockByMuG) {
  constexpr double kFriction = 0.3, kGravity = 9.81;
  PhysicalModel table = unbreakable_block({14, 5, 1}, kSpacing, {0.0, 0.0, -kSpacing}, 100.0);
  for (PointAttributes& p : table.points) p.pinned = true;
  PhysicalModel slider = unbreakable_block({4, 3, 3}, 0.0125, {0.0231, 0.0147, 0.0}, 100.0);
  for (EdgeAttributes& e : slider.edges) e.damping = 0.3;
  table.object.friction = 1.0;
  slider.object.friction = kFriction;
  set_in_motion(slider, {1.0, 0.0, 0.0}, Vec3::Zero());
  World world({table, slider});
  world.gravity = {0.0, 0.0, -kGravity};
  const IdRange<PointId> points = world.lattice.objects[1].points;
  const auto sum_of = [&](auto value) {
    double sum = 0.0;
    for (std::int32_t p = points.begin; p < points.end; ++p) sum += value(p);
    return sum;
  };
  const auto speed = [&] {
    return sum_of([&](std::int32_t p) { return world.lattice.motion[p].velocity.x(); }) /
           static_cast<double>(points.size());
  };
  const auto energy = [&] {
    return test::totals(world.lattice).energy() + sum_of([&](std::int32_t p) {
             return kGravity * world.lattice.mass[p] * world.lattice.motion[p].position.z();
           });
  };
  const double dt = 0.5 * world.step_limit();
  const int steps = static_cast<int>(0.05 / dt);
  world.advance(steps, dt);
  const double at_first = speed();
  double last = energy();
  for (int i = 0; i < 10; ++i) {
    world.advance(steps / 10, dt);
    EXPECT_LT(energy(), last);
    last = energy();
  }
  const double time = 10 * (steps / 10) * dt;
  EXPECT_NEAR((at_first - speed()) / time, kFriction * kGravity, 0.02 * kFriction * kGravity);
}

// One grain against a block of 1 x 1 x 1 cell, 20 mm, held at its corners.
World one_grain(const Vec3& at, const Vec3& velocity) {
  PhysicalModel block = unbreakable_block({1, 1, 1}, kSpacing, Vec3::Zero(), 100.0);
  for (PointAttributes& p : block.points) p.pinned = true;
  return World({block, grains({at}, {velocity})});
}

constexpr std::int32_t kGrain = 8;

// 40 mm in a step, through the front and out of the back; it comes back the way it came.
TEST(SurfaceContacts, BringBackWhatPassesAPlateInOneStep) {
  World world = one_grain({0.008, 0.011, 0.025}, {0.0, 0.0, -100.0});
  world.advance(1, 4e-4);
  ASSERT_LT(world.lattice.motion[kGrain].position.z(), -0.01);
  world.advance(1, 4e-4);
  EXPECT_TRUE(is_held(world, kGrain));
  world.advance(20, 4e-4);
  EXPECT_GT(world.lattice.motion[kGrain].position.z(), 0.02);
  EXPECT_FALSE(is_held(world, kGrain));
}

TEST(SurfaceContacts, ReboundWithTheirRestitution) {
  for (double e : {1.0, 0.5}) {
    World world = one_grain({0.008, 0.011, 0.0201}, {0.0, 0.0, -3.0});
    for (LatticeObject& object : world.lattice.objects) {
      object.authored.object.restitution = std::sqrt(e);
    }
    // omega of the contact is 0.63 / dt: finer than the step of the springs would have it, the
    // speed differs by what a step at entry and exit makes.
    world.advance(400, 1e-6);
    EXPECT_NEAR(world.lattice.motion[kGrain].velocity.z(), 3.0 * e, 0.15 * 3.0);
    EXPECT_LE(world.lattice.motion[kGrain].velocity.z(), 3.0 * (1.0 + 1e-12));
    EXPECT_FALSE(is_held(world, kGrain));
  }
}

// Found inside, it has done nothing to be pushed for: it leaves at no more than 5 cm/s.
TEST(SurfaceContacts, EaseOutWhatIsInsideFromTheStart) {
  World world = one_grain({0.008, 0.011, 0.018}, Vec3::Zero());
  double fastest = 0.0;
  for (int n = 0; n < 100; ++n) {
    world.advance(20, 5e-5);
    fastest = std::max(fastest, world.lattice.motion[kGrain].velocity.norm());
  }
  EXPECT_GT(world.lattice.motion[kGrain].position.z(), 0.02);
  EXPECT_LE(fastest, 0.05 * (1.0 + 1e-9));
}

TEST(SurfaceContacts, ReleaseWhatBreaks) {
  World world = one_grain({0.008, 0.011, 0.0201}, {0.0, 0.0, -30.0});
  world.advance(6, 1e-6);
  ASSERT_TRUE(is_held(world, kGrain));
  break_edges(world.lattice.topology, world.lattice.breaking, std::array<std::int32_t, 1>{0});
  world.contacts.edges_broken();
  world.advance(1, 1e-6);
  EXPECT_FALSE(is_held(world, kGrain));
}

// Two bodies' points are their own engine's business.
TEST(SurfaceContacts, LeaveCarriedPiecesAlone) {
  World world = one_grain({0.008, 0.011, 0.0201}, {0.0, 0.0, -30.0});
  std::fill(world.lattice.role.begin(), world.lattice.role.end(), PointRole::kCarried);
  world.lattice.carrier.assign(world.lattice.motion.size(), 0);
  world.lattice.carrier[kGrain] = 1;
  rebuild_active(world.lattice);
  const Components pieces = components(world.lattice);
  world.contacts.refresh(world.lattice, pieces, true, true);
  for (int n = 0; n < 10; ++n) {
    world.contacts.add_forces(world.lattice, 1e-5);
    world.lattice.motion[kGrain].position.z() -= 3e-4;
  }
  EXPECT_TRUE(world.contacts.held().empty());
}

TEST(SurfaceContacts, GiveTheSameBitsTwice) {
  const auto run = [] {
    World world = bombarded(50.0, 9);
    world.advance(300, world.step_limit());
    return world.lattice;
  };
  const Lattice one = run(), two = run();
  for (std::size_t p = 0; p < one.motion.size(); ++p) {
    EXPECT_EQ(one.motion[p].position, two.motion[p].position);
    EXPECT_EQ(one.motion[p].velocity, two.motion[p].velocity);
  }
}

}  // namespace
}  // namespace limber

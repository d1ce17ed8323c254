#include "core/contact/cell_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "core/dynamics/spring_forces.h"
#include "core/operators/time_operator.h"
#include "tests/support/blocks.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

constexpr double kHuge = 1e9;  // of anything

// Springs and contacts within cells alone; symplectic Euler.
class World {
 public:
  explicit World(PhysicalModel model, bool contacts = true)
      : lattice(test::lattice_of({std::move(model)})),
        with_contacts_(contacts),
        springs_(lattice, SpringPrecision::kDouble) {
    springs_.active_changed();
  }

  void step(double dt) {
    for (std::int32_t p : lattice.dynamic_points) lattice.force[p] = load(p);
    springs_.add(dt);
    contacts.refresh(lattice, steps_++ == 0);
    if (with_contacts_) contacts.add_forces(lattice, dt);
    for (std::int32_t p : lattice.dynamic_points) {
      PointMotion& motion = lattice.motion[p];
      motion.velocity += dt * lattice.inverse_mass[p] * lattice.force[p];
      motion.position += dt * motion.velocity;
    }
  }

  // The least volume of a cell so far, as a share of what it was, while it runs for so long.
  double least_volume(double seconds, double dt) {
    double least = kHuge;
    for (double t = 0.0; t < seconds; t += dt) {
      step(dt);
      least = std::min(least, volume_now());
    }
    return least;
  }

  double volume_now() const {
    const PhysicalModel model = extract_model(lattice, 0);
    const GeometricModel& start = lattice.objects[0].authored.geometry;
    double least = kHuge;
    for (CellId c : ids_of(start.cells)) {
      least = std::min(least, cell_volume(model.geometry, c) / cell_volume(start, c));
    }
    return least;
  }

  Lattice lattice;
  CellContacts contacts;
  std::function<Vec3(std::int32_t)> load = [](std::int32_t) -> Vec3 { return Vec3::Zero(); };

 private:
  bool with_contacts_;
  SpringForces springs_;
  int steps_ = 0;
};

// Points of 1 kg, 1 m apart.
PhysicalModel soft_block(std::array<int, 3> cells, double stiffness) {
  PhysicalModel model = test::block({.cells = cells});
  for (EdgeAttributes& e : model.edges) {
    e.stiffness = stiffness;
    e.damping = 0.0;
    e.break_threshold = e.crush_threshold = kUnbreakable;
  }
  return model;
}

PhysicalModel tetrahedron(double stiffness) {
  GeometricModelBuilder builder;
  builder.begin_subobject("tetrahedron");
  const PointId a = builder.add_point({0.0, 0.0, 0.0}), b = builder.add_point({1.0, 0.0, 0.0}),
                c = builder.add_point({0.0, 1.0, 0.0}), d = builder.add_point({0.0, 0.0, 1.0});
  const std::array<std::array<PointId, 2>, 6> edges = {
      {{a, b}, {a, c}, {a, d}, {b, c}, {b, d}, {c, d}}};
  const std::array<std::array<PointId, 3>, 4> faces = {
      {{a, c, b}, {a, b, d}, {a, d, c}, {b, c, d}}};
  builder.add_cell(edges, faces);
  PhysicalModel model = test::with_plausible_attributes(builder.finish(), "tetrahedron");
  for (EdgeAttributes& e : model.edges) {
    e.stiffness = stiffness;
    e.damping = 0.0;
    e.break_threshold = e.crush_threshold = kUnbreakable;
  }
  return model;
}

// Downwards, of all points at this height.
void throw_down(Lattice& lattice, double height, double speed) {
  for (std::int32_t p : lattice.dynamic_points) {
    if (lattice.motion[p].position.z() == height) lattice.motion[p].velocity.z() -= speed;
  }
}

TEST(CellContacts, StopWhatWouldTurnACellInsideOut) {
  for (double speed : {0.2, 1.0, 2.5}) {  // up to a twentieth of the cell in a step
    World without(soft_block({1, 1, 1}, 1e-3), false), with(soft_block({1, 1, 1}, 1e-3));
    for (World* world : {&without, &with}) throw_down(world->lattice, 1.0, speed);
    EXPECT_LT(without.least_volume(2.0 / speed, 0.02), -0.5) << speed;
    EXPECT_GT(with.least_volume(2.0 / speed, 0.02), 0.05) << speed;
  }
}

TEST(CellContacts, HoldTetrahedraToo) {
  World without(tetrahedron(1e-3), false), with(tetrahedron(1e-3));
  for (World* world : {&without, &with}) throw_down(world->lattice, 1.0, 2.0);
  EXPECT_LT(without.least_volume(1.0, 0.01), -0.3);
  EXPECT_GT(with.least_volume(1.0, 0.01), 0.05);
}

TEST(CellContacts, KeepMomentaAndGainNoEnergy) {
  std::mt19937 random(1);
  for (int n = 0; n < 20; ++n) {
    World world(soft_block({2, 2, 2}, 10.0));
    for (PointMotion& m : world.lattice.motion) m.velocity = test::random_vector(random, 6.0);
    const test::Totals start = test::totals(world.lattice);
    bool pressed = false;
    double most = 0.0;
    for (int i = 0; i < 2000; ++i) {
      world.step(0.005);
      pressed = pressed || world.contacts.watched() > 0;
      most = std::max(most, test::totals(world.lattice).energy());
    }
    ASSERT_TRUE(pressed) << n;
    test::expect_same_momenta(start, test::totals(world.lattice), 1e-12);
    // Springs alone: symplectic Euler's energy swings by omega dt / 2, 1.2 % with omega = 5 rad/s.
    EXPECT_LT(most, 1.02 * start.energy()) << n;
  }
}

TEST(CellContacts, BearWhatCrushesTheSprings) {
  PhysicalModel model = soft_block({1, 1, 3}, 1.0);
  for (PointId p : ids_of(model.points)) {
    model.points[p].pinned = model.geometry.points[p].z() == 0.0;
  }
  World world(std::move(model));
  world.load = [&](std::int32_t p) -> Vec3 {
    const bool top = world.lattice.authored_position[p].z() == 3.0;
    // A little drag, for it to come to rest.
    return Vec3(0.0, 0.0, top ? -100.0 : 0.0) - 5.0 * world.lattice.motion[p].velocity;
  };
  world.least_volume(20.0, 0.01);
  EXPECT_GT(world.volume_now(), 0.05);
  // A tenth of what the load alone would make it in a step.
  for (const PointMotion& m : world.lattice.motion) EXPECT_LT(m.velocity.norm(), 0.1);
}

TEST(CellContacts, EaseOutWhatIsInsideOutFromTheStart) {
  PhysicalModel model = soft_block({1, 1, 1}, 1e-9);
  World world(std::move(model));
  for (PointMotion& m : world.lattice.motion) m.position.z() *= -0.3;  // 0.15 m behind the faces
  ASSERT_LT(world.volume_now(), 0.0);
  double most = 0.0;
  for (int i = 0; i < 2000; ++i) {
    world.step(0.01);
    most = std::max(most, test::totals(world.lattice).kinetic);
  }
  EXPECT_GT(world.volume_now(), 0.0);
  EXPECT_LT(most, 0.5 * 8.0 * 0.1 * 0.1);  // 8 kg, no faster than 0.1 m/s
  const test::Totals end = test::totals(world.lattice);
  EXPECT_LT(end.momentum.norm(), 1e-12);
  EXPECT_LT(end.angular_momentum.norm(), 1e-12);
}

TEST(CellContacts, LeaveAloneWhatKeepsItsShape) {
  World with(soft_block({3, 3, 3}, 1e3)), without(soft_block({3, 3, 3}, 1e3), false);
  for (World* world : {&with, &without}) {
    std::mt19937 random(2);
    for (PointMotion& m : world->lattice.motion) {
      m.position += test::random_vector(random, 0.03);
      m.velocity = Vec3(3.0, 0.0, 0.0) + Vec3(0.0, 0.0, 4.0).cross(m.position);
    }
    for (int i = 0; i < 1000; ++i) world->step(0.002);
  }
  EXPECT_EQ(with.contacts.watched(), 0u);
  for (std::size_t p = 0; p < with.lattice.motion.size(); ++p) {
    EXPECT_EQ(with.lattice.motion[p].position, without.lattice.motion[p].position);
  }
}

TEST(CellContacts, FlatCellsHaveNoInside) {
  World world(test::sheet(3, true));
  for (PointMotion& m : world.lattice.motion) m.position.x() *= 0.01;
  world.step(1e-6);
  EXPECT_EQ(world.contacts.watched(), 0u);
}

TEST(CellContacts, NorHaveBrokenOnes) {
  World world(soft_block({1, 1, 1}, 1e-3));
  world.lattice.breaking.cell_valid[0] = 0;
  throw_down(world.lattice, 1.0, 1.0);
  EXPECT_LT(world.least_volume(2.0, 0.02), -0.5);
}

// The time operator has them.
TEST(CellContacts, ActInTheTimeOperator) {
  Lattice lattice = test::lattice_of({soft_block({1, 1, 1}, 1e-3)});
  throw_down(lattice, 1.0, 2.0);
  TimeOperator time(lattice);
  time.advance(80, 0.02, kEmptySpace);
  const PhysicalModel after = extract_model(lattice, 0);
  EXPECT_GT(cell_volume(after.geometry, CellId(0)), 0.05);
}

}  // namespace
}  // namespace limber

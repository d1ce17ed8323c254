#include "core/contact/point_contacts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/lattices.h"

namespace limber {
namespace {

constexpr double kFrequency = 100.0;      // rad/s, of every contact
constexpr double kDistance = 2.0 * 0.45;  // m, at which two points of 1 m edges touch
constexpr double kStep = 1e-5;            // s, contact lasts 0.03 s

// Two free points, 1 m apart along y: an edge without stiffness gives them a contact radius.
PhysicalModel loose_pair(const Vec3& at, const Vec3& velocity, double mass = 1.0) {
  PhysicalModel model = test::chain(
      {.points = 2, .stiffness = 0.0, .mass = mass, .origin = at, .along = Vec3::UnitY()});
  model.object.restitution = 1.0;
  model.object.friction = 0.0;
  for (PointAttributes& p : model.points) p.velocity = velocity;
  return model;
}

Lattice with_contact_frequency(Lattice lattice) {
  for (LatticeObject& object : lattice.objects) object.contact_frequency = kFrequency;
  return lattice;
}

void clear_forces(Lattice& lattice) {
  for (Vec3& force : lattice.force) force.setZero();
}

void move(Lattice& lattice, double dt) {
  for (std::size_t p = 0; p < lattice.motion.size(); ++p) {
    lattice.motion[p].velocity += lattice.force[p] * (dt / lattice.mass[p]);
    lattice.motion[p].position += lattice.motion[p].velocity * dt;
  }
}

void simulate(Lattice& lattice, double seconds) {
  PointContacts contacts;
  const Components pieces = components(lattice);
  for (int n = 0; n * kStep < seconds; ++n) {
    contacts.refresh(lattice, pieces, n == 0, false);
    clear_forces(lattice);
    contacts.add_forces(lattice);
    move(lattice, kStep);
  }
}

// A resting pair of 3 kg points is hit by one of 1 kg points that comes along x.
Lattice approaching(double restitution, double friction, const Vec3& velocity) {
  PhysicalModel runner = loose_pair({-1.0, 0.0, 0.0}, velocity, 1.0);
  PhysicalModel target = loose_pair({0.0, 0.0, 0.0}, Vec3::Zero(), 3.0);
  runner.object.restitution = restitution;
  runner.object.friction = target.object.friction = std::sqrt(friction);  // combined by product
  return with_contact_frequency(test::lattice_of({runner, target}));
}

TEST(PointContacts, ReboundWithTheirRestitutionAndKeepTheMomentum) {
  for (double e : {1.0, 0.5, 0.2}) {
    Lattice lattice = approaching(e, 0.0, {2.0, 0.0, 0.0});
    const test::Totals before = test::totals(lattice);
    simulate(lattice, 0.4);  // leaving takes 1 / e times as long as coming in
    const double separation = lattice.motion[2].velocity.x() - lattice.motion[0].velocity.x();
    EXPECT_NEAR(separation, 2.0 * e, 5e-3) << "restitution " << e;
    test::expect_same_momenta(before, test::totals(lattice), 1e-13);
  }
}

// Elastic, 1 kg on 3 kg: v1' = (1 - 3) / 4 v, v2' = 2 / 4 v.
TEST(PointContacts, ExchangeVelocitiesAsTheirMassesDemand) {
  Lattice lattice = approaching(1.0, 0.0, {2.0, 0.0, 0.0});
  simulate(lattice, 0.15);
  EXPECT_NEAR(lattice.motion[0].velocity.x(), -1.0, 1e-3);
  EXPECT_NEAR(lattice.motion[2].velocity.x(), 1.0, 1e-3);
}

// Their force is along the line between them, whatever friction the objects have against the
// ground: across it, a contact distance apart, it would be a couple.
TEST(PointContacts, OfObliquelyMovingPointsKeepTheAngularMomentum) {
  Lattice lattice = approaching(1.0, 0.1, {2.0, 0.0, 0.5});
  const test::Totals before = test::totals(lattice);
  simulate(lattice, 0.13);
  test::expect_same_momenta(before, test::totals(lattice), 1e-13);
}

double push_on(const Lattice& lattice, std::size_t point) { return lattice.force[point].norm(); }

void add_forces_anew(const PointContacts& contacts, Lattice& lattice) {
  clear_forces(lattice);
  contacts.add_forces(lattice);
}

TEST(PointContacts, PushPointsApartByTheirOverlap) {
  Lattice lattice = with_contact_frequency(test::lattice_of(
      {loose_pair({-1.0, 0.0, 0.0}, Vec3::Zero()), loose_pair(Vec3::Zero(), Vec3::Zero())}));
  PointContacts contacts;
  contacts.refresh(lattice, components(lattice), true, false);
  lattice.motion[0].position.x() = -0.8;  // 0.1 m inside
  add_forces_anew(contacts, lattice);
  // k = omega^2 m_red = 1e4 * 0.5, by 0.1 m.
  EXPECT_NEAR(lattice.force[0].x(), -500.0, 1e-9);
  EXPECT_NEAR(lattice.force[2].x(), 500.0, 1e-9);
  EXPECT_EQ(lattice.touched[0], 1);
  EXPECT_EQ(lattice.touched[1], 0);
}

TEST(PointContacts, JoinedPointsDoNotRepel) {
  Lattice lattice = with_contact_frequency(test::lattice_of({test::chain({.points = 2})}));
  PointContacts contacts;
  contacts.refresh(lattice, components(lattice), true, false);
  lattice.motion[1].position.x() = 0.2;
  add_forces_anew(contacts, lattice);
  EXPECT_EQ(push_on(lattice, 0), 0.0);
}

// Runs for 6 s at a step of 0.3 / omega_c; returns the fastest speed of the last second.
double run_loaded(Lattice& lattice, std::int32_t top, double load) {
  constexpr double kLongStep = 0.3 / kFrequency;
  PointContacts contacts;
  const Components pieces = components(lattice);
  double fastest = 0.0;
  for (int n = 0; n * kLongStep < 6.0; ++n) {
    contacts.refresh(lattice, pieces, n == 0, false);
    clear_forces(lattice);
    lattice.force[top].y() = -load;
    contacts.bear(lattice, kLongStep);
    for (std::size_t p = 0; p < lattice.motion.size(); ++p) {
      lattice.motion[p].velocity += lattice.force[p] * (kLongStep * lattice.inverse_mass[p]);
      lattice.motion[p].position += lattice.motion[p].velocity * kLongStep;
      if (n * kLongStep > 5.0) fastest = std::max(fastest, lattice.motion[p].velocity.norm());
    }
  }
  return fastest;
}

// Single points, one on the other, the lowest pinned.
Lattice pillar(int points) {
  std::vector<PhysicalModel> models;
  for (int i = 0; i < points; ++i) {
    PhysicalModel grain = test::chain({.points = 1, .origin = {0.0, 1.01 * kDistance * i, 0.0}});
    grain.object.particle_radius = 0.5 * kDistance;
    grain.object.restitution = 0.0;
    grain.points[PointId(0)].pinned = i == 0;
    models.push_back(grain);
  }
  return with_contact_frequency(test::lattice_of(models));
}

// With k d while they approach and e^2 k d while they separate they would tremble for ever.
TEST(PointContacts, BearALoadWithoutTrembling) {
  constexpr double kLoad = 25.0;  // N: 5 mm deep, so that it comes to rest within 0.1 s or so
  for (int points : {2, 3, 6}) {
    Lattice lattice = pillar(points);
    EXPECT_LT(run_loaded(lattice, points - 1, kLoad), 1e-6) << points << " points";
    const double depth = kLoad / (kFrequency * kFrequency * 0.5);
    for (int i = 1; i < points; ++i) {
      const Vec3 apart = lattice.motion[i].position - lattice.motion[i - 1].position;
      EXPECT_NEAR(kDistance - apart.y(), depth, 1e-5) << points << " points, contact " << i;
    }
  }
}

// As by add_forces(), but that what separates slowly is let out slowly.
TEST(PointContacts, ThatBearGiveBackTheirRestitution) {
  for (double e : {1.0, 0.5, 0.2}) {
    Lattice lattice = approaching(e, 0.0, {2.0, 0.0, 0.0});
    const test::Totals before = test::totals(lattice);
    PointContacts contacts;
    const Components pieces = components(lattice);
    for (int n = 0; n * kStep < 0.4; ++n) {
      contacts.refresh(lattice, pieces, n == 0, false);
      clear_forces(lattice);
      contacts.bear(lattice, kStep);
      move(lattice, kStep);
    }
    const double separation = lattice.motion[2].velocity.x() - lattice.motion[0].velocity.x();
    EXPECT_NEAR(separation, 2.0 * e, 0.05) << "restitution " << e;
    test::expect_same_momenta(before, test::totals(lattice), 1e-13);
  }
}

// Three points around a right angle; the ends are 1.56 m apart and not joined.
PhysicalModel folded_chain() {
  PhysicalModel model = test::chain({.points = 3});
  model.geometry.points[PointId(0)] = Vec3(1.0, 0.0, 1.2);
  model.edges[EdgeId(0)].rest_length = 1.2;
  model.geometry.points[PointId(2)] = Vec3(2.0, 0.0, 0.0);
  model.object.restitution = 1.0;
  return model;
}

// Its ends are folded onto each other.
TEST(PointContacts, PointsOfOnePieceThatAreNotJoinedRepel) {
  Lattice lattice = with_contact_frequency(test::lattice_of({folded_chain()}));
  const double distance = lattice.contact_radius[0] + lattice.contact_radius[2];  // 0.99 m
  PointContacts contacts;
  contacts.refresh(lattice, components(lattice), true, false);
  lattice.motion[0].position = Vec3(2.0, 0.0, distance - 0.1);
  add_forces_anew(contacts, lattice);
  EXPECT_NEAR(lattice.force[0].z(), 500.0, 1e-9);
  EXPECT_NEAR(lattice.force[2].z(), -500.0, 1e-9);
  EXPECT_EQ(push_on(lattice, 1), 0.0);
}

// The same two points just after the piece fell apart between them: still in contact, as before.
TEST(PointContacts, GoOnUnchangedWhenAPieceFallsApartBetweenThem) {
  Lattice lattice = with_contact_frequency(test::lattice_of({folded_chain()}));
  PointContacts contacts;
  contacts.refresh(lattice, components(lattice), true, false);
  lattice.motion[0].position =
      Vec3(2.0, 0.0, lattice.contact_radius[0] + lattice.contact_radius[2] - 0.1);
  const std::vector<std::int32_t> edge = {0};
  break_edges(lattice.topology, lattice.breaking, edge);
  for (int n = 0; n < 20; ++n) {
    contacts.refresh(lattice, components(lattice), n == 0, false);
    add_forces_anew(contacts, lattice);
    EXPECT_NEAR(lattice.force[2].z(), -500.0, 1e-9) << "refresh " << n;
  }
}

TEST(PointContacts, APairThatIsFoundOverlappingStartsWithoutForce) {
  Lattice lattice = with_contact_frequency(test::lattice_of(
      {loose_pair({-0.5, 0.0, 0.0}, Vec3::Zero()), loose_pair(Vec3::Zero(), Vec3::Zero())}));
  PointContacts contacts;
  const Components pieces = components(lattice);
  contacts.refresh(lattice, pieces, true, false);
  add_forces_anew(contacts, lattice);
  EXPECT_EQ(push_on(lattice, 0), 0.0);
  lattice.motion[0].position.x() = -0.4;  // deeper than it was found
  add_forces_anew(contacts, lattice);
  EXPECT_NEAR(lattice.force[0].x(), -500.0, 1e-9);
}

TEST(PointContacts, APairThatWasFoundOverlappingGrowsBackAsItSeparates) {
  Lattice lattice = with_contact_frequency(test::lattice_of(
      {loose_pair({-0.5, 0.0, 0.0}, Vec3::Zero()), loose_pair(Vec3::Zero(), Vec3::Zero())}));
  PointContacts contacts;
  const Components pieces = components(lattice);
  for (double distance : {0.5, 0.95, 1.5, 0.8}) {  // each step is over half of the list's skin or
    lattice.motion[0].position.x() = -distance;    // has been listed by then
    lattice.motion[1].position.x() = -distance;
    contacts.refresh(lattice, pieces, distance == 0.5 || distance == 1.5, false);
  }
  add_forces_anew(contacts, lattice);
  EXPECT_NEAR(lattice.force[0].x(), -5000.0 * (kDistance - 0.8), 1e-9);
}

// A ring of four points: without one edge its ends are still of one piece.
Lattice ring() {
  GeometricModelBuilder builder;
  builder.begin_subobject("ring");
  PointId p[4];
  for (int i = 0; i < 4; ++i) p[i] = builder.add_point(Vec3(i == 1 || i == 2, i / 2, 0.0));
  for (int i = 0; i < 4; ++i) builder.edge(p[i], p[(i + 1) % 4]);
  PhysicalModel model = with_default_attributes(builder.finish(), "ring");
  for (PointAttributes& point : model.points) point.mass = 1.0;
  for (EdgeAttributes& edge : model.edges) edge.stiffness = 1.0;
  model.object.restitution = 1.0;
  return with_contact_frequency(test::lattice_of({model}));
}

void break_edge(Lattice& lattice, PointContacts& contacts, std::int32_t edge) {
  const std::vector<std::int32_t> edges = {edge};
  break_edges(lattice.topology, lattice.breaking, edges);
  contacts.edges_broken(lattice, edges);
}

// From the next sum of forces on, before and after the next refresh.
TEST(PointContacts, EndsOfABrokenEdgeRepel) {
  Lattice lattice = ring();
  PointContacts contacts;
  contacts.refresh(lattice, components(lattice), true, false);
  const std::size_t listed = contacts.size();
  break_edge(lattice, contacts, 0);
  EXPECT_EQ(contacts.size(), listed + 1);
  lattice.motion[0].position.x() = 0.2;
  for (int n = 0; n < 2; ++n) {
    add_forces_anew(contacts, lattice);
    // k = omega^2 m_red = 1e4 * 0.5, by 0.1 m below 0.9 m.
    EXPECT_NEAR(lattice.force[0].x(), -500.0, 1e-9);
    EXPECT_NEAR(lattice.force[1].x(), 500.0, 1e-9);
    contacts.refresh(lattice, components(lattice), false, false);
    EXPECT_EQ(contacts.size(), listed + 1);
  }
}

TEST(PointContacts, EndsOfAnEdgeThatBrokeSquashedStartWithoutForce) {
  Lattice lattice = ring();
  PointContacts contacts;
  contacts.refresh(lattice, components(lattice), true, false);
  lattice.motion[0].position.x() = 0.4;
  break_edge(lattice, contacts, 0);
  add_forces_anew(contacts, lattice);
  EXPECT_EQ(push_on(lattice, 0), 0.0);
  lattice.motion[0].position.x() = 0.5;
  add_forces_anew(contacts, lattice);
  EXPECT_NEAR(lattice.force[0].x(), -500.0, 1e-9);
}

// Told of a break that made two pieces of one: the pair moves to the list between pieces.
TEST(PointContacts, EndsOfABrokenEdgeAreListedOnceWhenItsPieceFellApart) {
  Lattice lattice = with_contact_frequency(test::lattice_of({test::chain({.points = 2})}));
  PointContacts contacts;
  contacts.refresh(lattice, components(lattice), true, false);
  break_edge(lattice, contacts, 0);
  for (int n = 0; n < 8; ++n) {
    contacts.refresh(lattice, components(lattice), n == 0, false);
    EXPECT_EQ(contacts.size(), 1u) << "refresh " << n;
  }
}

TEST(PointContacts, BreaksBeforeTheFirstListingAreFoundByIt) {
  Lattice lattice = ring();
  PointContacts contacts;
  break_edge(lattice, contacts, 0);
  contacts.refresh(lattice, components(lattice), true, false);
  EXPECT_EQ(contacts.size(), 3u);  // two diagonals and the pair
}

// ---------------------------------------------------------------------------------------------

// All pairs of different objects in ascending order, so that sums of forces round alike.
void add_forces_of_all_pairs(Lattice& lattice) {
  const auto n = static_cast<std::int32_t>(lattice.motion.size());
  for (std::int32_t a = 0; a < n; ++a) {
    for (std::int32_t b = a + 1; b < n; ++b) {
      const Vec3 d = lattice.motion[b].position - lattice.motion[a].position;
      if (lattice.point_object[a] == lattice.point_object[b] || d.norm() >= kDistance) continue;
      const double reduced =
          lattice.mass[a] * lattice.mass[b] / (lattice.mass[a] + lattice.mass[b]);
      const Vec3 push = kFrequency * kFrequency * reduced * (kDistance - d.norm()) * d.normalized();
      lattice.force[a] -= push;
      lattice.force[b] += push;
    }
  }
}

Lattice gas(double speed) {
  std::mt19937 random(41);
  std::vector<PhysicalModel> models;
  for (int x = 0; x < 5; ++x)
    for (int y = 0; y < 2; ++y)
      for (int z = 0; z < 3; ++z) {
        const Vec3 at = Vec3(1.3 * x, 2.6 * y, 1.3 * z) + test::random_vector(random, 0.15);
        const Vec3 inwards = speed * (Vec3(2.6, 1.3, 1.3) - at).normalized();
        models.push_back(loose_pair(at, inwards + test::random_vector(random, 0.3 * speed)));
      }
  return with_contact_frequency(test::lattice_of(models));
}

double largest_distance(const Lattice& a, const Lattice& b) {
  double largest = 0.0;
  for (std::size_t p = 0; p < a.motion.size(); ++p) {
    largest = std::max(largest, (a.motion[p].position - b.motion[p].position).norm());
  }
  return largest;
}

// Steps of up to 3 cm against a skin of 90 cm: the list is made anew several times.
TEST(PointContacts, ListMissesNothingHoweverPointsFly) {
  for (double speed : {1.0, 10.0, 60.0}) {
    Lattice listed = gas(speed), all = listed;
    const Lattice start = listed;
    PointContacts contacts;
    const Components pieces = components(listed);
    const double dt = 5e-4;
    for (int n = 0; n < 300; ++n) {
      contacts.refresh(listed, pieces, n == 0, false);
      clear_forces(listed);
      clear_forces(all);
      contacts.add_forces(listed);
      add_forces_of_all_pairs(all);
      move(listed, dt);
      move(all, dt);
    }
    EXPECT_GT(largest_distance(listed, start), 0.1 * speed * 0.15);
    EXPECT_LE(largest_distance(listed, all), 1e-9) << "speed " << speed;
  }
}

}  // namespace
}  // namespace limber

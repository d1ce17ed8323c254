// The paper's promise (section 3): "Preserving the structure during simulation enables us to use
// the output of the simulator as input to a new simulation. It also enables us to modify this new
// structure in the geometric or physical attribute modeller."

#include <gtest/gtest.h>

#include <algorithm>

#include "core/model/validate.h"
#include "core/modeller/cubic_lattice.h"
#include "core/operators/boundary_operator.h"
#include "core/operators/gluing_operator.h"
#include "core/operators/time_operator.h"
#include "tests/support/lattices.h"
#include "tests/support/measure.h"

namespace limber {
namespace {

const Environment kFalling{.gravity = {0.0, -9.81, 0.0}, .air = {}, .ground = {}};
constexpr double kBreakStrain = 0.02;

PhysicalModel part(std::array<int, 3> points, const Vec3& origin, const std::string& name,
                   double temperature) {
  PhysicalModel model = cubic_lattice({.points = points,
                                       .spacing = 0.1,
                                       .origin = origin,
                                       .springs = {4000.0, 2000.0, 1000.0},
                                       .mass = 0.05,
                                       .damping_per_stiffness = 1e-5,
                                       .name = name});
  model.parts[0].values["temperature"] = temperature;
  return model;
}

// A mast with a sail of squares glued on, breakable, its upper half thrown aside: x is along.
PhysicalModel ship() {
  PhysicalModel model = glue(part({8, 3, 3}, {0.0, 0.0, 0.0}, "mast", 290.0),
                             part({4, 4, 1}, {0.2, 0.25, 0.1}, "sail", 285.0),
                             {.distance = 0.06, .stiffness = 4000.0, .break_strain = kBreakStrain})
                            .model;
  model.parts[1].surface.colour = Vec3(0.9, 0.1, 0.1);
  for (EdgeAttributes& e : model.edges) e.break_threshold = kBreakStrain * e.rest_length;
  for (PointId p : ids_of(model.points)) {
    const double x = model.geometry.points[p].x();
    model.points[p].velocity = Vec3(x > 0.35 ? 1.5 : -1.0, 0.3, 0.2 * x);
  }
  return model;
}

void advance(Lattice& lattice, int substeps, const Environment& environment) {
  TimeOperator time(lattice);
  time.advance(substeps, 0.25 * time.largest_step(), environment);
}

// Simulated until something has broken, but not everything.
Lattice broken_ship() {
  Lattice lattice = test::lattice_of({ship()});
  advance(lattice, 600, kEmptySpace);
  return lattice;
}

std::size_t broken_edges(const PhysicalModel& m) {
  return static_cast<std::size_t>(std::count_if(m.edges.begin(), m.edges.end(),
                                                [](const EdgeAttributes& e) { return e.broken; }));
}

test::Totals totals_of(const PhysicalModel& model) {
  return test::totals(test::lattice_of({model}));
}

void expect_valid(const PhysicalModel& m) {
  const std::vector<Diagnostic> found = validate(m);
  EXPECT_TRUE(found.empty()) << found.front().text();
}

// Rest lengths, thresholds, names, ranges and everything that belongs to a part, as authored: they
// begin `m`, whatever was glued behind them.
void expect_same_structure(const PhysicalModel& authored, const PhysicalModel& m) {
  for (EdgeId e : ids_of(authored.edges)) {
    EXPECT_EQ(m.edges[e].rest_length, authored.edges[e].rest_length);
    EXPECT_EQ(m.edges[e].break_threshold, authored.edges[e].break_threshold);
    EXPECT_EQ(m.edges[e].stiffness, authored.edges[e].stiffness);
  }
  for (std::size_t i = 0; i < authored.parts.size(); ++i) {
    const Subobject &was = authored.geometry.subobjects[i], &is = m.geometry.subobjects[i];
    EXPECT_EQ(is.name, was.name);
    EXPECT_TRUE(is.points == was.points && is.edges == was.edges && is.faces == was.faces &&
                is.cells == was.cells);
    EXPECT_EQ(m.parts[i].values, authored.parts[i].values);
    EXPECT_EQ(m.parts[i].surface.colour, authored.parts[i].surface.colour);
  }
}

// What was broken in `before` still is in `after`, edge by edge and cell by cell.
void expect_still_broken(const PhysicalModel& before, const PhysicalModel& after) {
  for (EdgeId e : ids_of(before.edges))
    if (before.edges[e].broken) {
      EXPECT_TRUE(after.edges[e].broken) << "edge " << e.value;
    }
  for (CellId c : ids_of(before.cells))
    if (!before.cells[c].valid) {
      EXPECT_FALSE(after.cells[c].valid) << "cell " << c.value;
    }
}

TEST(Pipeline, SimulationBreaksTheShipOnlyInPart) {
  const PhysicalModel m = extract_model(broken_ship(), 0);
  EXPECT_GT(broken_edges(m), 20u);
  EXPECT_LT(broken_edges(m), m.edges.size() / 2);
  EXPECT_GT(test::topology_counts(m).at("components_by_edges"), 1);
}

TEST(Pipeline, ASimulatedModelIsAModelAgain) {
  const Lattice lattice = broken_ship();
  const PhysicalModel m = extract_model(lattice, 0);
  expect_valid(m);
  expect_same_structure(ship(), m);
  const test::Totals inside = test::totals(lattice), outside = totals_of(m);
  EXPECT_EQ(outside.momentum, inside.momentum);
  EXPECT_EQ(outside.angular_momentum, inside.angular_momentum);
  EXPECT_EQ(outside.energy(), inside.energy());
  test::expect_same_momenta(totals_of(ship()), outside, 1e-12);
  const auto& external = lattice.breaking.face_external;
  EXPECT_EQ(boundary(m).triangles.size(),
            static_cast<std::size_t>(std::count(external.begin(), external.end(), 1)));
}

// Taken out and put back in, it goes on as if it had stayed, to the last bit. Without contact,
// whose lists are as old as the simulation.
TEST(Pipeline, GoesOnAsIfItHadStayed) {
  PhysicalModel model = ship();
  model.object.contact_share = 0.0;
  Lattice stayed = test::lattice_of({model});
  TimeOperator time(stayed);
  const double dt = 0.25 * time.largest_step();
  time.advance(320, dt, kFalling);
  Lattice put_back = test::lattice_of({extract_model(stayed, 0)});
  time.advance(320, dt, kFalling);
  TimeOperator(put_back).advance(320, dt, kFalling);
  for (std::size_t p = 0; p < stayed.motion.size(); ++p) {
    EXPECT_EQ(put_back.motion[p].position, stayed.motion[p].position);
    EXPECT_EQ(put_back.motion[p].velocity, stayed.motion[p].velocity);
  }
  EXPECT_EQ(put_back.breaking.edge_broken, stayed.breaking.edge_broken);
  EXPECT_EQ(put_back.breaking.cell_valid, stayed.breaking.cell_valid);
  EXPECT_EQ(put_back.breaking.face_external, stayed.breaking.face_external);
}

// In the attribute modeller: a heavier, warmer, blue mast.
PhysicalModel refitted(PhysicalModel m) {
  const Subobject& mast = m.geometry.subobjects[0];
  for (std::int32_t p = mast.points.begin; p < mast.points.end; ++p)
    m.points[PointId(std::size_t(p))].mass *= 3.0;
  m.parts[0].surface.colour = Vec3(0.1, 0.2, 0.8);
  m.parts[0].values["temperature"] = 400.0;
  return m;
}

// A hull below the mast's first point, wherever the simulation has left that, with its velocity.
GlueResult with_hull(const PhysicalModel& m) {
  PhysicalModel hull = part({4, 2, 3}, Vec3::Zero(), "hull", 280.0);
  hull.parts[0].surface.transparency = 0.5;
  place(hull, Mat3::Identity(), m.geometry.points[PointId(0)] + Vec3(-0.15, -0.16, -0.1));
  set_in_motion(hull, m.points[PointId(0)].velocity, Vec3::Zero());
  return glue(m, hull, {.distance = 0.1, .stiffness = 4000.0});
}

TEST(Pipeline, EditingAndGluingKeepTheBooks) {
  const PhysicalModel m = extract_model(broken_ship(), 0);
  const PhysicalModel edited = refitted(m);
  expect_valid(edited);
  EXPECT_NEAR(total_mass(edited) - total_mass(m), 2.0 * 72 * 0.05, 1e-12);
  EXPECT_EQ(broken_edges(edited), broken_edges(m));
  const GlueResult glued = with_hull(edited);
  expect_valid(glued.model);
  EXPECT_GT(glued.bonds, 0u);
  expect_same_structure(edited, glued.model);
  expect_still_broken(m, glued.model);
  EXPECT_EQ(broken_edges(glued.model), broken_edges(m));
  EXPECT_EQ(glued.model.geometry.subobjects[3].name, "hull");
  EXPECT_EQ(glued.model.parts[3].surface.transparency, 0.5);
  EXPECT_EQ(glued.model.parts[0].surface.colour, Vec3(0.1, 0.2, 0.8));
  EXPECT_NEAR(total_mass(glued.model) - total_mass(edited), 24 * 0.05, 1e-12);
}

// Springs and contacts add up to nothing: with gravity alone P grows by M g t, whatever breaks.
TEST(Pipeline, SimulatedOnUnderGravity) {
  const PhysicalModel before = with_hull(refitted(extract_model(broken_ship(), 0))).model;
  Lattice lattice = test::lattice_of({before});
  const test::Totals start = test::totals(lattice);
  TimeOperator time(lattice);
  const double dt = 0.25 * time.largest_step();
  constexpr int kSteps = 2000;
  time.advance(kSteps, dt, kFalling);
  const PhysicalModel after = extract_model(lattice, 0);
  expect_valid(after);
  expect_same_structure(before, after);
  expect_still_broken(before, after);
  const Vec3 gained = test::totals(lattice).momentum - start.momentum;
  const Vec3 wanted = total_mass(before) * kFalling.gravity * (kSteps * dt);
  EXPECT_LT((gained - wanted).norm(), 1e-12 * (wanted.norm() + start.momentum_scale));
  // About the centre of mass gravity has no torque.
  const auto spin = [](const PhysicalModel& m) {
    const test::Totals t = totals_of(m);
    return Vec3(t.angular_momentum - centre_of_mass(m).cross(t.momentum));
  };
  EXPECT_LT((spin(after) - spin(before)).norm(), 1e-11 * start.angular_momentum_scale);
}

// rho A / 2 C_N |u_N| u_N summed over the triangles that the boundary operator shows, those at the
// fracture among them.
Vec3 pressure_on(const SurfaceModel& surface, const PhysicalModel& m, const Vec3& wind,
                 double density, double coefficient) {
  Vec3 force = Vec3::Zero();
  for (const SurfaceTriangle& t : surface.triangles) {
    const auto& c = t.corners;
    const Vec3 area = 0.5 * (surface.points[c[1]] - surface.points[c[0]])
                                .cross(surface.points[c[2]] - surface.points[c[0]]);
    Vec3 velocity = Vec3::Zero();
    for (int corner : c) velocity += m.points[surface.source_point[corner]].velocity / 3.0;
    const double along = (wind - velocity).dot(area.normalized());
    force += 0.5 * density * coefficient * std::abs(along) * along * area;
  }
  return force;
}

// Later the wind comes up. The first step's gain of momentum is the force on what is seen.
TEST(Pipeline, ThenInTheWind) {
  PhysicalModel m = extract_model(broken_ship(), 0);
  for (FaceAttributes& face : m.faces) face.normal_drag = 1.2;
  const SurfaceModel surface = boundary(m);
  EXPECT_TRUE(std::any_of(surface.triangles.begin(), surface.triangles.end(),
                          [](const SurfaceTriangle& t) { return t.exposed_by_breaking; }));
  const Vec3 wind(4.0, 1.0, -15.0);
  Environment windy = kFalling;
  windy.air = Air{.density = 1.225, .wind = {{uniform_flow(wind)}}};
  Lattice lattice = test::lattice_of({m});
  TimeOperator time(lattice);
  const Vec3 start = test::totals(lattice).momentum;
  constexpr double kStep = 1e-6;
  time.advance(1, kStep, windy);
  const Vec3 force = (test::totals(lattice).momentum - start) / kStep;
  const Vec3 wanted = total_mass(m) * kFalling.gravity + pressure_on(surface, m, wind, 1.225, 1.2);
  EXPECT_LT((force - wanted).norm(), 1e-7 * wanted.norm());
  time.advance(2000, 0.25 * time.largest_step(), windy);
  const PhysicalModel after = extract_model(lattice, 0);
  expect_valid(after);
  expect_same_structure(m, after);
  expect_still_broken(m, after);
  EXPECT_LT(test::totals(lattice).momentum.z(), start.z());
}

}  // namespace
}  // namespace limber

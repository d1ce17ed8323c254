#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <optional>

#include "core/model/validate.h"
#include "core/modeller/cubic_lattice.h"
#include "core/operators/boundary_operator.h"
#include "core/operators/breaking_operator.h"
#include "core/operators/gluing_operator.h"
#include "tests/property/generators.h"
#include "tests/support/measure.h"

// Objects of any dimension go through the operators in any order. After each of them the model
// fulfils all invariants and has the mass, the momenta and the parts that it has to have.

namespace limber {
namespace {

using test::angular_momentum;
using test::coin;
using test::momentum;
using test::random_vector;
using test::try_to_glue;
using test::uniform;

// Particles, ropes and sheets as often as blocks; families of springs as they come.
PhysicalModel random_object(const std::string& name) {
  CubicLattice wanted;
  wanted.name = name;
  wanted.spacing = uniform(0.2, 1.0);
  for (int& n : wanted.points) n = coin() ? 1 : *rc::gen::inRange(2, 5);
  wanted.springs = {coin() ? 90.0 : 0.0, coin() ? 60.0 : 0.0, coin() ? 30.0 : 0.0};
  wanted.surface = coin() ? CubicSurface::kShared : CubicSurface::kUniform;
  wanted.mass = uniform(0.1, 3.0);
  PhysicalModel model = cubic_lattice(wanted);
  model.parts[0].values["temperature"] = uniform(0.0, 1000.0);
  for (PointAttributes& p : model.points) p.velocity = random_vector(2.0);
  return model;
}

// What the operators must hand on.
struct Books {
  double mass = 0.0;
  Vec3 momentum, angular_momentum;
  std::vector<std::pair<std::string, double>> parts;  // name, temperature; none for glue
};

double temperature(const SubobjectAttributes& part) {
  const auto found = part.values.find("temperature");
  return found == part.values.end() ? -1.0 : found->second;
}

Books books_of(const PhysicalModel& m) {
  Books books{0.0, momentum(m), angular_momentum(m), {}};
  for (const PointAttributes& p : m.points) books.mass += p.mass;
  for (std::size_t i = 0; i < m.parts.size(); ++i)
    books.parts.push_back({m.geometry.subobjects[i].name, temperature(m.parts[i])});
  return books;
}

// 1e-10 of magnitudes up to some thousands of kg m^2/s: rounding of sums over a few hundred points.
void require_kept(const PhysicalModel& m, const Books& wanted) {
  const Books found = books_of(m);
  RC_ASSERT(validate(m).empty());
  RC_ASSERT(std::abs(found.mass - wanted.mass) < 1e-10);
  RC_ASSERT((found.momentum - wanted.momentum).norm() < 1e-9);
  RC_ASSERT((found.angular_momentum - wanted.angular_momentum).norm() < 1e-8);
  RC_ASSERT(found.parts == wanted.parts);
}

std::size_t broken_edges(const PhysicalModel& m) {
  return static_cast<std::size_t>(std::count_if(m.edges.begin(), m.edges.end(),
                                                [](const EdgeAttributes& e) { return e.broken; }));
}

// Moves and weighs nothing, to the last bit.
void break_some(PhysicalModel& m) {
  const Vec3 before = momentum(m);
  const std::size_t broken = broken_edges(m);
  const std::vector<EdgeId> edges = test::ids(test::random_edges(m));
  const BreakingResult result = break_edges(m, edges);
  for (EdgeId e : edges) RC_ASSERT(m.edges[e].broken);
  RC_ASSERT(broken_edges(m) - broken == result.broken_edges.size());
  RC_ASSERT(momentum(m) == before);
}

Mat3 random_rotation() {
  const Vec3 axis = random_vector(1.0) + Vec3(0.0, 0.0, 1.5);
  return Eigen::AngleAxisd(uniform(0.0, 2.0 * std::numbers::pi), axis.normalized()).matrix();
}

// x -> R x + t: L about the origin -> R L + t x R P.
void place_somewhere(PhysicalModel& m, Books& books) {
  const Mat3 rotation = random_rotation();
  const Vec3 shift = random_vector(3.0);
  place(m, rotation, shift);
  books.momentum = rotation * books.momentum;
  books.angular_momentum = rotation * books.angular_momentum + shift.cross(books.momentum);
}

int boundary_euler(const PhysicalModel& m) {
  return test::topology_counts(m).at("boundary_euler_V_E_F");
}

// The other object starts beside any point of the model.
void glue_another(PhysicalModel& m, Books& books, int number) {
  PhysicalModel other = random_object("object " + std::to_string(number));
  if (coin()) break_edges(other, test::ids(test::random_edges(other)));
  const PointId at(*rc::gen::inRange<std::size_t>(0, m.points.size()));
  place(other, random_rotation(), m.geometry.points[at] + random_vector(0.5));
  const GlueBond bond{.distance = uniform(0.2, 2.0), .stiffness = 20.0, .one_to_one = coin()};
  const std::optional<GlueResult> glued = try_to_glue(m, other, bond);
  RC_CLASSIFY(glued.has_value(), "glued");
  if (!glued) return;
  const Books added = books_of(other);
  books.mass += added.mass;
  books.momentum += added.momentum;
  books.angular_momentum += added.angular_momentum;
  books.parts.insert(books.parts.end(), added.parts.begin(), added.parts.end());
  books.parts.push_back({"glue: " + m.name + " + " + other.name, -1.0});
  RC_ASSERT(boundary_euler(glued->model) == boundary_euler(m) + boundary_euler(other));
  m = glued->model;
}

void push(PhysicalModel& m, Books& books) {
  const Vec3 velocity = random_vector(2.0), centre = centre_of_mass(m);
  set_in_motion(m, velocity, Vec3::Zero());
  books.momentum += books.mass * velocity;
  books.angular_momentum += centre.cross(books.mass * velocity);
}

RC_GTEST_PROP(PipelineProperty, OperatorsInAnyOrderKeepTheModelSound, ()) {
  PhysicalModel model = random_object("object 0");
  Books books = books_of(model);
  const int steps = *rc::gen::inRange(1, 7);
  for (int i = 1; i <= steps; ++i) {
    switch (*rc::gen::inRange(0, 4)) {
      case 0:
        break_some(model);
        break;
      case 1:
        glue_another(model, books, i);
        break;
      case 2:
        place_somewhere(model, books);
        break;
      default:
        push(model, books);
        break;
    }
    require_kept(model, books);
  }
}

}  // namespace
}  // namespace limber

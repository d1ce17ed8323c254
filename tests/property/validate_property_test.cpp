#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

#include "core/model/validate.h"
#include "core/operators/breaking_operator.h"
#include "tests/support/blocks.h"

// validate() looks at any model without crashing (run it under the sanitizers) and never passes one
// that was spoilt.

namespace limber {
namespace {

std::int32_t random_bad_index() {
  constexpr auto kMost = std::numeric_limits<std::int32_t>::max();
  return *rc::gen::element<std::int32_t>(-kMost - 1, -kMost, -2, 1000, 1 << 20, kMost);
}

double random_bad_number() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return *rc::gen::element(kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN());
}

template <class IdType, class T>
T& any_of(IdVector<IdType, T>& items) {
  return items[IdType(*rc::gen::inRange<std::size_t>(0, items.size()))];
}

template <class T>
T& any_of(std::vector<T>& items) {
  return items[*rc::gen::inRange<std::size_t>(0, items.size())];
}

void spoil_an_index(GeometricModel& g) {
  const std::int32_t bad = random_bad_index();
  switch (*rc::gen::inRange(0, 8)) {
    case 0:
      any_of(g.edges).a.value = bad;
      return;
    case 1:
      any_of(g.edges).b.value = bad;
      return;
    case 2:
      any_of(g.faces).corners[*rc::gen::inRange(0, 3)].value = bad;
      return;
    case 3:
      any_of(g.faces).cell.value = bad;
      return;
    case 4:
      any_of(any_of(g.cells).edges).value = bad;
      return;
    case 5:
      any_of(any_of(g.cells).faces).value = bad;
      return;
    case 6:
      any_of(g.subobjects).points.begin = bad;
      return;
    default:
      any_of(g.subobjects).faces.end = bad;
      return;
  }
}

void spoil_a_number(PhysicalModel& m) {
  const double bad = random_bad_number();
  switch (*rc::gen::inRange(0, 10)) {
    case 0:
      any_of(m.geometry.points)[*rc::gen::inRange(0, 3)] = bad;
      return;
    case 1:
      any_of(m.points).mass = bad;
      return;
    case 2:
      any_of(m.points).velocity[*rc::gen::inRange(0, 3)] = bad;
      return;
    case 3:
      any_of(m.edges).stiffness = bad;
      return;
    case 4:
      any_of(m.edges).rest_length = bad;
      return;
    case 5:
      any_of(m.faces).normal_drag = bad;
      return;
    case 6:
      any_of(m.parts).values["temperature"] = bad;
      return;
    case 7:
      any_of(m.parts).surface.index_of_refraction = bad;
      return;
    case 8:
      m.object.contact_share = bad;
      return;
    default:
      m.object.restitution = bad;
      return;
  }
}

PhysicalModel random_model() {
  test::BlockShape shape;
  for (int& n : shape.cells) n = *rc::gen::inRange(1, 3);
  PhysicalModel m = test::block(shape);
  if (!*rc::gen::arbitrary<bool>()) return m;
  const EdgeId edges[] = {EdgeId(*rc::gen::inRange<std::size_t>(0, m.edges.size()))};
  break_edges(m, edges);
  return m;
}

RC_GTEST_PROP(ValidateProperty, FindsEveryBadIndexAndNumber, ()) {
  PhysicalModel m = random_model();
  RC_ASSERT(validate(m).empty());
  const int times = *rc::gen::inRange(1, 20);
  for (int i = 0; i < times; ++i)
    *rc::gen::arbitrary<bool>() ? spoil_an_index(m.geometry) : spoil_a_number(m);
  RC_ASSERT(!validate(m).empty());
  validate(m.geometry, "spoilt", 1000);
}

RC_GTEST_PROP(ValidateProperty, FindsEveryWrongSize, ()) {
  PhysicalModel m = random_model();
  const std::size_t n = *rc::gen::inRange<std::size_t>(0, 5);
  switch (*rc::gen::inRange(0, 7)) {
    case 0:
      m.geometry.points.resize(n, Vec3::Zero());
      break;
    case 1:
      m.geometry.edges.resize(n);
      break;
    case 2:
      m.geometry.faces.resize(n);
      break;
    case 3:
      m.points.resize(n);
      break;
    case 4:
      m.edges.resize(n);
      break;
    case 5:
      m.faces.resize(n);
      break;
    default:
      m.cells.resize(n + 9);
      break;
  }
  RC_ASSERT(!validate(m).empty());
}

}  // namespace
}  // namespace limber

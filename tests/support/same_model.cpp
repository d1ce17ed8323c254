#include "tests/support/same_model.h"

#include <gtest/gtest.h>

#include <bit>

#include "core/operators/breaking_operator.h"
#include "core/operators/gluing_operator.h"
#include "tests/support/blocks.h"

namespace limber::test {
namespace {

std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }

std::array<std::uint64_t, 3> bits(const Vec3& v) { return {bits(v[0]), bits(v[1]), bits(v[2])}; }

auto key(const Vec3& v) { return bits(v); }
auto key(const Edge& e) { return std::tuple(e.a, e.b); }
auto key(const Face& f) { return std::tuple(f.corners, f.cell); }
auto key(const Cell& c) { return std::tuple(c.edges, c.faces); }
auto key(const Subobject& s) { return std::tuple(s.name, s.points, s.edges, s.faces, s.cells); }
auto key(const PointAttributes& p) { return std::tuple(bits(p.mass), bits(p.velocity), p.pinned); }
auto key(const EdgeAttributes& e) {
  return std::tuple(bits(e.stiffness), bits(e.damping), bits(e.rest_length),
                    bits(e.break_threshold), bits(e.crush_threshold), e.broken);
}
auto key(const FaceAttributes& f) {
  return std::tuple(f.drag_law, bits(f.normal_drag), bits(f.tangential_drag));
}
auto key(const CellAttributes& c) { return c.valid; }
auto key(const SubobjectAttributes& part) {
  std::vector<std::pair<std::string, std::uint64_t>> values;
  for (const auto& [name, x] : part.values) values.emplace_back(name, bits(x));
  const SurfaceProperties& s = part.surface;
  return std::tuple(bits(s.colour), bits(s.specularity), bits(s.transparency),
                    bits(s.index_of_refraction), bits(s.strand_radius), s.texture, values);
}
auto key(const SkinCell& c) { return std::tuple(c.cell, c.corners, c.grid); }
auto key(const SkinVertex& v) { return std::tuple(v.host, bits(v.place)); }
auto key(const SkinTriangle& t) { return std::tuple(t.corners, t.owner); }

template <class List>
void expect_same(const List& a, const List& b, const char* what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  auto other = b.begin();
  std::size_t i = 0;
  for (const auto& x : a) EXPECT_TRUE(key(x) == key(*other++)) << what << ' ' << i++;
}

auto key(const ObjectAttributes& o) {
  return std::tuple(bits(o.friction), bits(o.restitution), bits(o.internal_damping),
                    bits(o.softening), bits(o.contact_share), bits(o.particle_radius));
}

Skin some_skin(const BlockShape& shape) {
  Skin skin;
  SkinCell cell{CellId(0), {}, {1, -2, 3}};
  for (int c = 0; c < 8; ++c)
    cell.corners[std::size_t(c)] = block_point(shape, {c & 1, c >> 1 & 1, c >> 2});
  skin.cells = {cell};
  skin.vertices = {{0, {0.1, 0.2, 0.3}}, {0, {-0.0, 1.0 / 3, 1.1}}, {0, {1, 0, 1e-300}}};
  skin.triangles = {{{0, 1, 2}, 0}, {{2, 1, 0}, 0}};
  return skin;
}

void give_odd_attributes(PhysicalModel& m) {
  double x = 0.1;
  for (PointAttributes& p : m.points) {
    x += 1.0 / 7;
    p = {x, {x, -0.0, -x}, x > 1.5};
  }
  for (EdgeAttributes& e : m.edges) {
    e.stiffness = (x *= 1.01);
    e.damping = x / 3;
    e.break_threshold = x / 7;
    e.crush_threshold = x > 2 ? x / 11 : kUnbreakable;
  }
  for (FaceAttributes& f : m.faces) {
    x *= 1.01;
    f = {DragLaw::kPressure, x, x / 3};
  }
  m.faces[FaceId(0)].drag_law = DragLaw::kLinear;
  m.object = {0.1, 0.2, 30.3, 40.4, 0.05, 0.006};
}

}  // namespace

void expect_same_model(const PhysicalModel& a, const PhysicalModel& b) {
  EXPECT_EQ(a.name, b.name);
  expect_same(a.geometry.points, b.geometry.points, "position");
  expect_same(a.geometry.edges, b.geometry.edges, "edge");
  expect_same(a.geometry.faces, b.geometry.faces, "face");
  expect_same(a.geometry.cells, b.geometry.cells, "cell");
  expect_same(a.geometry.subobjects, b.geometry.subobjects, "subobject");
  expect_same(a.points, b.points, "point attributes");
  expect_same(a.edges, b.edges, "edge attributes");
  expect_same(a.faces, b.faces, "face attributes");
  expect_same(a.cells, b.cells, "cell attributes");
  expect_same(a.parts, b.parts, "part");
  EXPECT_TRUE(key(a.object) == key(b.object)) << "object";
  ASSERT_EQ(a.skins.size(), b.skins.size());
  for (std::size_t i = 0; i < a.skins.size(); ++i) {
    expect_same(a.skins[i].cells, b.skins[i].cells, "skin cell");
    expect_same(a.skins[i].vertices, b.skins[i].vertices, "skin vertex");
    expect_same(a.skins[i].triangles, b.skins[i].triangles, "skin triangle");
  }
}

PhysicalModel rich_model() {
  const BlockShape left{.cells = {2, 1, 1}, .name = "left"};
  const BlockShape right{.cells = {1, 1, 1}, .origin = {2.25, 0, 0}, .name = "right"};
  PhysicalModel m = glue(block(left), block(right), {0.25, 50.0, 1.0}).model;
  m.name = "rich";
  give_odd_attributes(m);
  const std::array broken = {EdgeId(3)};
  break_edges(m, broken);
  m.parts[0].surface = {{0.1, 0.2, 0.3}, 0.4, 0.5, 1.25, "clay.png"};
  m.parts[1].values = {{"temperature", 300.5}, {"", -0.0}, {"Dichte \xc3\xbc", 1.0 / 3}};
  m.skins = {some_skin(left), Skin(), some_skin(left)};
  return m;
}

}  // namespace limber::test

#include <cmath>
#include <optional>

#include "demos/scripting/api.h"
#include "demos/scripting/lua_state.h"
#include "demos/scripting/script.h"

// Rigid bodies of every shape of Bullet's.

namespace limber::demos {
namespace {

std::vector<Field> body_fields(std::vector<Field> own, bool moves) {
  std::vector<Field> fields = {
      field("name", Kind::kText, "", "in events").or_else(std::string("body"))};
  fields.insert(fields.end(), own.begin(), own.end());
  fields.push_back(field("position", Kind::kVector, "m", "of its middle")
                       .or_else(Vec3(0.0, 0.0, 0.0))
                       .between(-kMostMetres, kMostMetres));
  fields.push_back(rotation_field("about its middle"));
  if (moves) {
    fields.push_back(number("mass", "kg", "0: it does not move").or_else(0.0).between(0.0, 1e9));
    fields.push_back(field("velocity", Kind::kVector, "m/s", "at first")
                         .or_else(Vec3(0.0, 0.0, 0.0))
                         .between(-kMostSpeed, kMostSpeed));
    fields.push_back(field("spin", Kind::kVector, "rad/s", "at first")
                         .or_else(Vec3(0.0, 0.0, 0.0))
                         .between(-kMostSpeed, kMostSpeed));
  }
  fields.push_back(number("friction", "", "Coulomb coefficient").or_else(0.5).between(0.0, 10.0));
  fields.push_back(number("restitution", "", "share of the speed that a bounce keeps")
                       .or_else(0.0)
                       .between(0.0, 1.0));
  fields.push_back(field("colour", Kind::kColour, "", "linear red, green, blue")
                       .or_else(Vec3(0.6, 0.5, 0.4))
                       .between(0.0, 1.0));
  return fields;
}

// `middle`: where the shape's origin is in the frame that the script places, m.
int give_body(const Arguments& given, bullet::StageShape shape, bool moves,
              const Vec3& middle = Vec3::Zero()) {
  Script& script = script_of(given.lua());
  script.take_body();
  RigidBody body;
  body.shape = std::move(shape);
  body.name = given.text("name");
  body.centre = given.vector("position");
  body.rotation = given.rotation("rotation");
  if (!middle.isZero(0.0)) body.centre += body.rotation * middle;
  body.friction = given.number("friction");
  body.restitution = given.number("restitution");
  body.colour = given.vector("colour");
  if (moves) {
    body.mass = given.number("mass");
    body.velocity = given.vector("velocity");
    body.spin = given.vector("spin");
  }
  std::size_t index = 0;
  if (Simulation* simulation = script.simulation()) {
    index = simulation->add_body(body);
  } else {
    index = script.draft().bodies.size();
    script.draft().bodies.push_back(std::move(body));
  }
  push(given.lua(), BodyHandle{index});
  return 1;
}

int make_box(const Arguments& given) {
  return give_body(given, bullet::BoxShape{0.5 * given.vector("size")}, true);
}

int make_sphere(const Arguments& given) {
  return give_body(given, bullet::SphereShape{given.number("radius")}, true);
}

template <class Shape>
int make_round(const Arguments& given) {
  return give_body(given, Shape{given.number("radius"), given.number("height")}, true);
}

// What a shape is made of is kept outside of Lua's memory.
void charge_items(const Arguments& given, std::size_t count) {
  script_of(given.lua()).take_points(static_cast<double>(count));
}

int make_hull(const Arguments& given) {
  bullet::HullShape hull{given.vectors("points")};
  if (hull.points.size() > 1000 || bullet::triangles_of(hull).triangles.empty()) {
    throw InputError({given.where(), "the points have no hull, or are more than 1000",
                      "give at least four that do not lie in a plane"});
  }
  charge_items(given, hull.points.size());
  return give_body(given, std::move(hull), true);
}

int make_mesh(const Arguments& given) {
  bullet::MeshShape mesh{given.vectors("points"), {}};
  const std::vector<double> corners = given.numbers("triangles");
  if (corners.size() % 3 != 0) {
    throw InputError({given.where(), "'triangles' has a number of items that three does not divide",
                      "give three numbers of points for each triangle"});
  }
  charge_items(given, mesh.positions.size() + corners.size());
  const auto most = static_cast<double>(mesh.positions.size());
  std::vector<std::int32_t> index;
  for (double corner : corners) {
    if (corner > most || corner != std::floor(corner)) {
      throw InputError({given.where(), "'triangles' names a point that is not there",
                        "give whole numbers from 1 to the number of points"});
    }
    index.push_back(static_cast<std::int32_t>(corner) - 1);
  }
  for (std::size_t i = 0; i < index.size(); i += 3) {
    mesh.triangles.push_back({index[i], index[i + 1], index[i + 2]});
  }
  return give_body(given, std::move(mesh), false);
}

double positive(const Arguments& part, const char* name) {
  if (part.has(name)) return part.number(name);
  throw InputError({part.where(), "a " + part.text("shape") + " has no '" + std::string(name) + "'",
                    "give one to each part that needs it"});
}

bullet::SolidShape solid_of(const Arguments& part) {
  const std::string shape = part.text("shape");
  const auto of = [&](const char* name) { return positive(part, name); };
  if (shape == "sphere") return bullet::SphereShape{of("radius")};
  if (shape == "capsule") return bullet::CapsuleShape{of("radius"), of("height")};
  if (shape == "cylinder") return bullet::CylinderShape{of("radius"), of("height")};
  if (shape == "cone") return bullet::ConeShape{of("radius"), of("height")};
  if (part.has("size")) return bullet::BoxShape{0.5 * part.vector("size")};
  throw InputError({part.where(), "a box has no 'size'", "give one to each part that is a box"});
}

// The position is that of the parts' origin; what Bullet moves is their centre of mass.
int make_compound(const Arguments& given) {
  bullet::CompoundShape compound;
  given.each("parts", [&](const Arguments& part) {
    compound.parts.push_back({solid_of(part), part.vector("position"), part.rotation("rotation")});
  });
  charge_items(given, compound.parts.size());
  const Vec3 middle = bullet::centre_parts(compound);
  return give_body(given, std::move(compound), true, middle);
}

int make_terrain(const Arguments& given) {
  bullet::TerrainShape terrain;
  terrain.columns = given.whole("columns");
  terrain.spacing = given.number("spacing");
  terrain.heights = given.numbers("heights");
  const auto count = static_cast<int>(terrain.heights.size());
  terrain.rows = count / terrain.columns;
  if (terrain.rows < 2 || terrain.rows * terrain.columns != count) {
    throw InputError({given.where(), "'heights' does not fill two rows or more of the columns",
                      "give columns x rows numbers, row by row"});
  }
  charge_items(given, terrain.heights.size());
  return give_body(given, std::move(terrain), false);
}

std::vector<Field> part_fields() {
  return {
      choice("shape", {"box", "sphere", "capsule", "cylinder", "cone"}, "which kind"),
      field("size", Kind::kVector, "m", "the edges of a box").between(1e-4, kMostMetres).optional(),
      number("radius", "m", "of what is round").between(1e-4, kMostMetres).optional(),
      number("height", "m", "along its own y, as of a body of that shape")
          .between(1e-4, kMostMetres)
          .optional(),
      field("position", Kind::kVector, "m", "of its middle")
          .or_else(Vec3(0.0, 0.0, 0.0))
          .between(-kMostMetres, kMostMetres),
      rotation_field("about its middle")};
}

std::vector<Field> round_fields(const char* height) {
  return body_fields({number("radius", "m", "of it").between(1e-4, kMostMetres),
                      number("height", "m", height).between(1e-4, kMostMetres)},
                     true);
}

}  // namespace

std::vector<ApiFunction> rigid_functions() {
  const Field points = field("points", Kind::kVectors, "m", "its corners, about its middle")
                           .between(-kMostMetres, kMostMetres);
  return {
      {"rigid", "box", "A box.",
       body_fields({field("size", Kind::kVector, "m", "its edges").between(1e-4, kMostMetres)},
                   true),
       "body", "rigid.box{name = \"table\", size = {1, 0.04, 0.6}, position = {0, 0.75, 0}}",
       make_box},
      {"rigid", "sphere", "A ball.",
       body_fields({number("radius", "m", "of it").between(1e-4, kMostMetres)}, true), "body",
       "rigid.sphere{radius = 0.1, mass = 2, position = {0, 1, 0}, velocity = {3, 0, 0}}",
       make_sphere},
      {"rigid", "capsule", "A cylinder along y with round ends.",
       round_fields("between the centres of its ends"), "body",
       "rigid.capsule{radius = 0.05, height = 0.3, mass = 1, position = {0, 0.5, 0}}",
       make_round<bullet::CapsuleShape>},
      {"rigid", "cylinder", "A cylinder along y.", round_fields("of it"), "body",
       "rigid.cylinder{radius = 0.05, height = 0.3, mass = 1, position = {0, 0.5, 0}}",
       make_round<bullet::CylinderShape>},
      {"rigid", "cone", "A cone along y, its tip up.", round_fields("of it"), "body",
       "rigid.cone{radius = 0.1, height = 0.3, mass = 1, position = {0, 0.5, 0}}",
       make_round<bullet::ConeShape>},
      {"rigid", "hull", "The convex hull of points.", body_fields({points}, true), "body",
       "rigid.hull{points = {{0, 0, 0}, {0.2, 0, 0}, {0, 0.2, 0}, {0, 0, 0.2}}, mass = 1,\n"
       "           position = {0, 0.5, 0}}",
       make_hull},
      {"rigid", "compound",
       "Several shapes that are one body, each as heavy as its volume. Its position, and what it "
       "turns about, is where the origin of its parts goes; body:position() is its centre of mass.",
       body_fields({records("parts", part_fields(), "what it is made of")}, true), "body",
       R"(local hammer = rigid.compound{mass = 2, position = {0, 1, 0}, parts = {
  {shape = "cylinder", radius = 0.02, height = 0.4},
  {shape = "box", size = {0.2, 0.08, 0.08}, position = {0, 0.2, 0}},
}})",
       make_compound},
      {"rigid", "mesh", "Triangles that do not move.",
       body_fields({points, field("triangles", Kind::kNumbers, "",
                                  "three points each, from 1 on, anticlockwise from outside")
                                .between(1.0, 1e6)},
                   false),
       "body", "rigid.mesh{points = {{-1, 0, 1}, {1, 0, 1}, {0, 0.5, -1}}, triangles = {1, 2, 3}}",
       make_mesh},
      {"rigid", "terrain", "Heights over a grid, about its middle; it does not move.",
       body_fields({field("columns", Kind::kWhole, "", "along x").between(2.0, 1000.0),
                    number("spacing", "m", "of the grid").between(1e-3, kMostMetres),
                    field("heights", Kind::kNumbers, "m", "row by row along z")
                        .between(-kMostMetres, kMostMetres)},
                   false),
       "body", "rigid.terrain{columns = 3, spacing = 1, heights = {0, 0, 0, 0, 0.3, 0, 0, 0, 0}}",
       make_terrain}};
}

}  // namespace limber::demos

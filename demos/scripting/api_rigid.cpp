#include <cmath>
#include <optional>

#include "demos/scripting/api.h"
#include "demos/scripting/lua_state.h"
#include "demos/scripting/script.h"

// Rigid bodies of every shape of Bullet's, and what joins them.

namespace limber::demos {
namespace {

constexpr double kMostMetres = 1e4;
constexpr double kMostSpeed = 1e4;  // m/s, rad/s

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

int give_body(const Arguments& given, bullet::StageShape shape, bool moves) {
  Script& script = script_of(given.lua());
  script.take_body();
  RigidBody body;
  body.shape = std::move(shape);
  body.name = given.text("name");
  body.centre = given.vector("position");
  body.rotation = given.rotation("rotation");
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

// A body that is still there.
std::size_t body_index(const Arguments& given, std::size_t index) {
  const Simulation* simulation = script_of(given.lua()).simulation();
  if (!simulation || simulation->stage().has_body(index)) return index;
  throw InputError({given.where(), "the body was removed", "forget it after body:remove()"});
}

std::size_t body_index(const Arguments& given) {
  return body_index(given, self<BodyHandle>(given).index);
}

bullet::Stage& stage_of(const Arguments& given) {
  return script_of(given.lua()).simulation()->stage();
}

bullet::StageMotion motion_of(const Arguments& given) {
  return stage_of(given).motion(body_index(given));
}

int name_of(const Arguments& given) {
  Script& script = script_of(given.lua());
  const Scene& scene = script.simulation() ? script.simulation()->scene() : script.draft();
  const std::string& name = scene.bodies[self<BodyHandle>(given).index].name;
  lua_pushlstring(given.lua(), name.data(), name.size());
  return 1;
}

int position_of(const Arguments& given) {
  push(given.lua(), motion_of(given).centre);
  return 1;
}

int velocity_of(const Arguments& given) {
  push(given.lua(), motion_of(given).velocity);
  return 1;
}

int spin_of(const Arguments& given) {
  push(given.lua(), motion_of(given).spin);
  return 1;
}

// Where a point of the body goes: the image of a direction of its own.
int axis_of(const Arguments& given) {
  push(given.lua(), Vec3(motion_of(given).rotation * given.vector("of").normalized()));
  return 1;
}

int push_body(const Arguments& given) {
  const std::size_t body = body_index(given);
  const Vec3 at = given.has("at") ? given.vector("at") : stage_of(given).motion(body).centre;
  stage_of(given).apply_impulse(body, given.vector("impulse"), at);
  return 0;
}

int move_body(const Arguments& given) {
  const std::size_t body = body_index(given);
  bullet::StageMotion motion = stage_of(given).motion(body);
  if (given.has("position")) motion.centre = given.vector("position");
  if (given.has("rotation")) motion.rotation = given.rotation("rotation");
  if (given.has("velocity")) motion.velocity = given.vector("velocity");
  if (given.has("spin")) motion.spin = given.vector("spin");
  stage_of(given).set_motion(body, motion);
  return 0;
}

int remove_body(const Arguments& given) {
  stage_of(given).remove_body(body_index(given));
  return 0;
}

int join(const Arguments& given, bullet::StageJoint::Kind kind) {
  Script& script = script_of(given.lua());
  script.require_setting_up(given.where());
  bullet::StageJoint joint;
  joint.kind = kind;
  joint.body = given.handle<BodyHandle>("body")->index;
  if (const BodyHandle* other = given.handle<BodyHandle>("to")) joint.other = other->index;
  if (joint.other == joint.body || script.draft().bodies[joint.body].mass == 0.0) {
    throw InputError({given.where(), "'body' is joined to itself, or does not move",
                      "give a body with a mass, and another one or none as 'to'"});
  }
  joint.at = given.vector("at");
  if (kind == bullet::StageJoint::Kind::kHinge) joint.axis = given.vector("axis").normalized();
  script.draft().joints.push_back(joint);
  return 0;
}

std::vector<Field> joint_fields() {
  return {field("body", Kind::kBody, "", "what is joined; it has a mass"),
          field("to", Kind::kBody, "", "what it is joined to; the world without it").optional(),
          field("at", Kind::kVector, "m", "where").between(-kMostMetres, kMostMetres)};
}

std::vector<Field> hinge_fields() {
  std::vector<Field> fields = joint_fields();
  fields.push_back(field("axis", Kind::kDirection, "", "that it turns about"));
  return fields;
}

std::vector<Field> move_fields() {
  return {field("position", Kind::kVector, "m", "of its middle")
              .between(-kMostMetres, kMostMetres)
              .optional(),
          rotation_field("of its shape as it was made"),
          field("velocity", Kind::kVector, "m/s", "of its middle")
              .between(-kMostSpeed, kMostSpeed)
              .optional(),
          field("spin", Kind::kVector, "rad/s", "about its middle")
              .between(-kMostSpeed, kMostSpeed)
              .optional()};
}

std::vector<Field> round_fields(const char* height) {
  return body_fields({number("radius", "m", "of it").between(1e-4, kMostMetres),
                      number("height", "m", height).between(1e-4, kMostMetres)},
                     true);
}

using JointKind = bullet::StageJoint::Kind;

}  // namespace

std::vector<ApiFunction> rigid_functions() {
  const Field points = field("points", Kind::kVectors, "m", "its corners, about its middle")
                           .between(-kMostMetres, kMostMetres);
  const std::string kBall =
      "local ball = rigid.sphere{radius = 0.1, mass = 1, position = {0, 1, 0}}\n";
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
       make_terrain},
      {"body",
       "name",
       "Its name.",
       {},
       "string",
       kBall + "assert(ball:name() == \"body\")",
       name_of},
      {"body",
       "position",
       "Where its middle is, m.",
       {},
       "vec",
       kBall + "function on_tick() assert(ball:position().y > 0) end",
       position_of,
       true},
      {"body",
       "velocity",
       "How fast its middle is, m/s.",
       {},
       "vec",
       kBall + "function on_tick() print(ball:velocity()) end",
       velocity_of,
       true},
      {"body",
       "spin",
       "How fast it turns, rad/s.",
       {},
       "vec",
       kBall + "function on_tick() print(ball:spin()) end",
       spin_of,
       true},
      {"body",
       "axis",
       "Where a direction of its own points now.",
       {field("of", Kind::kDirection, "", "as the body was made")},
       "vec",
       kBall + "function on_tick() assert(ball:axis{of = {0, 1, 0}}.y > 0) end",
       axis_of,
       true},
      {"body",
       "push",
       "Pushes it, at once.",
       {field("impulse", Kind::kVector, "N s", "that it gets").between(-1e9, 1e9),
        field("at", Kind::kVector, "m", "where; at its middle without it")
            .between(-kMostMetres, kMostMetres)
            .optional()},
       "",
       kBall + "function on_start() ball:push{impulse = {1, 0, 0}} end",
       push_body,
       true},
      {"body", "move", "Puts it elsewhere, or sets how it moves; what is left out stays.",
       move_fields(), "", kBall + "function on_start() ball:move{velocity = {0, 2, 0}} end",
       move_body, true},
      {"body",
       "remove",
       "Takes it out of the world, with its joints.",
       {},
       "",
       kBall + "function on_start() ball:remove() end",
       remove_body,
       true},
      {"joint", "ball", "Holds a point of a body where it is; it may turn about it.",
       joint_fields(), "", kBall + "joint.ball{body = ball, at = {0, 2, 0}}",
       [](const Arguments& given) { return join(given, JointKind::kBall); }},
      {"joint", "hinge", "Lets a body turn about one axis.", hinge_fields(), "",
       kBall + "joint.hinge{body = ball, at = {0, 2, 0}, axis = {0, 0, 1}}",
       [](const Arguments& given) { return join(given, JointKind::kHinge); }},
      {"joint", "fixed", "Holds a body as it is to another one.", joint_fields(), "",
       kBall + "local rod = rigid.capsule{radius = 0.02, height = 0.5, mass = 1, "
               "position = {0, 1.3, 0}}\n"
               "joint.fixed{body = ball, to = rod, at = {0, 1.1, 0}}",
       [](const Arguments& given) { return join(given, JointKind::kFixed); }}};
}

}  // namespace limber::demos

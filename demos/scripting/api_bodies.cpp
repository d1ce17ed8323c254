#include "demos/scripting/api.h"
#include "demos/scripting/lua_state.h"
#include "demos/scripting/script.h"

// Rigid bodies while the scene runs, and what joins them.

namespace limber::demos {
namespace {

const std::string kBall =
    "local ball = rigid.sphere{radius = 0.1, mass = 1, position = {0, 1, 0}}\n";

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
  return give(given, script_of(given.lua()).scene_now().bodies[self<BodyHandle>(given).index].name);
}

int position_of(const Arguments& given) {
  return give(given, stage_of(given).centre(body_index(given)));
}

int velocity_of(const Arguments& given) { return give(given, motion_of(given).velocity); }

int spin_of(const Arguments& given) { return give(given, motion_of(given).spin); }

// Where a point of the body goes: the image of a direction of its own.
int axis_of(const Arguments& given) {
  return give(given, Vec3(motion_of(given).rotation * given.vector("of").normalized()));
}

int push_body(const Arguments& given) {
  const std::size_t body = body_index(given);
  const Vec3 at = given.has("at") ? given.vector("at") : stage_of(given).centre(body);
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
  Simulation* const simulation = script.simulation();
  bullet::StageJoint joint;
  joint.kind = kind;
  joint.body = body_index(given, given.handle<BodyHandle>("body")->index);
  if (const BodyHandle* other = given.handle<BodyHandle>("to")) {
    joint.other = body_index(given, other->index);
  }
  const Scene& scene = script.scene_now();
  if (joint.other == joint.body || scene.bodies[joint.body].mass == 0.0) {
    throw InputError({given.where(), "'body' is joined to itself, or does not move",
                      "give a body with a mass, and another one or none as 'to'"});
  }
  joint.at = given.vector("at");
  if (kind == bullet::StageJoint::Kind::kHinge) joint.axis = given.vector("axis").normalized();
  if (simulation) {
    simulation->stage().add_joint(joint);
  } else {
    script.draft().joints.push_back(joint);
  }
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

using JointKind = bullet::StageJoint::Kind;

}  // namespace

std::vector<ApiFunction> body_functions() {
  return {{"body",
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
           true}};
}

std::vector<ApiFunction> joint_functions() {
  return {{"joint", "ball", "Holds a point of a body where it is; it may turn about it.",
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

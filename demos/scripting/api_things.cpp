#include <algorithm>
#include <span>

#include "core/model/bounds.h"
#include "core/model/validate.h"
#include "demos/scripting/api.h"
#include "demos/scripting/lua_state.h"
#include "demos/scripting/script.h"

// Models in the world.

namespace limber::demos {
namespace {

// The model as it starts: placed and moved where that was asked for, and to the bit as it was
// otherwise.
PhysicalModel prepared(const Arguments& given) {
  PhysicalModel model = **given.handle<ModelHandle>("model");
  if (given.has("name")) model.name = given.text("name");
  if (given.has("position") || given.has("rotation")) {
    const Vec3 position = given.has("position") ? given.vector("position") : Vec3(Vec3::Zero());
    place(model, given.rotation("rotation"), position);
  }
  if (given.has("velocity") || given.has("spin")) {
    set_in_motion(model, given.has("velocity") ? given.vector("velocity") : Vec3(Vec3::Zero()),
                  given.has("spin") ? given.vector("spin") : Vec3(Vec3::Zero()));
  }
  require_valid(model);
  return model;
}

std::optional<bullet::Integration> integration_of(const Arguments& given) {
  if (!given.has("integrator")) return {};
  const std::string wanted = given.text("integrator");
  if (wanted == "implicit") return bullet::Integration::kImplicit;
  if (wanted == "automatic") return bullet::Integration::kAutomatic;
  return bullet::Integration::kExplicit;
}

int spawn(const Arguments& given) {
  Script& script = script_of(given.lua());
  script.take_object();
  PhysicalModel model = prepared(given);
  script.take_points(static_cast<double>(model.points.size()));
  const auto integration = integration_of(given);
  std::size_t index = 0;
  if (Simulation* simulation = script.simulation()) {
    index = simulation->spawn(std::move(model), integration);
    script.state_changed();
  } else {
    Scene& scene = script.draft();
    index = scene.objects.size();
    scene.objects.push_back(std::move(model));
    if (integration) scene.integration[index] = *integration;
  }
  push(given.lua(), ObjectHandle{index});
  return 1;
}

// One that is still there.
std::size_t object_of(const Arguments& given) {
  const std::size_t index = self<ObjectHandle>(given).index;
  const Simulation* simulation = script_of(given.lua()).simulation();
  if (!simulation || simulation->stage().co_simulation().has_object(index)) return index;
  throw InputError({given.where(), "the object was removed", "forget it after object:remove()"});
}

bullet::CoSimulation& limber_of(const Arguments& given) {
  return script_of(given.lua()).simulation()->stage().co_simulation();
}

// Sums over the pieces of the object: debris is left out.
RigidMotion motion_of(const Arguments& given, std::span<const bullet::PieceView> pieces) {
  RigidMotion sum;
  sum.mass = 0.0;
  sum.centre = sum.velocity = Vec3::Zero();
  for (const bullet::PieceView& piece : pieces) {
    sum.mass += piece.motion.mass;
    sum.centre += piece.motion.mass * piece.motion.centre;
    sum.velocity += piece.motion.mass * piece.motion.velocity;
  }
  if (sum.mass <= 0.0) {
    throw InputError(
        {given.where(), "nothing but dust is left of the object", "ask object:pieces() first"});
  }
  sum.centre /= sum.mass;
  sum.velocity /= sum.mass;
  return sum;
}

Vec3 centre_of(const Arguments& given) {
  return motion_of(given, script_of(given.lua()).places_of(object_of(given))).centre;
}

int name_of(const Arguments& given) {
  return give(given,
              script_of(given.lua()).scene_now().objects[self<ObjectHandle>(given).index].name);
}

int position_of(const Arguments& given) { return give(given, centre_of(given)); }

int velocity_of(const Arguments& given) {
  return give(given, motion_of(given, script_of(given.lua()).pieces_of(object_of(given))).velocity);
}

template <class Value>
int sum_over_pieces(const Arguments& given, const Value& value) {
  double sum = 0.0;
  for (const bullet::PieceView& piece : script_of(given.lua()).pieces_of(object_of(given))) {
    sum += value(piece);
  }
  lua_pushnumber(given.lua(), sum);
  return 1;
}

int mass_of(const Arguments& given) {
  return sum_over_pieces(given, [](const bullet::PieceView& p) { return p.motion.mass; });
}

int energy_of(const Arguments& given) {
  return sum_over_pieces(given,
                         [](const bullet::PieceView& p) { return p.motion.kinetic_energy(); });
}

int count_pieces(const Arguments& given) {
  const auto pieces = script_of(given.lua()).places_of(object_of(given));
  lua_pushinteger(given.lua(), static_cast<lua_Integer>(pieces.size()));
  return 1;
}

int is_flexible(const Arguments& given) {
  const auto pieces = script_of(given.lua()).places_of(object_of(given));
  lua_pushboolean(given.lua(), std::ranges::any_of(pieces, &bullet::PieceView::flexible));
  return 1;
}

PhysicalModel model_now(const Arguments& given) {
  PhysicalModel model = limber_of(given).model(object_of(given));
  state_of(given.lua()).spend(10 * model.edges.size());
  return model;
}

int bounds_now(const Arguments& given) {
  const Box3 box = bounds_of(model_now(given).geometry.points);
  push(given.lua(), Vec3(box.min()));
  push(given.lua(), Vec3(box.max()));
  return 2;
}

int count_broken(const Arguments& given) {
  lua_pushinteger(given.lua(),
                  std::ranges::count(model_now(given).edges.raw(), true, &EdgeAttributes::broken));
  return 1;
}

// Stretch of each unbroken spring as a share of its length, the largest.
int largest_strain(const Arguments& given) {
  const PhysicalModel model = model_now(given);
  double largest = 0.0;
  for (EdgeId e : ids_of(model.edges)) {
    if (model.edges[e].broken) continue;
    const Edge& edge = model.geometry.edges[e];
    const double length = (model.geometry.points[edge.a] - model.geometry.points[edge.b]).norm();
    largest = std::max(largest, length / model.edges[e].rest_length - 1.0);
  }
  lua_pushnumber(given.lua(), largest);
  return 1;
}

int give_model_now(const Arguments& given) {
  PhysicalModel model = model_now(given);
  script_of(given.lua()).take_points(static_cast<double>(model.points.size()));
  push(given.lua(), std::make_shared<PhysicalModel>(std::move(model)));
  return 1;
}

int push_object(const Arguments& given) {
  const Vec3 at = given.has("at") ? given.vector("at") : centre_of(given);
  limber_of(given).apply_impulse(object_of(given), given.vector("impulse"), at);
  script_of(given.lua()).motion_changed();
  return 0;
}

int throw_object(const Arguments& given) {
  Script& script = script_of(given.lua());
  script.simulation()->stage().throw_object(object_of(given), given.vector("velocity"),
                                            given.vector("spin"));
  script.motion_changed();
  return 0;
}

int remove_object(const Arguments& given) {
  Script& script = script_of(given.lua());
  script.simulation()->remove(object_of(given));
  script.state_changed();
  return 0;
}

Field vector_field(const char* name, const char* unit, const char* meaning, double most) {
  return field(name, Kind::kVector, unit, meaning).between(-most, most);
}

const std::string kCrate =
    "local crate = spawn{model = shape.box{size = {0.2, 0.2, 0.2}, cells = {2, 2, 2},\n"
    "                                      material = \"spruce\"}, position = {0, 1, 0}}\n";

}  // namespace

std::vector<ApiFunction> spawn_functions() {
  return {
      {"",
       "spawn",
       "Puts a copy of a model into the world, before the scene runs or while it does.",
       {field("model", Kind::kModel, "", "of what"),
        field("name", Kind::kText, "", "in reports; the model's without it").optional(),
        vector_field("position", "m", "where the model's origin goes", kMostMetres).optional(),
        rotation_field("about the model's origin"),
        vector_field("velocity", "m/s", "on top of its own", kMostSpeed).optional(),
        vector_field("spin", "rad/s", "about its centre of mass, likewise", kMostSpeed).optional(),
        choice("integrator", {"explicit", "implicit", "automatic"},
               "how it is integrated; as the run is without it")
            .optional()},
       "object",
       kCrate + "assert(crate:name() == \"box\")",
       spawn}};
}

std::vector<ApiFunction> object_queries() {
  const auto in_tick = [&](const std::string& code) {
    return kCrate + "function on_tick() " + code + " end";
  };
  return {{"object",
           "name",
           "Its name.",
           {},
           "string",
           kCrate + "assert(crate:name() == \"box\")",
           name_of},
          {"object",
           "position",
           "The centre of mass of its pieces, m.",
           {},
           "vec",
           in_tick("assert(crate:position().y > 0)"),
           position_of,
           true},
          {"object",
           "velocity",
           "That of the centre of mass of its pieces, m/s.",
           {},
           "vec",
           in_tick("print(crate:velocity())"),
           velocity_of,
           true},
          {"object",
           "mass",
           "Of its pieces, kg: less once points came off.",
           {},
           "number",
           in_tick("assert(crate:mass() > 0)"),
           mass_of,
           true},
          {"object",
           "energy",
           "Kinetic, of its pieces, without vibration, J.",
           {},
           "number",
           in_tick("assert(crate:energy() >= 0)"),
           energy_of,
           true},
          {"object",
           "pieces",
           "How many pieces it is in.",
           {},
           "integer",
           in_tick("assert(crate:pieces() == 1)"),
           count_pieces,
           true},
          {"object",
           "is_flexible",
           "Is any piece of it a lattice just now?",
           {},
           "boolean",
           in_tick("assert(not crate:is_flexible())"),
           is_flexible,
           true},
          {"object",
           "bounds",
           "The lowest and the highest corner of the box around its points, m. Costs its size.",
           {},
           "vec, vec",
           in_tick("local low, high = crate:bounds() assert(low.y < high.y)"),
           bounds_now,
           true},
          {"object",
           "broken",
           "How many of its springs are broken. Costs its size.",
           {},
           "integer",
           in_tick("assert(crate:broken() == 0)"),
           count_broken,
           true},
          {"object",
           "strain",
           "The largest stretch of a spring, as a share. Costs its size.",
           {},
           "number",
           in_tick("assert(crate:strain() < 1)"),
           largest_strain,
           true},
          {"object",
           "model",
           "A model of it as it is now, to be changed, glued and spawned again. Costs its size.",
           {},
           "model",
           in_tick("if time() == 0 then assert(crate:model():mass() > 0) end"),
           give_model_now,
           true}};
}

std::vector<ApiFunction> object_actions() {
  return {{"object",
           "push",
           "Pushes it, the piece that is nearest, at a place.",
           {vector_field("impulse", "N s", "that it gets", 1e9),
            vector_field("at", "m", "where; at its centre without it", kMostMetres).optional()},
           "",
           kCrate + "function on_start() crate:push{impulse = {1, 0, 0}} end",
           push_object,
           true},
          {"object",
           "throw",
           "Sets how all of its pieces move.",
           {vector_field("velocity", "m/s", "of each centre", kMostSpeed),
            vector_field("spin", "rad/s", "about each centre", kMostSpeed)
                .or_else(Vec3(0.0, 0.0, 0.0))},
           "",
           kCrate + "function on_start() crate:throw{velocity = {0, 3, 0}} end",
           throw_object,
           true},
          {"object",
           "remove",
           "Takes it out of the world with all of its pieces and its dust.",
           {},
           "",
           kCrate + "function on_start() crate:remove() end",
           remove_object,
           true}};
}

}  // namespace limber::demos

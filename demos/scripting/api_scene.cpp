#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "demos/scripting/api.h"
#include "demos/scripting/lua_state.h"
#include "demos/scripting/safe_strings.h"
#include "demos/scripting/script.h"

// The scene, and what happens in it.

namespace limber::demos {
namespace {

constexpr double kForever = 1e5;  // s
constexpr double kMostTicks = 1e7;

Parameter parameter_of(const Arguments& given) {
  Parameter p{given.text("name"),    given.number("value"), given.text("unit"),
              given.text("meaning"), given.number("least"), given.number("most")};
  if (p.least <= p.value && p.value <= p.most && p.least < p.most) return p;
  throw InputError({"scene: parameter '" + p.name + "'", "its value is not between least and most",
                    "give least < most, and a value between them"});
}

std::vector<Parameter> parameters_of(const Arguments& given) {
  std::vector<Parameter> parameters;
  if (!given.has("parameters")) return parameters;
  given.each("parameters", [&](const Arguments& one) {
    parameters.push_back(parameter_of(one));
    const auto twice = std::ranges::count(parameters, parameters.back().name, &Parameter::name);
    if (twice == 1) return;
    throw InputError({"scene: parameter '" + parameters.back().name + "'",
                      "there are two of that name", "rename one"});
  });
  return parameters;
}

// The values by name; reading one that does not exist is an error, as for globals.
void push_values(lua_State* lua, const std::vector<Parameter>& parameters) {
  lua_newtable(lua);
  for (const Parameter& p : parameters) {
    lua_pushnumber(lua, script_of(lua).parameter(p.name));
    lua_setfield(lua, -2, p.name.c_str());
  }
  lua_newtable(lua);
  lua_pushcfunction(lua, [](lua_State* l) -> int {
    push_text(l, 2);
    raise(l, std::string("the scene has no parameter '") + lua_tostring(l, -1) +
                 "'; declare it in scene{parameters = {...}}");
  });
  lua_setfield(lua, -2, "__index");
  lua_setmetatable(lua, -2);
}

void require_few_ticks(const Arguments& given, double ticks) {
  if (ticks <= kMostTicks) return;
  throw InputError({given.where(), fmt::format("'seconds' are {:.3g} of 'tick'", ticks),
                    fmt::format("give fewer seconds or a longer tick: {:g} at most", kMostTicks)});
}

int set_scene(const Arguments& given) {
  Script& script = script_of(given.lua());
  script.require_setting_up(given.where());
  const std::vector<Parameter> parameters = parameters_of(given);
  script.declare(given.text("summary"), parameters);
  Scene& scene = script.draft();
  scene.seconds = given.number("seconds");
  scene.tick = given.number("tick");
  require_few_ticks(given, scene.seconds / scene.tick);
  scene.gravity = given.vector("gravity");
  scene.floor = given.flag("floor");
  scene.floor_friction = given.number("floor_friction");
  push_values(given.lua(), parameters);
  return 1;
}

int set_camera(const Arguments& given) {
  Script& script = script_of(given.lua());
  Camera camera;
  camera.position = given.vector("position");
  camera.target = given.vector("target");
  camera.field_of_view_deg = given.number("field_of_view_deg");
  camera.zoom = given.number("zoom");
  if (Simulation* simulation = script.simulation()) {
    simulation->set_camera(camera);
  } else {
    script.draft().camera = camera;
  }
  return 0;
}

int add_light(const Arguments& given) {
  Script& script = script_of(given.lua());
  script.require_setting_up(given.where());
  const Vec3 colour = given.number("brightness") * given.vector("colour");
  script.draft().lights.push_back({given.vector("position"), colour, given.flag("shadows")});
  return 0;
}

int time_now(const Arguments& given) {
  const Simulation* simulation = script_of(given.lua()).simulation();
  lua_pushnumber(given.lua(), simulation ? simulation->time_s() : 0.0);
  return 1;
}

double now(const Arguments& given) {
  const Simulation* simulation = script_of(given.lua()).simulation();
  return simulation ? simulation->time_s() : 0.0;
}

int call_after(const Arguments& given) {
  given.push("call");
  script_of(given.lua()).add_timer(now(given) + given.number("seconds"), {});
  return 0;
}

int call_every(const Arguments& given) {
  given.push("call");
  const double period = given.number("seconds");
  script_of(given.lua()).add_timer(now(given) + period, period);
  return 0;
}

int play(const Arguments& given) {
  script_of(given.lua()).add_input({given.number("at"), given.text("name"), given.number("value")});
  return 0;
}

void push_thing(lua_State* lua, const bullet::StageThing& thing) {
  using Thing = bullet::StageThing::Kind;
  if (thing.kind == Thing::kFloor) lua_pushnil(lua);
  if (thing.kind == Thing::kBody) push(lua, BodyHandle{thing.index});
  if (thing.kind == Thing::kObject) push(lua, ObjectHandle{thing.index});
}

int cast_ray(const Arguments& given) {
  lua_State* const lua = given.lua();
  const Vec3 from = given.vector("from");
  const auto hit = script_of(lua).simulation()->stage().ray(from, given.vector("to"));
  if (!hit) return 0;
  lua_createtable(lua, 0, 4);
  push_thing(lua, hit->thing);
  lua_setfield(lua, -2, "thing");
  push(lua, hit->at);
  lua_setfield(lua, -2, "at");
  push(lua, hit->normal);
  lua_setfield(lua, -2, "normal");
  lua_pushnumber(lua, (hit->at - from).norm());
  lua_setfield(lua, -2, "distance");
  return 1;
}

// The floor is no thing: whether it is reached comes second.
int find_overlaps(const Arguments& given) {
  lua_State* const lua = given.lua();
  if (given.has("radius") == given.has("size")) {
    throw InputError({given.where(), "it needs either a 'radius' or a 'size'",
                      "give a radius for a ball, a size for a box"});
  }
  bullet::SolidShape shape = bullet::SphereShape{given.has("radius") ? given.number("radius") : 0};
  if (given.has("size")) shape = bullet::BoxShape{0.5 * given.vector("size")};
  const auto things = script_of(lua).simulation()->stage().overlaps(shape, given.vector("centre"),
                                                                    given.rotation("rotation"));
  state_of(lua).spend(things.size());
  bool floor = false;
  lua_Integer count = 0;
  lua_newtable(lua);
  for (const bullet::StageThing& thing : things) {
    if (thing.kind == bullet::StageThing::Kind::kFloor) {
      floor = true;
      continue;
    }
    push_thing(lua, thing);
    lua_rawseti(lua, -2, ++count);
  }
  lua_pushboolean(lua, floor);
  return 2;
}

int set_switching(const Arguments& given) {
  Script& script = script_of(given.lua());
  script.require_setting_up(given.where());
  bullet::SwitchSettings& settings = script.draft().switching.emplace();
  settings.load_share = given.number("load_share");
  settings.visible_strain = given.number("visible_strain");
  settings.calm_load_share = given.number("calm_load_share");
  settings.steady_load_share = given.number("steady_load_share");
  settings.calm_ticks = given.whole("calm_ticks");
  settings.load_time = given.number("load_time");
  return 0;
}

std::vector<Field> switching_fields() {
  const bullet::SwitchSettings usual;
  return {number("load_share", "",
                 "a piece becomes a lattice when a load would strain it by this share of what "
                 "breaks its weakest spring")
              .or_else(usual.load_share)
              .between(1e-6, 1e6),
          number("visible_strain", "", "or by this strain, whatever it bears")
              .or_else(usual.visible_strain)
              .between(1e-9, 1e6),
          number("calm_load_share", "",
                 "a lattice becomes rigid when its springs bear less than this share of what "
                 "breaks them")
              .or_else(usual.calm_load_share)
              .between(1e-6, 1e6),
          number("steady_load_share", "", "or what they bear changes by less than this in a tick")
              .or_else(usual.steady_load_share)
              .between(1e-6, 1e6),
          field("calm_ticks", Kind::kWhole, "", "for so many ticks")
              .or_else(static_cast<double>(usual.calm_ticks))
              .between(1.0, 1e6),
          number("load_time", "s", "over which loads are averaged")
              .or_else(usual.load_time)
              .between(1e-4, 1e3)};
}

std::vector<Field> parameter_fields() {
  return {field("name", Kind::kText, "", "as in --set NAME=VALUE"),
          number("value", "", "without --set"),
          field("unit", Kind::kText, "", "SI").or_else(std::string()),
          field("meaning", Kind::kText, "", "what it changes").or_else(std::string()),
          number("least", "", "smallest value that is allowed"),
          number("most", "", "largest value that is allowed")};
}

std::vector<Field> scene_fields() {
  return {field("summary", Kind::kText, "", "one line, for `limber run`").or_else(std::string()),
          number("seconds", "s", "how long it runs without --seconds")
              .or_else(4.0)
              .between(1e-3, kForever),
          number("tick", "s", "step of the rigid world").or_else(1.0 / 60.0).between(1e-5, 0.1),
          field("gravity", Kind::kVector, "m/s^2", "on everything")
              .or_else(Vec3(0.0, -9.81, 0.0))
              .between(-1e4, 1e4),
          field("floor", Kind::kFlag, "", "is there a floor at y = 0").or_else(true),
          number("floor_friction", "", "its Coulomb coefficient").or_else(0.5).between(0.0, 10.0),
          records("parameters", parameter_fields(), "numbers that --set changes").optional()};
}

std::vector<Field> camera_fields() {
  return {
      field("position", Kind::kVector, "m", "of the eye").between(-1e6, 1e6),
      field("target", Kind::kVector, "m", "what it looks at").between(-1e6, 1e6),
      number("field_of_view_deg", "degrees", "vertical: any shape of picture shows the same height")
          .or_else(30.0)
          .between(1.0, 170.0),
      number("zoom", "", "above 0 the camera goes where the objects fill the picture at 1")
          .or_else(0.0)
          .between(0.0, 100.0)};
}

}  // namespace

std::vector<ApiFunction> scene_functions() {
  const Field seconds = number("seconds", "s", "of simulated time").between(0.0, kForever);
  const Field call = field("call", Kind::kFunction, "", "what is called");
  return {
      {"", "scene",
       "Says what the scene is, first of all. Gives back a table with the value of each parameter.",
       scene_fields(), "table", R"(local set = scene{
  summary = "a stone falls",
  seconds = 2,
  parameters = {
    {name = "height", value = 1, unit = "m", meaning = "of the fall", least = 0, most = 50},
  },
}
rigid.sphere{radius = 0.1, mass = 1, position = {0, set.height, 0}})",
       set_scene},
      {"", "camera", "Where pictures are taken from.", camera_fields(), "",
       "camera{position = {1, 1, 2}, target = {0, 0.5, 0}}", set_camera},
      {"",
       "light",
       "A point that shines in all directions. Without any the light goes with the camera.",
       {field("position", Kind::kVector, "m", "where it is").between(-1e6, 1e6),
        field("colour", Kind::kColour, "", "linear red, green, blue")
            .or_else(Vec3(1.0, 1.0, 1.0))
            .between(0.0, 1.0),
        number("brightness", "", "1 shows colours as they are").or_else(1.0).between(0.0, 100.0),
        field("shadows", Kind::kFlag, "", "does it throw shadows").or_else(true)},
       "",
       "light{position = {2, 3, 2}, brightness = 1.2}",
       add_light},
      {"",
       "time",
       "The simulated time, s.",
       {},
       "number",
       "function on_tick(dt)\n  assert(time() >= 0)\nend",
       time_now},
      {"",
       "after",
       "Calls a function once, so many seconds from now.",
       {seconds, call},
       "",
       "after{seconds = 0.02, call = function() print(\"now\") end}",
       call_after},
      {"",
       "every",
       "Calls a function again and again, until it returns false.",
       {number("seconds", "s", "of simulated time between two calls").between(1e-4, kForever),
        call},
       "",
       "local n = 0\nevery{seconds = 0.01, call = function()\n  n = n + 1\n  return n < 3\nend}",
       call_every},
      {"",
       "play",
       "Plays an input at a time, as a player would: on_input(name, value) is called.",
       {field("name", Kind::kText, "", "of the input"),
        number("at", "s", "simulated time").between(0.0, kForever),
        number("value", "", "that goes with it").or_else(1.0)},
       "",
       "function on_input(name, value) print(name, value) end\nplay{name = \"throw\", at = 0.01}",
       play},
      {"", "switching", "When pieces become lattices and rigid bodies again, in this scene.",
       switching_fields(), "", "switching{load_share = 0.1, calm_ticks = 10}", set_switching},
      {"",
       "overlap",
       "What a ball or a box would touch: a list of objects and bodies, and whether it reaches the "
       "floor. Bodies count with their inside, objects by their surface.",
       {field("centre", Kind::kVector, "m", "of the ball or box").between(-1e6, 1e6),
        number("radius", "m", "of a ball").between(1e-4, 1e4).optional(),
        field("size", Kind::kVector, "m", "the edges of a box").between(1e-4, 1e4).optional(),
        rotation_field("of the box about its centre")},
       "table, boolean",
       "local ball = rigid.sphere{radius = 0.1, mass = 1, position = {0, 1, 0}}\n"
       "function on_start()\n  local things, floor = overlap{centre = {0, 1, 0}, radius = 0.2}\n"
       "  assert(things[1] == ball and not floor)\nend",
       find_overlaps,
       true},
      {"",
       "ray",
       "The first thing on the way between two places: a table of thing (nil: the floor), at, "
       "normal, distance; nil where there is none.",
       {field("from", Kind::kVector, "m", "where it starts").between(-1e6, 1e6),
        field("to", Kind::kVector, "m", "where it ends").between(-1e6, 1e6)},
       "table|nil",
       "function on_start()\n  local hit = ray{from = {0, 1, 0}, to = {0, -1, 0}}\n"
       "  assert(math.abs(hit.at.y) < 1e-3)\nend",
       cast_ray,
       true}};
}

const std::vector<ApiCallback>& api_callbacks() {
  const Field time = number("time", "s", "when it happened");
  const Field object = field("object", Kind::kThing, "", "whose it is");
  const std::vector<Field> switched = {
      object, field("cause", Kind::kText, "", "touch, sustained load, missed touch, calm"), time,
      number("piece", "", "counts up over the whole run")};
  static const std::vector<ApiCallback> callbacks = {
      {"on_start", "Before the first tick.", {}, {}, "function on_start() print(\"go\") end"},
      {"on_tick",
       "Before every tick, after timers and inputs.",
       {number("dt", "s", "length of the tick")},
       {},
       "function on_tick(dt) assert(dt > 0) end"},
      {"on_input",
       "An input of the player, or of play{}.",
       {field("name", Kind::kText, "", "of the input"), number("value", "", "that goes with it")},
       {},
       "function on_input(name, value) print(name, value) end"},
      {"on_contact",
       "Two things began to press on one another, whichever they are just now; of two lattices "
       "that touch one another on_flexible alone tells.",
       {},
       {field("thing", Kind::kThing, "", "one of them: of a body and an object the body"),
        field("other", Kind::kThing, "", "the other; nil: the floor"),
        field("at", Kind::kVector, "m", "where"),
        number("impulse", "N s", "of this tick, the size of all pushes")},
       "rigid.sphere{radius = 0.1, mass = 1, position = {0, 0.1, 0}}\n"
       "function on_contact(event) assert(event.impulse > 0) end"},
      {"on_flexible",
       "A piece became a lattice.",
       {},
       switched,
       "function on_flexible(event) print(event.object:name(), event.cause) end"},
      {"on_rigid",
       "A piece became a rigid body.",
       {},
       switched,
       "function on_rigid(event) print(event.object:name(), event.cause) end"},
      {"on_break",
       "A spring broke.",
       {},
       {object, field("at", Kind::kVector, "m", "where"), time,
        number("edge", "", "which, from 1 on")},
       "function on_break(event) print(event.at) end"},
      {"on_split",
       "A piece came apart.",
       {},
       {object, time, number("pieces", "", "that it became"),
        number("particles", "", "points without springs that came off")},
       "function on_split(event) print(event.pieces) end"}};
  return callbacks;
}

}  // namespace limber::demos

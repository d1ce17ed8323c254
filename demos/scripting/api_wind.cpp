#include "demos/scripting/api.h"
#include "demos/scripting/lua_state.h"
#include "demos/scripting/script.h"

// The air, and the primitives that make its wind.

namespace limber::demos {
namespace {

constexpr double kMostStrength = 1e6;
constexpr std::size_t kMostFlows = 1000;

// The wind while the scene is set up, or while it runs.
Air& air_of(const Arguments& given) {
  Script& script = script_of(given.lua());
  if (script.simulation()) {
    script.air_changed();
    return script.air();
  }
  Scene& scene = script.draft();
  if (!scene.air) scene.air = Air{};
  return *scene.air;
}

FlowBounds bounds_of_flow(const Arguments& given) {
  FlowBounds bounds;
  if (!given.has("within")) return bounds;
  given.each("within", [&](const Arguments& of) {
    bounds.centre = of.vector("centre");
    bounds.radius = of.number("radius");
    bounds.fade = of.number("fade");
  });
  return bounds;
}

int give_flow(const Arguments& given, FlowPrimitive flow) {
  flow.bounds = bounds_of_flow(given);
  Air& air = air_of(given);
  if (air.wind.primitives.size() >= kMostFlows) {
    throw InputError(
        {given.where(), "there are 1000 primitives already", "change one: flow:set{}"});
  }
  air.wind.primitives.push_back(std::move(flow));
  push(given.lua(), FlowHandle{air.wind.primitives.size() - 1});
  return 1;
}

int make_uniform(const Arguments& given) {
  FlowPrimitive flow;
  flow.direction = given.vector("direction");
  flow.strength = given.steps("speed");
  return give_flow(given, std::move(flow));
}

int make_flow(const Arguments& given, FlowKind kind, bool line, bool directed) {
  FlowPrimitive flow;
  flow.kind = kind;
  flow.position = given.path("position");
  if (line) flow.axis = given.vector("axis");
  if (directed) flow.direction = given.vector("direction");
  flow.strength = given.steps("strength");
  flow.core_radius = given.number("core_radius");
  return give_flow(given, std::move(flow));
}

int set_density(const Arguments& given) {
  air_of(given).density = given.number("density");
  return 0;
}

int set_flow(const Arguments& given) {
  FlowPrimitive& flow = air_of(given).wind.primitives[self<FlowHandle>(given).index];
  if (given.has("position")) flow.position = given.path("position");
  if (given.has("direction")) flow.direction = given.vector("direction");
  if (given.has("strength")) flow.strength = given.steps("strength");
  return 0;
}

Field within_field() {
  return record(
             "within",
             {field("centre", Kind::kVector, "m", "of the ball where it blows")
                  .or_else(Vec3(0.0, 0.0, 0.0))
                  .between(-kMostMetres, kMostMetres),
              number("radius", "m", "of that ball").between(0.0, kMostMetres),
              number("fade", "m", "beyond it, to nothing").or_else(0.0).between(0.0, kMostMetres)},
             "everywhere without it")
      .optional();
}

Field path_field() {
  return field("position", Kind::kPath, "m", "of its middle, or of a point of its axis; may move")
      .or_else(Vec3(0.0, 0.0, 0.0));
}

std::vector<Field> flow_fields(const char* unit, const char* strength, bool line, bool directed) {
  std::vector<Field> fields = {path_field()};
  if (line) {
    fields.push_back(field("axis", Kind::kDirection, "", "of it").or_else(Vec3(0.0, 1.0, 0.0)));
  }
  if (directed) {
    fields.push_back(field("direction", Kind::kDirection, "", "from sink to source"));
  }
  fields.push_back(
      field("strength", Kind::kSteps, unit, strength).between(-kMostStrength, kMostStrength));
  fields.push_back(number("core_radius", "m", "within which it falls to nothing")
                       .or_else(0.01)
                       .between(1e-6, kMostMetres));
  fields.push_back(within_field());
  return fields;
}

}  // namespace

std::vector<ApiFunction> wind_functions() {
  return {
      {"wind",
       "air",
       "Sets the density of the air. Any primitive brings air as well.",
       {number("density", "kg/m^3", "of the air").or_else(1.225).between(0.0, 1e4)},
       "",
       "wind.air{density = 1.2}",
       set_density},
      {"wind",
       "uniform",
       "The same wind everywhere.",
       {field("direction", Kind::kDirection, "", "where it blows"),
        field("speed", Kind::kSteps, "m/s", "of it; may change with time")
            .between(-kMostStrength, kMostStrength),
        within_field()},
       "flow",
       "wind.uniform{direction = {1, 0, 0}, speed = {{0, 0}, {2, 8}}}",
       make_uniform},
      {"wind", "vortex", "A whirl about a line: S / (2 pi r) across.",
       flow_fields("m^2/s", "circulation, right-handed about the axis", true, false), "flow",
       "wind.vortex{axis = {0, 1, 0}, strength = 6, core_radius = 0.3}",
       [](const Arguments& given) { return make_flow(given, FlowKind::kLineVortex, true, false); }},
      {"wind", "line_source", "Blows away from a line: S / (2 pi r).",
       flow_fields("m^2/s", "what flows out; below 0 a sink", true, false), "flow",
       "wind.line_source{axis = {0, 1, 0}, strength = -3, core_radius = 0.3}",
       [](const Arguments& given) { return make_flow(given, FlowKind::kLineSource, true, false); }},
      {"wind", "point_source", "Blows away from a point: S / (4 pi r^2).",
       flow_fields("m^3/s", "what flows out; below 0 a sink", false, false), "flow",
       "wind.point_source{position = {0, 2, 0}, strength = 5}",
       [](const Arguments& given) {
         return make_flow(given, FlowKind::kPointSource, false, false);
       }},
      {"wind", "line_doublet",
       "Flow around a pillar that moves: a source and a sink, side by side.",
       flow_fields("m^3/s", "2 pi R^2 times the speed of a pillar of radius R", true, true), "flow",
       "wind.line_doublet{direction = {-1, 0, 0}, strength = 1, core_radius = 0.3}",
       [](const Arguments& given) { return make_flow(given, FlowKind::kLineDoublet, true, true); }},
      {"wind", "point_doublet", "Flow around a ball that moves.",
       flow_fields("m^4/s", "2 pi R^3 times the speed of a ball of radius R", false, true), "flow",
       "wind.point_doublet{direction = {-1, 0, 0}, strength = 0.1, core_radius = 0.2}",
       [](const Arguments& given) {
         return make_flow(given, FlowKind::kPointDoublet, false, true);
       }},
      {"flow",
       "set",
       "Changes it, from the next tick on; what is left out stays.",
       {path_field().optional(),
        field("direction", Kind::kDirection, "", "of uniform wind and doublets").optional(),
        field("strength", Kind::kSteps, "", "in its own unit; the speed of uniform wind, m/s")
            .between(-kMostStrength, kMostStrength)
            .optional()},
       "",
       "local gust = wind.uniform{direction = {1, 0, 0}, speed = 1}\n"
       "function on_tick() gust:set{strength = 2 + math.sin(time())} end",
       set_flow}};
}

}  // namespace limber::demos

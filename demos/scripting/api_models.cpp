#include <cmath>

#include "core/model/bounds.h"
#include "core/model/validate.h"
#include "core/modeller/bending_springs.h"
#include "core/modeller/flaws.h"
#include "core/modeller/material.h"
#include "core/operators/gluing_operator.h"
#include "demos/scripting/api.h"
#include "demos/scripting/lua_state.h"
#include "demos/scripting/script.h"

// What is done to a model before it is spawned.

namespace limber::demos {
namespace {

PhysicalModel& model_of(const Arguments& given) { return *self<ModelHandle>(given); }

// The model itself, so that calls can be chained.
int give_back(const Arguments& given) {
  lua_pushvalue(given.lua(), 1);
  return 1;
}

void count_points(const Arguments& given, const PhysicalModel& model) {
  script_of(given.lua()).take_points(static_cast<double>(model.points.size()));
}

int place_model(const Arguments& given) {
  place(model_of(given), given.rotation("rotation"), given.vector("position"));
  return give_back(given);
}

int set_moving(const Arguments& given) {
  PhysicalModel& model = model_of(given);
  const Vec3 velocity = given.vector("velocity"), spin = given.vector("spin");
  if (given.has("centre")) {
    set_in_motion(model, velocity, spin, given.vector("centre"));
  } else {
    set_in_motion(model, velocity, spin);
  }
  return give_back(given);
}

int copy_model(const Arguments& given) {
  count_points(given, model_of(given));
  push(given.lua(), std::make_shared<PhysicalModel>(model_of(given)));
  return 1;
}

int rename_model(const Arguments& given) {
  model_of(given).name = given.text("name");
  return give_back(given);
}

GlueBond bond_of(const Arguments& given) {
  GlueBond bond;
  given.each("bond", [&](const Arguments& of) {
    bond.distance = of.number("distance");
    bond.stiffness = of.number("stiffness");
    bond.damping = of.number("damping");
    bond.break_strain = of.number("break_strain");
    bond.crush_strain = of.number("crush_strain");
    bond.one_to_one = of.flag("one_to_one");
  });
  return bond;
}

int glue_models(const Arguments& given) {
  const PhysicalModel& other = **given.handle<ModelHandle>("to");
  count_points(given, model_of(given));
  count_points(given, other);
  PhysicalModel glued = glue(model_of(given), other, bond_of(given)).model;
  glued.name = model_of(given).name;
  push(given.lua(), std::make_shared<PhysicalModel>(std::move(glued)));
  return 1;
}

int make_flaws(const Arguments& given) {
  add_flaws(model_of(given),
            {given.number("scatter"), given.whole("seams"), given.number("seam_strength"),
             static_cast<std::uint64_t>(given.number("seed"))});
  return give_back(given);
}

int resist_bending(const Arguments& given) {
  const Material material = given.material("material");
  BendingSprings springs;
  springs.youngs_modulus = material.effective_modulus();
  springs.thickness = given.number("thickness");
  springs.strain_at_break = material.effective_strain_at_break();
  add_bending_springs(model_of(given), springs);
  return give_back(given);
}

int set_damping(const Arguments& given) {
  set_stiffness_proportional_damping(model_of(given), given.number("ratio"));
  return give_back(given);
}

void set_look(const Arguments& given, SurfaceProperties& surface) {
  if (given.has("colour")) surface.colour = given.vector("colour");
  if (given.has("specularity")) surface.specularity = given.number("specularity");
  if (given.has("transparency")) surface.transparency = given.number("transparency");
  if (given.has("index_of_refraction")) {
    surface.index_of_refraction = given.number("index_of_refraction");
  }
  if (given.has("strand_radius")) surface.strand_radius = given.number("strand_radius");
}

int look_of(const Arguments& given) {
  PhysicalModel& model = model_of(given);
  const std::string wanted = given.has("part") ? given.text("part") : "";
  bool found = false;
  for (std::size_t i = 0; i < model.parts.size(); ++i) {
    if (!wanted.empty() && model.geometry.subobjects[i].name != wanted) continue;
    set_look(given, model.parts[i].surface);
    found = true;
  }
  if (!found) {
    throw InputError({given.where(), "'" + model.name + "' has no part '" + wanted + "'",
                      "leave 'part' out for all of it, or name one as it was made"});
  }
  return give_back(given);
}

int set_drag(const Arguments& given) {
  FaceAttributes drag;
  const std::string law = given.text("law");
  drag.drag_law = law == "linear"     ? DragLaw::kLinear
                  : law == "pressure" ? DragLaw::kPressure
                                      : DragLaw::kQuadratic;
  drag.normal_drag = given.number("normal");
  drag.tangential_drag = given.number("tangential");
  for (FaceAttributes& face : model_of(given).faces) face = drag;
  return give_back(given);
}

int set_contact(const Arguments& given) {
  ObjectAttributes& object = model_of(given).object;
  if (given.has("friction")) object.friction = given.number("friction");
  if (given.has("restitution")) object.restitution = given.number("restitution");
  if (given.has("internal_damping")) object.internal_damping = given.number("internal_damping");
  if (given.has("contact_share")) object.contact_share = given.number("contact_share");
  return give_back(given);
}

// The element that a script counts from 1.
template <class Id, class Items>
Id element(const Arguments& given, const Items& items, const char* what) {
  const double index = given.number("index");
  if (index <= static_cast<double>(items.size())) {
    return Id(static_cast<std::size_t>(index) - 1);
  }
  throw InputError({given.where(), std::string("'index' is beyond the last ") + what,
                    "give 1 to " + std::to_string(items.size())});
}

PointId point_id(const Arguments& given) {
  return element<PointId>(given, model_of(given).points, "point");
}

int count_all_points(const Arguments& given) {
  lua_pushinteger(given.lua(), static_cast<lua_Integer>(model_of(given).points.size()));
  return 1;
}

int count_all_edges(const Arguments& given) {
  lua_pushinteger(given.lua(), static_cast<lua_Integer>(model_of(given).edges.size()));
  return 1;
}

int read_point(const Arguments& given) {
  const PhysicalModel& model = model_of(given);
  const PointId p = point_id(given);
  lua_State* const lua = given.lua();
  lua_createtable(lua, 0, 4);
  push(lua, model.geometry.points[p]);
  lua_setfield(lua, -2, "position");
  push(lua, model.points[p].velocity);
  lua_setfield(lua, -2, "velocity");
  lua_pushnumber(lua, model.points[p].mass);
  lua_setfield(lua, -2, "mass");
  lua_pushboolean(lua, model.points[p].pinned);
  lua_setfield(lua, -2, "pinned");
  return 1;
}

int set_point(const Arguments& given) {
  PhysicalModel& model = model_of(given);
  const PointId p = point_id(given);
  if (given.has("position")) model.geometry.points[p] = given.vector("position");
  if (given.has("velocity")) model.points[p].velocity = given.vector("velocity");
  if (given.has("mass")) model.points[p].mass = given.number("mass");
  if (given.has("pinned")) model.points[p].pinned = given.flag("pinned");
  return give_back(given);
}

int pin_point(const Arguments& given) {
  PhysicalModel& model = model_of(given);
  if (given.has("index")) {
    model.points[point_id(given)].pinned = true;
    return give_back(given);
  }
  if (!given.has("low") || !given.has("high")) {
    throw InputError({given.where(), "neither 'index' nor both of 'low' and 'high' are given",
                      "say which point, or which box of space"});
  }
  const Box3 box(given.vector("low"), given.vector("high"));
  for (PointId p : ids_of(model.points)) {
    if (box.contains(model.geometry.points[p])) model.points[p].pinned = true;
  }
  return give_back(given);
}

EdgeId edge_id(const Arguments& given) {
  return element<EdgeId>(given, model_of(given).edges, "edge");
}

int read_edge(const Arguments& given) {
  const PhysicalModel& model = model_of(given);
  const EdgeId e = edge_id(given);
  const EdgeAttributes& edge = model.edges[e];
  lua_State* const lua = given.lua();
  lua_createtable(lua, 0, 8);
  const std::pair<const char*, double> values[] = {{"a", model.geometry.edges[e].a.value + 1.0},
                                                   {"b", model.geometry.edges[e].b.value + 1.0},
                                                   {"stiffness", edge.stiffness},
                                                   {"damping", edge.damping},
                                                   {"rest_length", edge.rest_length},
                                                   {"break_threshold", edge.break_threshold},
                                                   {"crush_threshold", edge.crush_threshold}};
  for (const auto& [name, value] : values) {
    lua_pushnumber(lua, value);
    lua_setfield(lua, -2, name);
  }
  lua_pushboolean(lua, edge.broken);
  lua_setfield(lua, -2, "broken");
  return 1;
}

int set_edge(const Arguments& given) {
  EdgeAttributes& edge = model_of(given).edges[edge_id(given)];
  if (given.has("stiffness")) edge.stiffness = given.number("stiffness");
  if (given.has("damping")) edge.damping = given.number("damping");
  if (given.has("rest_length")) edge.rest_length = given.number("rest_length");
  if (given.has("break_threshold")) edge.break_threshold = given.number("break_threshold");
  if (given.has("crush_threshold")) edge.crush_threshold = given.number("crush_threshold");
  return give_back(given);
}

int mass_of(const Arguments& given) {
  lua_pushnumber(given.lua(), total_mass(model_of(given)));
  return 1;
}

int centre_of(const Arguments& given) {
  push(given.lua(), centre_of_mass(model_of(given)));
  return 1;
}

int bounds_of_model(const Arguments& given) {
  const Box3 box = bounds_of(model_of(given).geometry.points);
  push(given.lua(), Vec3(box.min()));
  push(given.lua(), Vec3(box.max()));
  return 2;
}

Field strain(const char* name, const char* meaning) {
  return number(name, "", meaning).or_else(kUnbreakable).above(0.0).up_to_infinity();
}

std::vector<Field> glue_fields() {
  return {field("to", Kind::kModel, "", "the other model"),
          record("bond",
                 {number("distance", "m", "points as near as this are joined").above(0.0),
                  number("stiffness", "N/m", "of a bond").above(0.0),
                  number("damping", "N s/m", "of a bond").or_else(0.0).at_least(0.0),
                  strain("break_strain", "in tension"), strain("crush_strain", "in compression"),
                  field("one_to_one", Kind::kFlag, "", "is each point joined once at most")
                      .or_else(false)},
                 "what joins each pair of points; bond{} makes one")};
}

Field index_field(const char* what) { return field("index", Kind::kWhole, "", what).at_least(1.0); }

std::vector<Field> edge_fields() {
  return {index_field("which edge, from 1 on"),
          number("stiffness", "N/m", "of its spring").at_least(0.0).optional(),
          number("damping", "N s/m", "along it").at_least(0.0).optional(),
          number("rest_length", "m", "without force").above(0.0).optional(),
          number("break_threshold", "m", "of stretch that it bears")
              .above(0.0)
              .up_to_infinity()
              .optional(),
          number("crush_threshold", "m", "of shortening that it bears")
              .above(0.0)
              .up_to_infinity()
              .optional()};
}

}  // namespace

std::vector<ApiFunction> model_functions() {
  const std::string kBox =
      "local box = shape.box{size = {0.2, 0.2, 0.2}, cells = {2, 2, 2}, material = \"rubber\"}\n";
  const Field place = field("position", Kind::kVector, "m", "where its origin goes")
                          .or_else(Vec3(0.0, 0.0, 0.0))
                          .between(-kMostMetres, kMostMetres);
  const auto speed = [](const char* name, const char* unit, const char* meaning) {
    return field(name, Kind::kVector, unit, meaning)
        .or_else(Vec3(0.0, 0.0, 0.0))
        .between(-kMostSpeed, kMostSpeed);
  };
  const auto corner = [](const char* name, const char* meaning) {
    return field(name, Kind::kVector, "m", meaning).between(-kMostMetres, kMostMetres).optional();
  };
  const auto share = [](const char* name, const char* meaning) {
    return number(name, "", meaning).between(0.0, 1.0).optional();
  };
  return {
      {"model",
       "place",
       "Turns it about the world's origin, then shifts it.",
       {place, rotation_field("about the world's origin")},
       "model",
       kBox + "box:place{position = {0, 1, 0}, rotation = {axis = {0, 0, 1}, angle = 0.3}}",
       place_model},
      {"model",
       "set_in_motion",
       "Adds the motion of a rigid body to that of its points.",
       {speed("velocity", "m/s", "of its centre"), speed("spin", "rad/s", "about its centre"),
        corner("centre", "that it spins about; the centre of mass without it")},
       "model",
       kBox + "box:set_in_motion{velocity = {1, 0, 0}, spin = {0, 3, 0}}",
       set_moving},
      {"model",
       "copy",
       "Another model, the same in everything.",
       {},
       "model",
       kBox + "local twin = box:copy()\ntwin:place{position = {0.5, 0, 0}}",
       copy_model},
      {"model",
       "rename",
       "Gives it another name for reports.",
       {field("name", Kind::kText, "", "the new name")},
       "model",
       kBox + "box:rename{name = \"crate\"}",
       rename_model},
      {"model", "glue",
       "A new model of both, with a spring between every two points that are near enough.",
       glue_fields(), "model",
       kBox + "local other = box:copy():place{position = {0.21, 0, 0}}\n"
              "local both = box:glue{to = other, bond = {distance = 0.011, stiffness = 1000}}",
       glue_models},
      {"model",
       "flaws",
       "Makes its springs unequally strong, with weak seams through it.",
       {number("scatter", "", "standard deviation of the thresholds, as a share")
            .or_else(0.0)
            .between(0.0, 0.33),
        field("seams", Kind::kWhole, "", "regions that the seams divide it into")
            .or_else(0.0)
            .between(0.0, 1e4),
        number("seam_strength", "", "thresholds on a seam, as a share")
            .or_else(1.0)
            .between(1e-6, 1.0),
        number("seed", "", "of both").or_else(1.0).between(0.0, 1e15)},
       "model",
       kBox + "box:flaws{scatter = 0.1, seams = 3, seam_strength = 0.3}",
       make_flaws},
      {"model",
       "resist_bending",
       "Adds springs that keep a bent sheet bent.",
       {field("material", Kind::kMaterial, "", "of the sheet"),
        number("thickness", "m", "of the sheet").above(0.0)},
       "model",
       R"(local leaf = shape.sheet{
  surface = function(u, v) return vec(u, 0.2 * math.sin(3 * u), -v) end,
  cells_u = 6, cells_v = 4, thickness = 1e-3, material = "leaf"}
leaf:resist_bending{material = "leaf", thickness = 1e-3})",
       resist_bending},
      {"model",
       "set_damping",
       "Damps all springs in proportion to their stiffness; after gluing and set_edge{}.",
       {number("ratio", "", "of the highest frequency").between(0.0, 10.0)},
       "model",
       kBox + "box:set_damping{ratio = 0.1}",
       set_damping},
      {"model",
       "look",
       "How it looks.",
       {field("part", Kind::kText, "", "the name of one part; all without it").optional(),
        field("colour", Kind::kColour, "", "linear red, green, blue").between(0.0, 1.0).optional(),
        share("specularity", "0 dull, 1 shiny"), share("transparency", "0 opaque, 1 clear"),
        number("index_of_refraction", "", "1.33 water, 1.5 glass").between(1.0, 4.0).optional(),
        number("strand_radius", "m", "of what has no faces").between(0.0, 100.0).optional()},
       "model",
       kBox + "box:look{colour = {0.8, 0.2, 0.1}, specularity = 0.6}",
       look_of},
      {"model",
       "drag",
       "How its faces resist the air.",
       {choice("law", {"quadratic", "linear", "pressure"}, "of the force over the speed")
            .or_else(std::string("quadratic")),
        number("normal", "", "coefficient across the wind").or_else(0.0).between(0.0, 1e3),
        number("tangential", "", "coefficient along it").or_else(0.0).between(0.0, 1e3)},
       "model",
       kBox + "box:drag{normal = 1.2, tangential = 0.01}",
       set_drag},
      {"model",
       "contact",
       "How it touches other things.",
       {number("friction", "", "Coulomb coefficient").between(0.0, 10.0).optional(),
        share("restitution", "share of the speed that a bounce keeps"),
        number("internal_damping", "1/s", "draws pieces towards rigid motion")
            .between(0.0, 1e6)
            .optional(),
        number("contact_share", "",
               "radius of a point as a share of its shortest edge; 0: points "
               "pass one another")
            .between(0.0, 0.45)
            .optional()},
       "model",
       kBox + "box:contact{friction = 0.2, restitution = 0.5}",
       set_contact},
      {"model",
       "pin",
       "Holds points where they are.",
       {index_field("one point, from 1 on").optional(),
        corner("low", "with high: all points in this box"), corner("high", "of the box")},
       "model",
       kBox + "box:pin{low = {-1, 0.05, -1}, high = {1, 1, 1}}",
       pin_point},
      {"model",
       "points",
       "How many points it has.",
       {},
       "integer",
       kBox + "assert(box:points() == 27)",
       count_all_points},
      {"model",
       "point",
       "A table of position, velocity, mass and pinned.",
       {index_field("which point, from 1 on")},
       "table",
       kBox + "assert(box:point{index = 1}.mass > 0)",
       read_point},
      {"model",
       "set_point",
       "Changes one point.",
       {index_field("which point, from 1 on"), corner("position", "of it"),
        field("velocity", Kind::kVector, "m/s", "of it")
            .between(-kMostSpeed, kMostSpeed)
            .optional(),
        number("mass", "kg", "of it").above(0.0).optional(),
        field("pinned", Kind::kFlag, "", "is it held").optional()},
       "model",
       kBox + "box:set_point{index = 1, velocity = {0, 1, 0}}",
       set_point},
      {"model",
       "edges",
       "How many edges, springs, it has.",
       {},
       "integer",
       kBox + "assert(box:edges() > 100)",
       count_all_edges},
      {"model",
       "edge",
       "A table of the points a and b, stiffness, damping, rest_length, thresholds and broken.",
       {index_field("which edge, from 1 on")},
       "table",
       kBox + "assert(box:edge{index = 1}.rest_length > 0)",
       read_edge},
      {"model", "set_edge", "Changes one spring.", edge_fields(), "model",
       kBox + "box:set_edge{index = 1, break_threshold = 0.001}", set_edge},
      {"model", "mass", "Its mass, kg.", {}, "number", kBox + "assert(box:mass() > 0)", mass_of},
      {"model",
       "centre",
       "Its centre of mass, m.",
       {},
       "vec",
       kBox + "assert(box:centre():length() < 1e-6)",
       centre_of},
      {"model",
       "bounds",
       "The lowest and the highest corner of the box around it, m.",
       {},
       "vec, vec",
       kBox + "local low, high = box:bounds()\nassert(low.y < high.y)",
       bounds_of_model}};
}

}  // namespace limber::demos

#include <fmt/format.h>

#include <algorithm>

#include "core/model/nearest_name.h"
#include "core/modeller/glue_material.h"
#include "core/modeller/material_table.h"
#include "demos/scripting/api.h"
#include "demos/scripting/lua_state.h"

// Materials, and the glue that is like one.

namespace limber::demos {
namespace {

// A value of a material: the field that sets it and where it stands.
struct MaterialValue {
  Field field;
  double Material::*member;

  const std::string& name() const { return field.name; }
};

const std::vector<MaterialValue>& material_values() {
  static const std::vector<MaterialValue> values = {
      {number("density", "kg/m^3", "of the real material").above(0.0), &Material::density},
      {number("youngs_modulus", "Pa", "of the real material").above(0.0),
       &Material::youngs_modulus},
      {number("poisson_ratio", "", "of the real material; for notes alone").between(-1.0, 0.5),
       &Material::poisson_ratio},
      {number("strain_at_break", "", "in tension, of the real material")
           .above(0.0)
           .up_to_infinity(),
       &Material::strain_at_break},
      {number("strain_at_crush", "", "in compression, of the real material")
           .above(0.0)
           .up_to_infinity(),
       &Material::strain_at_crush},
      {number("damping_ratio", "", "at the lattice's highest frequency").between(0.0, 10.0),
       &Material::damping_ratio},
      {number("internal_damping", "1/s", "draws pieces towards rigid motion").at_least(0.0),
       &Material::internal_damping},
      {number("friction", "", "Coulomb coefficient").between(0.0, 10.0), &Material::friction},
      {number("restitution", "", "share of the speed that a bounce keeps").between(0.0, 1.0),
       &Material::restitution},
      {number("softening", "", "S: modulus / S, strain at break x sqrt S").between(1.0, 1e12),
       &Material::softening}};
  return values;
}

std::vector<Field> material_fields() {
  std::vector<Field> fields = {
      field("like", Kind::kMaterial, "", "what it is like but for the rest").optional()};
  for (const MaterialValue& value : material_values()) fields.push_back(value.field.optional());
  return fields;
}

int make_material(const Arguments& given) {
  Material material;
  if (given.has("like")) material = given.material("like");
  for (const MaterialValue& value : material_values()) {
    if (given.has(value.name().c_str())) {
      material.*value.member = given.number(value.name().c_str());
    }
  }
  require_valid(material, given.where());
  push(given.lua(), material);
  return 1;
}

// __index of a material.
int material_value(lua_State* lua) {
  const Material& material = *as<Material>(lua, 1);
  const std::string name = lua_type(lua, 2) == LUA_TSTRING ? lua_tostring(lua, 2) : "?";
  std::vector<Field> fields;
  for (const MaterialValue& value : material_values()) {
    if (value.name() == name) {
      lua_pushnumber(lua, material.*value.member);
      return 1;
    }
    fields.push_back(value.field);
  }
  raise(lua, fmt::format("a material has no '{}'; did you mean '{}'?", name,
                         nearest_name(fields, name)));
}

int refuse_change(lua_State* lua) {
  raise(lua, "a material does not change; make another: material{like = this, ...}");
}

int make_bond(const Arguments& given) {
  const Material material = given.material("material");
  const GlueBond bond = bond_like(material, given.number("area"), given.number("gap"));
  lua_State* const lua = given.lua();
  lua_createtable(lua, 0, 5);
  const std::pair<const char*, double> values[] = {{"distance", bond.distance},
                                                   {"stiffness", bond.stiffness},
                                                   {"damping", bond.damping},
                                                   {"break_strain", bond.break_strain},
                                                   {"crush_strain", bond.crush_strain}};
  for (const auto& [name, value] : values) {
    lua_pushnumber(lua, value);
    lua_setfield(lua, -2, name);
  }
  return 1;
}

}  // namespace

void open_materials(lua_State* lua) {
  new_type<Material>(lua);
  lua_pushcfunction(lua, material_value);
  lua_setfield(lua, -2, "__index");
  lua_pushcfunction(lua, refuse_change);
  lua_setfield(lua, -2, "__newindex");
  lua_pop(lua, 1);
}

std::vector<ApiFunction> material_functions() {
  return {{"", "material",
           "A material, from nothing or like another. Its values can be read: "
           "stone.youngs_modulus. The names of those that Limber knows are in materials.md.",
           material_fields(), "material",
           "local brick = material{like = \"stoneware\", softening = 1000}\n"
           "assert(brick.density > 0)",
           make_material},
          {"",
           "bond",
           "Glue as stiff and strong as a material across a gap: the table that model:glue{} "
           "takes, whose fields may be changed before.",
           {field("material", Kind::kMaterial, "", "what it is like"),
            number("area", "m^2", "of the seam, for each pair of points").above(0.0),
            number("gap", "m", "between the two sides").above(0.0)},
           "table",
           "local glue = bond{material = \"spruce\", area = 1e-4, gap = 0.01}\n"
           "glue.distance = 0.02",
           make_bond}};
}

}  // namespace limber::demos

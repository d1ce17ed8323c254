#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string_view>

#include "demos/scripting/lua_state.h"
#include "demos/scripting/lua_types.h"

namespace limber::demos {
namespace {

Vec3 vector_argument(lua_State* lua, int index) {
  if (!is_vector(lua, index)) {
    raise(lua, "a vector is wanted here; give vec(x, y, z) or {x, y, z}");
  }
  return to_vector(lua, index);
}

int make(lua_State* lua) {
  for (int i = 1; i <= 3; ++i) {
    if (lua_type(lua, i) != LUA_TNUMBER || lua_gettop(lua) != 3) {
      raise(lua, "vec() takes three numbers; write vec(x, y, z)");
    }
  }
  push(lua, Vec3(lua_tonumber(lua, 1), lua_tonumber(lua, 2), lua_tonumber(lua, 3)));
  return 1;
}

int add(lua_State* lua) {
  push(lua, Vec3(vector_argument(lua, 1) + vector_argument(lua, 2)));
  return 1;
}

int subtract(lua_State* lua) {
  push(lua, Vec3(vector_argument(lua, 1) - vector_argument(lua, 2)));
  return 1;
}

double factor(lua_State* lua, int index) {
  if (lua_type(lua, index) == LUA_TNUMBER) return lua_tonumber(lua, index);
  raise(lua, "a vector is multiplied by a number; for two vectors use a:dot(b) or a:cross(b)");
}

int multiply(lua_State* lua) {
  const bool number_first = lua_type(lua, 1) == LUA_TNUMBER;
  const double number = factor(lua, number_first ? 1 : 2);
  push(lua, Vec3(number * vector_argument(lua, number_first ? 2 : 1)));
  return 1;
}

int divide(lua_State* lua) {
  push(lua, Vec3(vector_argument(lua, 1) / factor(lua, 2)));
  return 1;
}

int negate(lua_State* lua) {
  push(lua, Vec3(-vector_argument(lua, 1)));
  return 1;
}

int equal(lua_State* lua) {
  lua_pushboolean(lua,
                  is_vector(lua, 1) && is_vector(lua, 2) && to_vector(lua, 1) == to_vector(lua, 2));
  return 1;
}

int text(lua_State* lua) {
  const Vec3& v = *as<Vec3>(lua, 1);
  lua_pushstring(lua, fmt::format("vec({:.6g}, {:.6g}, {:.6g})", v.x(), v.y(), v.z()).c_str());
  return 1;
}

int length(lua_State* lua) {
  lua_pushnumber(lua, vector_argument(lua, 1).norm());
  return 1;
}

int dot(lua_State* lua) {
  lua_pushnumber(lua, vector_argument(lua, 1).dot(vector_argument(lua, 2)));
  return 1;
}

int cross(lua_State* lua) {
  push(lua, Vec3(vector_argument(lua, 1).cross(vector_argument(lua, 2))));
  return 1;
}

int normalized(lua_State* lua) {
  const Vec3 v = vector_argument(lua, 1);
  if (!(v.norm() > 0.0)) raise(lua, "a vector without length has no direction; check it before");
  push(lua, Vec3(v.normalized()));
  return 1;
}

constexpr luaL_Reg kMethods[] = {
    {"length", length}, {"dot", dot}, {"cross", cross}, {"normalized", normalized}, {}};

int field(lua_State* lua) {
  const Vec3& v = *as<Vec3>(lua, 1);
  const std::string_view name = lua_type(lua, 2) == LUA_TSTRING ? lua_tostring(lua, 2) : "?";
  if (name.size() == 1 && name[0] >= 'x' && name[0] <= 'z') {
    lua_pushnumber(lua, v[name[0] - 'x']);
    return 1;
  }
  for (const luaL_Reg* method = kMethods; method->name; ++method) {
    if (name != method->name) continue;
    lua_pushcfunction(lua, method->func);
    return 1;
  }
  raise(lua,
        fmt::format("a vec has no '{}'; it has x, y, z, length, dot, cross, normalized", name));
}

int set_field(lua_State* lua) { raise(lua, "a vec does not change; make a new one: vec(x, y, z)"); }

}  // namespace

void open_vectors(lua_State* lua) {
  new_type<Vec3>(lua);
  const luaL_Reg operators[] = {{"__add", add},
                                {"__sub", subtract},
                                {"__mul", multiply},
                                {"__div", divide},
                                {"__unm", negate},
                                {"__eq", equal},
                                {"__tostring", text},
                                {"__index", field},
                                {"__newindex", set_field},
                                {}};
  luaL_setfuncs(lua, operators, 0);
  lua_pop(lua, 1);
  lua_register(lua, "vec", make);
}

std::optional<Vec3> vector_at(lua_State* lua, int index) {
  if (!lua_istable(lua, index)) {
    const Vec3* const v = as<Vec3>(lua, index);
    return v ? std::optional<Vec3>(*v) : std::nullopt;
  }
  if (lua_rawlen(lua, index) != 3) return {};
  const int table = lua_absindex(lua, index);
  Vec3 v;
  bool numbers = true;
  for (int i = 0; i < 3; ++i) {
    numbers = lua_rawgeti(lua, table, i + 1) == LUA_TNUMBER && numbers;
    v[i] = lua_tonumber(lua, -1);
  }
  lua_pop(lua, 3);
  return numbers ? std::optional<Vec3>(v) : std::nullopt;
}

bool is_vector(lua_State* lua, int index) { return vector_at(lua, index).has_value(); }

Vec3 to_vector(lua_State* lua, int index) {
  if (const std::optional<Vec3> v = vector_at(lua, index)) return *v;
  raise(lua, "a vector changed while it was read; leave it alone in callbacks");
}

}  // namespace limber::demos

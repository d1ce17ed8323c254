#include "demos/scripting/sandbox.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

#include "core/model/nearest_name.h"
#include "demos/scripting/lua_state.h"
#include "demos/scripting/safe_strings.h"
#include "demos/scripting/safe_tables.h"
#include "demos/scripting/seeded_random.h"
#include "demos/scripting/wrapped_function.h"

namespace limber::demos {
namespace {

struct LeftOut {
  std::string_view name, instead;
};

constexpr LeftOut kLeftOut[] = {
    {"collectgarbage", "memory is looked after by itself"},
    {"coroutine", "use after{} and every{}"},
    {"debug", "errors come with a traceback"},
    {"dofile", "use require of a module in the scene's folder"},
    {"io", "scenes read no files but meshes and models by shape.mesh{} and shape.file{}"},
    {"load", "use require of a module in the scene's folder"},
    {"loadfile", "use require of a module in the scene's folder"},
    {"next", "use pairs(), whose order is the same in every run"},
    {"os", "time() gives the simulated time"},
    {"package", "use require of a module in the scene's folder"},
    {"utf8", "texts are bytes here"},
    {"warn", "use print()"},
    {"xpcall", "use pcall(); errors come with a traceback"},
};

struct Name {
  std::string name;
};

int set_metatable(lua_State* lua) {
  luaL_checktype(lua, 1, LUA_TTABLE);
  if (lua_istable(lua, 2)) {
    lua_pushliteral(lua, "__gc");
    if (lua_rawget(lua, 2) != LUA_TNIL) {
      raise(lua, "a metatable must not have __gc; do what it does where it is due");
    }
    lua_pop(lua, 1);
  }
  return call_original(lua);
}

// __index of the globals: what is not there.
int missing_global(lua_State* lua) {
  const char* text = lua_type(lua, 2) == LUA_TSTRING ? lua_tostring(lua, 2) : "?";
  const std::string name = text;
  const auto left_out = std::ranges::find(kLeftOut, name, &LeftOut::name);
  if (left_out != std::end(kLeftOut)) {
    raise(lua, fmt::format("there is no '{}' in scenes; {}", name, left_out->instead));
  }
  std::vector<Name> names;
  for (const std::string& global : global_names(lua)) names.push_back({global});
  raise(lua, fmt::format("there is no '{}'; did you mean '{}'? (a name has to be given a value "
                         "before it is read)",
                         name, nearest_name(names, name)));
}

void open_library(lua_State* lua, const char* name, lua_CFunction open) {
  luaL_requiref(lua, name, open, 1);
  lua_pop(lua, 1);
}

void make_globals_strict(lua_State* lua) {
  lua_pushglobaltable(lua);
  lua_createtable(lua, 0, 2);
  lua_pushcfunction(lua, missing_global);
  lua_setfield(lua, -2, "__index");
  lua_pushboolean(lua, 0);
  lua_setfield(lua, -2, "__metatable");
  lua_setmetatable(lua, -2);
  lua_pop(lua, 1);
}

}  // namespace

void open_sandbox(lua_State* lua) {
  open_library(lua, LUA_GNAME, luaopen_base);
  open_library(lua, LUA_MATHLIBNAME, luaopen_math);
  open_library(lua, LUA_STRLIBNAME, luaopen_string);
  open_library(lua, LUA_TABLIBNAME, luaopen_table);
  make_strings_safe(lua);
  make_tables_safe(lua);
  open_seeded_random(lua);
  lua_pushglobaltable(lua);
  wrap(lua, "setmetatable", set_metatable);
  lua_pop(lua, 1);
  for (const LeftOut& left_out : kLeftOut) {
    lua_pushnil(lua);
    lua_setglobal(lua, std::string(left_out.name).c_str());
  }
  make_globals_strict(lua);
}

std::vector<std::string> global_names(lua_State* lua) {
  std::vector<std::string> names;
  lua_pushglobaltable(lua);
  for (lua_pushnil(lua); lua_next(lua, -2) != 0; lua_pop(lua, 1)) {
    if (lua_type(lua, -2) == LUA_TSTRING) names.emplace_back(lua_tostring(lua, -2));
  }
  lua_pop(lua, 1);
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace limber::demos

#pragma once

#include <lua.hpp>

namespace limber::demos {

// Puts `guard` in the place of the function of this name in the table on top of the stack. The
// guard has the function as its upvalue and calls it by call_original().
inline void wrap(lua_State* lua, const char* name, lua_CFunction guard) {
  lua_getfield(lua, -1, name);
  lua_pushcclosure(lua, guard, 1);
  lua_setfield(lua, -2, name);
}

// Calls it with all arguments of the guard; returns its results.
inline int call_original(lua_State* lua) {
  lua_pushvalue(lua, lua_upvalueindex(1));
  lua_insert(lua, 1);
  lua_call(lua, lua_gettop(lua) - 1, LUA_MULTRET);
  return lua_gettop(lua);
}

}  // namespace limber::demos

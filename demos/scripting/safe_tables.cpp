#include "demos/scripting/safe_tables.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "demos/scripting/lua_state.h"
#include "demos/scripting/wrapped_function.h"

namespace limber::demos {
namespace {

// Charges `rounds` times the length of the table in argument 1, without asking its metatable.
void charge_table(lua_State* lua, double rounds_per_item = 1.0) {
  luaL_checktype(lua, 1, LUA_TTABLE);
  if (luaL_getmetafield(lua, 1, "__len") != LUA_TNIL) {
    raise(lua, "the functions of 'table' take no table with a __len; use a plain list");
  }
  const auto length = static_cast<double>(lua_rawlen(lua, 1));
  state_of(lua).spend(static_cast<std::uint64_t>(rounds_per_item * length));
}

// At the end of a list nothing else moves.
int insert(lua_State* lua) {
  charge_table(lua, lua_gettop(lua) == 2 ? 0.0 : 1.0);
  return call_original(lua);
}

int remove(lua_State* lua) {
  charge_table(lua, lua_gettop(lua) == 1 ? 0.0 : 1.0);
  return call_original(lua);
}

int concat(lua_State* lua) {
  charge_table(lua);
  if (!lua_isnoneornil(lua, 3) || !lua_isnoneornil(lua, 4)) {
    raise(lua, "table.concat() takes a list and what goes between its items; leave out the rest");
  }
  return call_original(lua);
}

int unpack(lua_State* lua) {
  charge_table(lua);
  if (lua_gettop(lua) > 1) raise(lua, "table.unpack() takes a list alone; leave out the rest");
  return call_original(lua);
}

int sort(lua_State* lua) {
  luaL_checktype(lua, 1, LUA_TTABLE);
  charge_table(lua, 2.0 * std::log2(static_cast<double>(lua_rawlen(lua, 1)) + 2.0));
  return call_original(lua);
}

// A key whose place among others does not depend on where it is in memory.
struct Key {
  enum class Kind { kNumber, kText, kFlag } kind = Kind::kNumber;
  double number = 0.0;
  std::string text;
  bool whole = false;
  lua_Integer integer = 0;

  bool operator<(const Key& other) const {
    if (kind != other.kind) return kind < other.kind;
    return kind == Kind::kText ? text < other.text : number < other.number;
  }
};

Key key_at(lua_State* lua, int index) {
  Key key;
  switch (lua_type(lua, index)) {
    case LUA_TNUMBER:
      key.number = lua_tonumber(lua, index);
      key.whole = lua_isinteger(lua, index);
      key.integer = lua_tointeger(lua, index);
      return key;
    case LUA_TSTRING: {
      std::size_t length = 0;
      const char* text = lua_tolstring(lua, index, &length);
      key.kind = Key::Kind::kText;
      key.text.assign(text, length);
      return key;
    }
    case LUA_TBOOLEAN:
      key.kind = Key::Kind::kFlag;
      key.number = lua_toboolean(lua, index);
      return key;
    default:
      raise(lua, std::string("pairs() met a key that is a ") + luaL_typename(lua, index) +
                     ", whose place would differ from run to run; use a list, or names as keys");
  }
}

void push_key(lua_State* lua, const Key& key) {
  if (key.kind == Key::Kind::kText) {
    lua_pushlstring(lua, key.text.data(), key.text.size());
  } else if (key.kind == Key::Kind::kFlag) {
    lua_pushboolean(lua, key.number != 0.0);
  } else if (key.whole) {
    lua_pushinteger(lua, key.integer);
  } else {
    lua_pushnumber(lua, key.number);
  }
}

// Upvalues: the list of keys, the place in it. Keys that went meanwhile are left out. Scripts may
// call it themselves, with anything.
int next_pair(lua_State* lua) {
  luaL_checktype(lua, 1, LUA_TTABLE);
  lua_settop(lua, 1);
  lua_Integer place = lua_tointeger(lua, lua_upvalueindex(2));
  for (;;) {
    ++place;
    if (lua_rawgeti(lua, lua_upvalueindex(1), place) == LUA_TNIL) return 1;
    lua_pushvalue(lua, -1);
    if (lua_rawget(lua, 1) != LUA_TNIL) break;
    lua_pop(lua, 2);
  }
  lua_pushinteger(lua, place);
  lua_replace(lua, lua_upvalueindex(2));
  return 2;
}

int pairs(lua_State* lua) {
  luaL_checktype(lua, 1, LUA_TTABLE);
  std::vector<Key> keys;
  for (lua_pushnil(lua); lua_next(lua, 1) != 0; lua_pop(lua, 1)) keys.push_back(key_at(lua, -2));
  state_of(lua).spend(20 * keys.size());
  std::sort(keys.begin(), keys.end());
  lua_createtable(lua, static_cast<int>(keys.size()), 0);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    push_key(lua, keys[i]);
    lua_rawseti(lua, -2, static_cast<lua_Integer>(i) + 1);
  }
  lua_pushinteger(lua, 0);
  lua_pushcclosure(lua, next_pair, 2);
  lua_pushvalue(lua, 1);
  return 2;
}

}  // namespace

void make_tables_safe(lua_State* lua) {
  lua_getglobal(lua, "table");
  wrap(lua, "concat", concat);
  wrap(lua, "sort", sort);
  wrap(lua, "insert", insert);
  wrap(lua, "remove", remove);
  wrap(lua, "unpack", unpack);
  lua_pushnil(lua);
  lua_setfield(lua, -2, "move");
  lua_pop(lua, 1);
  lua_register(lua, "pairs", pairs);
  lua_pushnil(lua);
  lua_setglobal(lua, "next");
}

}  // namespace limber::demos

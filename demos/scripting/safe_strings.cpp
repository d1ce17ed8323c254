#include "demos/scripting/safe_strings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "demos/scripting/lua_state.h"
#include "demos/scripting/wrapped_function.h"

namespace limber::demos {
namespace {

constexpr lua_Integer kMostRepeats = 10'000'000;

struct PatternItems {
  int repetitions = 0;
  int options = 0;
};

// An upper bound: signs within a set count as well.
PatternItems items_of(std::string_view pattern) {
  PatternItems items;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    if (pattern[i] == '%' && i + 1 < pattern.size()) {
      const char escaped = pattern[++i];
      if (escaped == 'b' || (escaped >= '1' && escaped <= '9')) ++items.repetitions;
    } else if (pattern[i] == '*' || pattern[i] == '+' || pattern[i] == '-') {
      ++items.repetitions;
    } else if (pattern[i] == '?') {
      ++items.options;
    }
  }
  return items;
}

// Charges for a search in argument 1 for the pattern in argument 2.
void charge_search(lua_State* lua, bool plain) {
  std::size_t length = 0, pattern_length = 0;
  luaL_checklstring(lua, 1, &length);
  const char* pattern = luaL_checklstring(lua, 2, &pattern_length);
  const double cost = plain ? static_cast<double>(length) * static_cast<double>(pattern_length)
                            : pattern_cost(length, {pattern, pattern_length});
  if (cost > kMostPatternCost) {
    raise(lua, fmt::format("a search in {} characters for this pattern may take {:.0e} steps; "
                           "shorten the text, or use fewer of * + - ? %b %1",
                           length, cost));
  }
  state_of(lua).spend(static_cast<std::uint64_t>(cost));
}

int find(lua_State* lua) {
  charge_search(lua, lua_toboolean(lua, 4));
  return call_original(lua);
}

int search(lua_State* lua) {
  charge_search(lua, false);
  return call_original(lua);
}

int repeat(lua_State* lua) {
  if (luaL_checkinteger(lua, 2) > kMostRepeats) {
    raise(lua, fmt::format("string.rep() repeats at most {} times; make it shorter", kMostRepeats));
  }
  // An empty text is repeated without taking memory.
  state_of(lua).spend(static_cast<std::uint64_t>(std::max<lua_Integer>(0, lua_tointeger(lua, 2))));
  return call_original(lua);
}

// What works on every character of its first argument.
int whole_text(lua_State* lua) {
  std::size_t length = 0;
  luaL_checklstring(lua, 1, &length);
  state_of(lua).spend(length);
  return call_original(lua);
}

bool shows_address(lua_State* lua, int index) {
  const int type = lua_type(lua, index);
  return type == LUA_TTABLE || type == LUA_TFUNCTION || type == LUA_TUSERDATA ||
         type == LUA_TLIGHTUSERDATA;
}

// Is there a %p, with whatever flags and width?
bool asks_for_address(std::string_view format) {
  for (auto i = format.find('%'); i != std::string_view::npos; i = format.find('%', i + 1)) {
    i = format.find_first_not_of("-+ #0123456789.", i + 1);
    if (i == std::string_view::npos) return false;
    if (format[i] == 'p') return true;
  }
  return false;
}

int format(lua_State* lua) {
  std::size_t length = 0;
  const char* const wanted = luaL_checklstring(lua, 1, &length);
  if (asks_for_address({wanted, length})) {
    raise(lua, "addresses (%p) differ from run to run; leave them out");
  }
  for (int i = 2; i <= lua_gettop(lua); ++i) {
    if (!shows_address(lua, i)) continue;
    push_text(lua, i);
    lua_replace(lua, i);
  }
  return call_original(lua);
}

int to_text(lua_State* lua) {
  luaL_checkany(lua, 1);
  push_text(lua, 1);
  return 1;
}

}  // namespace

double pattern_cost(std::size_t subject_length, std::string_view pattern) {
  const PatternItems items = items_of(pattern);
  return std::pow(static_cast<double>(subject_length) + 1.0, items.repetitions + 1) *
         std::pow(2.0, items.options) * std::max(1.0, static_cast<double>(pattern.size()));
}

void make_strings_safe(lua_State* lua) {
  lua_getglobal(lua, "string");
  wrap(lua, "find", find);
  for (const char* name : {"match", "gmatch", "gsub"}) wrap(lua, name, search);
  wrap(lua, "rep", repeat);
  for (const char* name : {"lower", "upper", "reverse"}) wrap(lua, name, whole_text);
  wrap(lua, "format", format);
  for (const char* name : {"dump", "pack", "unpack", "packsize"}) {
    lua_pushnil(lua);
    lua_setfield(lua, -2, name);
  }
  lua_pop(lua, 1);
  lua_register(lua, "tostring", to_text);
}

void push_text(lua_State* lua, int index) {
  const bool own = luaL_getmetafield(lua, index, "__tostring") != LUA_TNIL;
  if (own) lua_pop(lua, 1);
  if (own || !shows_address(lua, index)) {
    luaL_tolstring(lua, index, nullptr);
  } else {
    lua_pushstring(lua, luaL_typename(lua, index));
  }
}

}  // namespace limber::demos

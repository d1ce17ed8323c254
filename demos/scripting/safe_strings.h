#pragma once

#include <cstdint>
#include <lua.hpp>
#include <string_view>

namespace limber::demos {

// Steps that Lua's pattern matcher may take on a subject of this length: it tries every way to
// share the subject among the repetitions from every start, (n + 1)^(repetitions + 1); an optional
// item doubles the ways; each goes along the pattern. (Lua 5.4, lstrlib.c, max_expand(),
// min_expand() and do_match().)
double pattern_cost(std::size_t subject_length, std::string_view pattern);

// The most that one search may cost, in these steps.
inline constexpr double kMostPatternCost = 1e8;

// Replaces what in the library `string` may take any time, or shows addresses, by what is charged
// for or refuses; removes `dump`.
void make_strings_safe(lua_State* lua);

// The text of a value without an address: those differ from run to run. Pushes it.
void push_text(lua_State* lua, int index);

}  // namespace limber::demos

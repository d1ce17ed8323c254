#pragma once

#include <cstdint>
#include <lua.hpp>

namespace limber::demos {

// math.random() and math.randomseed() of a generator whose numbers are the same on every machine
// (core/model/random.h), seeded with 1. Called as in Lua: random() in [0, 1), random(n) a whole
// number from 1 to n, random(m, n) from m to n. The library `math` has to be open.
void open_seeded_random(lua_State* lua);

}  // namespace limber::demos

#pragma once

#include <lua.hpp>

namespace limber::demos {

// Replaces the functions of the library `table` that may take any time by ones that are charged for
// and take no length but the table's own, and pairs() by one whose order is the same in every run:
// 1, 2, ... first, then numbers, then texts, ascending. Keys that have no such order (tables,
// functions) are refused there. Removes next().
void make_tables_safe(lua_State* lua);

}  // namespace limber::demos

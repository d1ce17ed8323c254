#pragma once

#include <lua.hpp>
#include <string>
#include <vector>

namespace limber::demos {

// Opens the part of Lua's libraries that can do no harm and gives the same results in every run:
//   base    without collectgarbage, dofile, load, loadfile, next, require, warn, xpcall
//   math    with random() and randomseed() of the scene's own generator
//   string, table   guarded (safe_strings.h, safe_tables.h)
// No coroutine, debug, io, os, package, utf8. setmetatable() refuses __gc: a finaliser runs where
// no limit holds. Reading a global that does not exist is an error which names the nearest one, or
// says what to use instead of one that was left out. After the script's own names were added.
void open_sandbox(lua_State* lua);

// Names of the globals that are there now, ascending.
std::vector<std::string> global_names(lua_State* lua);

}  // namespace limber::demos

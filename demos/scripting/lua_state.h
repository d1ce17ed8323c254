#pragma once

#include <cstdint>
#include <functional>
#include <lua.hpp>
#include <string>

#include "demos/scripting/script_limits.h"

namespace limber::demos {

// Why a script stopped.
struct LuaFailure {
  std::string message;    // "scene.lua:12: ...", as Lua has it
  std::string traceback;  // a line for each function, the innermost first; may be empty
};

// A state of Lua that cannot take more memory and time than it is given. (The library is Lua built
// as C++: its errors are exceptions, which destroy what lives in our functions on their way.)
//
// The steps are counted by a hook every thousand instructions. A hook alone does not stop
// `while true do pcall(loop) end`: pcall catches its error. Once the steps are used up the hook
// therefore comes with every instruction and raises each time, so that nothing a script does goes
// on. Memory that was asked for counts as steps too: copying a string of megabytes is one
// instruction.
class LuaState {
 public:
  explicit LuaState(const ScriptLimits& limits);
  ~LuaState();
  LuaState(const LuaState&) = delete;
  LuaState& operator=(const LuaState&) = delete;

  lua_State* raw() const { return lua_; }

  // What our functions find by owner_of().
  void set_owner(void* owner);

  // Steps for what follows, called `what` in the message when they are used up. Does nothing for a
  // state that was stopped.
  void allow(std::uint64_t steps, const std::string& what);

  // Takes steps for work done in C. Raises a Lua error when there are not as many left.
  void spend(std::uint64_t steps);

  // Ends the script for good with this message: nothing in it can catch it.
  [[noreturn]] void stop(const std::string& message);
  bool stopped() const { return stopped_; }

  // Does `work`, which may raise Lua errors and throw std::exceptions; all use of the state beyond
  // pushing numbers belongs in here, because errors of memory may come from anywhere. False: it
  // failed, and failure() says why.
  bool protect(const std::function<void(lua_State*)>& work);
  const LuaFailure& failure() const { return failure_; }

 private:
  static void* allocate(void* self, void* block, std::size_t old_size, std::size_t new_size);
  static void on_count(lua_State* lua, lua_Debug*);
  static int keep_traceback(lua_State* lua);
  void* resize(void* block, std::size_t before, std::size_t after);
  void charge_memory(std::size_t bytes);
  void count();
  [[noreturn]] void raise_stopped();

  std::size_t memory_limit_;
  std::size_t used_ = 0;           // bytes
  std::size_t uncharged_ = 0;      // bytes asked for since the last charge
  std::uint64_t steps_left_ = 0;   // of allow()
  std::uint64_t steps_given_ = 0;  // likewise, at first
  std::string what_;
  bool stopped_ = false;
  std::string why_;
  LuaFailure failure_;
  lua_State* lua_ = nullptr;
};

// The LuaState, and its owner, that a function is called in.
LuaState& state_of(lua_State* lua);
void* owner_of(lua_State* lua);

// Raises an error with the place in the script that called, "scene.lua:12: ".
[[noreturn]] void raise(lua_State* lua, const std::string& message);

}  // namespace limber::demos

#include "demos/scripting/lua_state.h"

#include <fmt/format.h>

#include <cstdlib>
#include <new>
#include <utility>

namespace limber::demos {
namespace {

constexpr int kInterval = 1000;            // instructions between two counts
constexpr std::size_t kBytesPerStep = 64;  // copied in about the time of an instruction
// Garbage is looked for when there is this much more than was left the last time, %: a call's
// tables die at once, and going through all that lives costs as much as hundreds of calls.
constexpr int kGrowthUntilCollected = 400;
constexpr std::size_t kMostUncharged = 1 << 20;  // bytes; more are charged at once

// What our functions reach from a lua_State.
struct Links {
  LuaState* state = nullptr;
  void* owner = nullptr;
};

// Has on_count() called every so many instructions. Setting the hook goes through all functions
// that are being called, hundreds of thousands in deep recursion: only where it changes anything.
void count_every(lua_State* lua, lua_Hook hook, int instructions) {
  if (lua_gethookcount(lua) == instructions) return;
  lua_sethook(lua, hook, LUA_MASKCOUNT, instructions);
}

Links*& links(lua_State* lua) { return *static_cast<Links**>(lua_getextraspace(lua)); }

}  // namespace

LuaState& state_of(lua_State* lua) { return *links(lua)->state; }
void* owner_of(lua_State* lua) { return links(lua)->owner; }

void raise(lua_State* lua, const std::string& message) {
  lua_Debug place;
  int level = 0;
  const auto is_in_script = [&] { return lua_getinfo(lua, "l", &place), place.currentline > 0; };
  while (lua_getstack(lua, level, &place) && !is_in_script()) ++level;
  luaL_where(lua, level);
  lua_pushlstring(lua, message.data(), message.size());
  lua_concat(lua, 2);
  lua_error(lua);
  std::abort();  // lua_error() does not return
}

LuaState::LuaState(const ScriptLimits& limits) : memory_limit_(limits.memory_bytes) {
  lua_ = lua_newstate(allocate, this);
  if (!lua_) throw std::bad_alloc();
  links(lua_) = new Links{this};
  lua_sethook(lua_, on_count, LUA_MASKCOUNT, kInterval);
  lua_gc(lua_, LUA_GCINC, kGrowthUntilCollected, 0, 0);
}

LuaState::~LuaState() {
  Links* const own = links(lua_);
  lua_close(lua_);
  delete own;
}

void LuaState::set_owner(void* owner) { links(lua_)->owner = owner; }

void* LuaState::allocate(void* self, void* block, std::size_t old_size, std::size_t new_size) {
  // For a new block `old_size` says what it is for.
  return static_cast<LuaState*>(self)->resize(block, block ? old_size : 0, new_size);
}

void* LuaState::resize(void* block, std::size_t before, std::size_t after) {
  if (after == 0) {
    std::free(block);
    used_ -= before;
    return nullptr;
  }
  if (after > before) {
    if (after - before > memory_limit_ - used_) {
      charge_memory(memory_limit_);  // Lua goes through all of it for something to give up
      return nullptr;
    }
    charge_memory(after);
  }
  void* const moved = std::realloc(block, after);
  if (moved) used_ += after - before;
  return moved;
}

void LuaState::charge_memory(std::size_t bytes) {
  uncharged_ += bytes;
  if (uncharged_ > kMostUncharged && lua_) count_every(lua_, on_count, 1);
}

void LuaState::allow(std::uint64_t steps, const std::string& what) {
  if (stopped_) return;
  steps_left_ = steps_given_ = steps;
  what_ = what;
}

void LuaState::spend(std::uint64_t steps) {
  if (stopped_) raise_stopped();
  if (steps > steps_left_) {
    stop(fmt::format("{} took more than {} steps; do less at once, or end a loop that never does",
                     what_, steps_given_));
  }
  steps_left_ -= steps;
}

void LuaState::stop(const std::string& message) {
  stopped_ = true;
  why_ = message;
  raise_stopped();
}

void LuaState::raise_stopped() {
  count_every(lua_, on_count, 1);
  raise(lua_, why_);
}

void LuaState::on_count(lua_State* lua, lua_Debug*) { state_of(lua).count(); }

void LuaState::count() {
  if (stopped_) raise_stopped();
  const std::uint64_t steps = kInterval + std::exchange(uncharged_, 0) / kBytesPerStep;
  count_every(lua_, on_count, kInterval);
  spend(steps);
}

int LuaState::keep_traceback(lua_State* lua) {
  luaL_traceback(lua, lua, nullptr, 1);
  state_of(lua).failure_.traceback = lua_tostring(lua, -1);
  lua_pop(lua, 1);
  return 1;
}

namespace {

using Work = std::function<void(lua_State*)>;

int do_work(lua_State* lua) {
  const Work& work = *static_cast<const Work*>(lua_touserdata(lua, 1));
  lua_settop(lua, 0);
  try {
    work(lua);
    return 0;
  } catch (const std::exception& error) {
    lua_pushstring(lua, error.what());
  }
  return lua_error(lua);
}

}  // namespace

bool LuaState::protect(const Work& work) {
  failure_ = {};
  lua_settop(lua_, 0);
  lua_pushcfunction(lua_, keep_traceback);
  lua_pushcfunction(lua_, do_work);
  lua_pushlightuserdata(lua_, const_cast<Work*>(&work));
  const bool good = lua_pcall(lua_, 1, 0, 1) == LUA_OK;
  if (!good) {
    // A number would be turned into text, which takes memory: outside of the call nothing may.
    const bool text = lua_type(lua_, -1) == LUA_TSTRING;
    failure_.message = text
                           ? lua_tostring(lua_, -1)
                           : std::string("the error is a ") + luaL_typename(lua_, -1) + ", no text";
  }
  lua_settop(lua_, 0);
  return good;
}

}  // namespace limber::demos

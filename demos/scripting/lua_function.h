#pragma once

#include "demos/scripting/arguments.h"
#include "demos/scripting/lua_state.h"

namespace limber::demos {

// A function of the script that C++ calls, for as long as the call lasts that it was given to.
// Errors in it are Lua's and pass through.
class LuaFunction {
 public:
  LuaFunction(const Arguments& given, const char* name)
      : lua_(given.lua()), where_(given.where() + ": " + name) {
    given.push(name);
    index_ = lua_gettop(lua_);
  }

  template <class... Numbers>
  Vec3 vector(Numbers... numbers) const {
    call(1, numbers...);
    if (!is_vector(lua_, -1))
      raise(lua_, where_ + ": it has to return a vector; end it by `return vec(x, y, z)`");
    const Vec3 v = to_vector(lua_, -1);
    lua_pop(lua_, 1);
    return v;
  }

  template <class... Numbers>
  double number(Numbers... numbers) const {
    call(1, numbers...);
    return take_number();
  }

  // Two numbers at once.
  std::pair<double, double> pair(double number) const {
    call(2, number);
    const double second = take_number();
    return {take_number(), second};
  }

 private:
  template <class... Numbers>
  void call(int results, Numbers... numbers) const {
    lua_pushvalue(lua_, index_);
    (lua_pushnumber(lua_, numbers), ...);
    lua_call(lua_, sizeof...(numbers), results);
  }

  double take_number() const {
    if (lua_type(lua_, -1) != LUA_TNUMBER) {
      raise(lua_, where_ + ": it has to return a number; end it by `return` and one");
    }
    const double value = lua_tonumber(lua_, -1);
    lua_pop(lua_, 1);
    return value;
  }

  lua_State* lua_;
  std::string where_;
  int index_ = 0;
};

}  // namespace limber::demos

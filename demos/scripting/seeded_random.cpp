#include "demos/scripting/seeded_random.h"

#include <new>

#include "core/model/random.h"
#include "demos/scripting/lua_state.h"

namespace limber::demos {
namespace {

// Upvalue 1 of both functions.
Random& generator(lua_State* lua) {
  return *static_cast<Random*>(lua_touserdata(lua, lua_upvalueindex(1)));
}

int random_number(lua_State* lua) {
  const double share = generator(lua).uniform();
  const int given = lua_gettop(lua);
  if (given == 0) {
    lua_pushnumber(lua, share);
    return 1;
  }
  const lua_Integer least = given == 1 ? 1 : luaL_checkinteger(lua, 1);
  const lua_Integer most = luaL_checkinteger(lua, given == 1 ? 1 : 2);
  constexpr lua_Integer kMost = lua_Integer{1} << 52;
  if (least > most || least < -kMost || most > kMost) {
    raise(lua, "math.random() of an empty or too large range; give the smaller number first");
  }
  const double count = static_cast<double>(most - least) + 1.0;
  lua_pushinteger(lua, least + static_cast<lua_Integer>(share * count));
  return 1;
}

int seed(lua_State* lua) {
  const lua_Number wanted = luaL_checknumber(lua, 1);
  if (!(wanted >= 0.0 && wanted <= 0x1p53)) {
    raise(lua, "math.randomseed() wants a whole number from 0 to 2^53");
  }
  generator(lua) = Random(static_cast<std::uint64_t>(wanted));
  return 0;
}

}  // namespace

void open_seeded_random(lua_State* lua) {
  lua_getglobal(lua, "math");
  new (lua_newuserdatauv(lua, sizeof(Random), 0)) Random(1);
  for (const auto& [name, function] : {luaL_Reg{"random", random_number}, {"randomseed", seed}}) {
    lua_pushvalue(lua, -1);
    lua_pushcclosure(lua, function, 1);
    lua_setfield(lua, -3, name);
  }
  lua_pop(lua, 2);
}

}  // namespace limber::demos

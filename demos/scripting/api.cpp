#include "demos/scripting/api.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "core/model/errors.h"
#include "core/model/nearest_name.h"
#include "demos/scripting/lua_state.h"
#include "demos/scripting/script.h"

namespace limber::demos {
namespace {

// A function with what every call of it needs.
struct Callable {
  const ApiFunction& function;
  std::string where;  // its full name
  bool is_method;
  const void* type;  // type_key() of what it is a method of
  bool calls_back;   // a function of the script's, while it works
};

template <class... T>
const void* key_among(std::string_view owner) {
  const void* key = nullptr;
  ((owner == kTypeName<T> ? void(key = type_key<T>()) : void()), ...);
  return key;
}

const void* key_of(std::string_view owner) {
  return key_among<Material, ModelHandle, ObjectHandle, BodyHandle, FlowHandle>(owner);
}

bool takes_function(const std::vector<Field>& fields) {
  return std::ranges::any_of(
      fields, [](const Field& f) { return f.kind == Kind::kFunction || takes_function(f.fields); });
}

const std::vector<Callable>& callables() {
  static const std::vector<Callable> all = [] {
    std::vector<Callable> made;
    for (const ApiFunction& function : api_functions()) {
      made.push_back({function, function.full_name(), function.is_method(), key_of(function.owner),
                      takes_function(function.fields)});
    }
    return made;
  }();
  return all;
}

// The script's own functions may change the table that a call was given, while it works; what was
// checked is the copy, out of their reach. (Without such functions nothing of the script runs.)
void copy_table(lua_State* lua, int index) {
  lua_newtable(lua);
  for (lua_pushnil(lua); lua_next(lua, index) != 0;) {
    state_of(lua).spend(1);
    lua_pushvalue(lua, -2);
    lua_insert(lua, -2);
    lua_rawset(lua, -4);
  }
  lua_replace(lua, index);
}

bool is_plain_table(lua_State* lua, int index) {
  if (!lua_istable(lua, index)) return false;
  if (!lua_getmetatable(lua, index)) return true;
  lua_pop(lua, 1);
  return false;
}

int checked_call(lua_State* lua, const Callable& callable) {
  const auto& [function, where, is_method, type, calls_back] = callable;
  const int table = is_method ? 2 : 1;
  if (is_method && !data_of_type(lua, 1, type)) {
    raise(lua,
          fmt::format("{}: it is called on a {}; write it with a colon", where, function.owner));
  }
  if (lua_gettop(lua) > table) {
    raise(lua,
          fmt::format("{}: it takes one table of named fields; write {}{{...}}", where, where));
  }
  if (function.running) script_of(lua).require_running(where);
  if (calls_back && is_plain_table(lua, table)) copy_table(lua, table);
  return function.call(Arguments(lua, table, function.fields, where));
}

// What every function of the table is for Lua. Errors of ours become Lua's, with the place.
int call_function(lua_State* lua) {
  const auto& callable = *static_cast<const Callable*>(lua_touserdata(lua, lua_upvalueindex(1)));
  std::string message;
  try {
    return checked_call(lua, callable);
  } catch (const InputError& error) {
    message = error.diagnostic.text();
  } catch (const std::bad_alloc&) {
    message = callable.where + ": there is not enough memory; make it smaller";
  } catch (const std::exception& error) {
    message = fmt::format("{}: {}", callable.where, error.what());
  }
  raise(lua, message);
}

// __index of a type: its methods, which are in the upvalue.
int method_of(lua_State* lua) {
  lua_pushvalue(lua, 2);
  if (lua_rawget(lua, lua_upvalueindex(1)) != LUA_TNIL) return 1;
  struct Name {
    std::string name;
  };
  std::vector<Name> names;
  for (lua_pushnil(lua); lua_next(lua, lua_upvalueindex(1)) != 0; lua_pop(lua, 1)) {
    names.push_back({lua_tostring(lua, -2)});
  }
  std::ranges::sort(names, {}, &Name::name);
  const char* const wanted = lua_type(lua, 2) == LUA_TSTRING ? lua_tostring(lua, 2) : "?";
  const char* const type = lua_tostring(lua, lua_upvalueindex(2));
  raise(lua, fmt::format("a {} has no '{}'; did you mean '{}'?", type, wanted,
                         nearest_name(names, wanted)));
}

int refuse_new_field(lua_State* lua) {
  raise(lua, "fields of these cannot be set; use the methods that set things");
}

int type_name(lua_State* lua) {
  luaL_getmetafield(lua, 1, "__name");
  return 1;
}

// The functions of one owner, into the table on top of the stack.
void add_functions(lua_State* lua, const std::string& owner) {
  for (const Callable& callable : callables()) {
    if (callable.function.owner != owner) continue;
    lua_pushlightuserdata(lua, const_cast<Callable*>(&callable));
    lua_pushcclosure(lua, call_function, 1);
    lua_setfield(lua, -2, callable.function.name.c_str());
  }
}

// The metatable is on top of the stack and goes.
void finish_type(lua_State* lua, const ApiOwner& type) {
  lua_newtable(lua);
  add_functions(lua, type.name);
  lua_pushstring(lua, type.name.c_str());
  lua_pushcclosure(lua, method_of, 2);
  lua_setfield(lua, -2, "__index");
  lua_pushcfunction(lua, refuse_new_field);
  lua_setfield(lua, -2, "__newindex");
  lua_pushcfunction(lua, type_name);
  lua_setfield(lua, -2, "__tostring");
  lua_pop(lua, 1);
}

// Two variables with the same object are equal.
template <class Handle>
int same_handle(lua_State* lua) {
  const Handle* a = as<Handle>(lua, 1);
  const Handle* b = as<Handle>(lua, 2);
  lua_pushboolean(lua, a && b && a->index == b->index);
  return 1;
}

template <class Handle>
void new_handle_type(lua_State* lua) {
  new_type<Handle>(lua);
  lua_pushcfunction(lua, same_handle<Handle>);
  lua_setfield(lua, -2, "__eq");
}

void open_type(lua_State* lua, const ApiOwner& type) {
  if (type.name == "model") new_type<ModelHandle>(lua);
  if (type.name == "object") new_handle_type<ObjectHandle>(lua);
  if (type.name == "body") new_handle_type<BodyHandle>(lua);
  if (type.name == "flow") new_handle_type<FlowHandle>(lua);
  finish_type(lua, type);
}

void open_library(lua_State* lua, const ApiOwner& library) {
  lua_newtable(lua);
  add_functions(lua, library.name);
  lua_setglobal(lua, library.name.c_str());
}

}  // namespace

bool ApiFunction::is_method() const {
  const auto found = std::ranges::find(api_owners(), owner, &ApiOwner::name);
  return found != api_owners().end() && found->is_type;
}

std::string ApiFunction::full_name() const {
  if (owner.empty()) return name;
  return owner + (is_method() ? ":" : ".") + name;
}

const std::vector<ApiFunction>& api_functions() {
  static const std::vector<ApiFunction> functions = [] {
    std::vector<ApiFunction> all;
    for (auto group : {scene_functions, material_functions, shape_functions, model_functions,
                       rigid_functions, body_functions, joint_functions, spawn_functions,
                       object_queries, object_actions, wind_functions}) {
      for (ApiFunction& function : group()) all.push_back(std::move(function));
    }
    return all;
  }();
  return functions;
}

const std::vector<ApiOwner>& api_owners() {
  static const std::vector<ApiOwner> owners = {
      {"", "The scene, and what happens in it.", false},
      {"shape", "Flexible, breakable shapes: each makes a model of a material.", false},
      {"rigid", "Bodies of Bullet's world that neither bend nor break.", false},
      {"joint", "What joins rigid bodies to one another and to the world.", false},
      {"wind", "Primitives that add up to the wind; without any the scene has no air.", false},
      {"model",
       "A shape with its material, before it is spawned. Several variables may hold the "
       "same model; copy{} makes another.",
       true},
      {"object", "A model that was spawned: a lattice, a rigid body, or the pieces of either.",
       true},
      {"body", "A rigid body.", true},
      {"flow", "A primitive of the wind.", true}};
  return owners;
}

int give(const Arguments& arguments, const Vec3& value) {
  push(arguments.lua(), value);
  return 1;
}

int give(const Arguments& arguments, const std::string& value) {
  lua_pushlstring(arguments.lua(), value.data(), value.size());
  return 1;
}

void open_api(lua_State* lua) {
  open_vectors(lua);
  open_materials(lua);
  for (const ApiOwner& owner : api_owners()) {
    if (owner.is_type) {
      open_type(lua, owner);
    } else if (!owner.name.empty()) {
      open_library(lua, owner);
    }
  }
  lua_pushglobaltable(lua);
  add_functions(lua, "");
  lua_pop(lua, 1);
}

}  // namespace limber::demos

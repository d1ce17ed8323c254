#pragma once

#include <lua.hpp>
#include <memory>
#include <new>
#include <optional>
#include <type_traits>
#include <utility>

#include "core/model/physical_model.h"
#include "core/modeller/material.h"

namespace limber::demos {

// What scripts hold. Models are shared by all variables they were given to, as Lua's tables are.
using ModelHandle = std::shared_ptr<PhysicalModel>;
struct ObjectHandle {
  std::size_t index = 0;  // of Scene::objects
};
struct BodyHandle {
  std::size_t index = 0;  // of Scene::bodies
};
struct FlowHandle {
  std::size_t index = 0;  // of FlowField::primitives
};

// The name of a type in scripts, and of its metatable in Lua's registry.
template <class T>
inline constexpr const char* kTypeName = nullptr;
template <>
inline constexpr const char* kTypeName<Vec3> = "vec";
template <>
inline constexpr const char* kTypeName<Material> = "material";
template <>
inline constexpr const char* kTypeName<ModelHandle> = "model";
template <>
inline constexpr const char* kTypeName<ObjectHandle> = "object";
template <>
inline constexpr const char* kTypeName<BodyHandle> = "body";
template <>
inline constexpr const char* kTypeName<FlowHandle> = "flow";

// What Lua's registry has the metatable of T under, beside its name.
template <class T>
const void* type_key() {
  return &kTypeName<T>;
}

// The value at this place of the stack if it is of the type of that key, else null. As
// luaL_testudata(), without a look-up by text: every call takes several.
inline void* data_of_type(lua_State* lua, int index, const void* key) {
  void* const data = lua_touserdata(lua, index);
  if (!data || !lua_getmetatable(lua, index)) return nullptr;
  lua_rawgetp(lua, LUA_REGISTRYINDEX, key);
  const bool same = lua_rawequal(lua, -1, -2);
  lua_pop(lua, 2);
  return same ? data : nullptr;
}

// The value at this place of the stack if it is a T, else null.
template <class T>
T* as(lua_State* lua, int index) {
  return static_cast<T*>(data_of_type(lua, index, type_key<T>()));
}

template <class T>
void push(lua_State* lua, T value) {
  static_assert(std::is_nothrow_move_constructible_v<T>);
  new (lua_newuserdatauv(lua, sizeof(T), 0)) T(std::move(value));
  lua_rawgetp(lua, LUA_REGISTRYINDEX, type_key<T>());
  lua_setmetatable(lua, -2);
}

// Makes the metatable of T, with a destructor where T needs one, and leaves it on the stack.
template <class T>
void new_type(lua_State* lua) {
  luaL_newmetatable(lua, kTypeName<T>);
  lua_pushvalue(lua, -1);
  lua_rawsetp(lua, LUA_REGISTRYINDEX, type_key<T>());
  lua_pushstring(lua, kTypeName<T>);
  lua_setfield(lua, -2, "__metatable");  // out of reach of scripts
  if constexpr (!std::is_trivially_destructible_v<T>) {
    lua_pushcfunction(lua, [](lua_State* l) {
      static_cast<T*>(lua_touserdata(l, 1))->~T();
      return 0;
    });
    lua_setfield(lua, -2, "__gc");
  }
}

// The type `vec` and the function vec(x, y, z): fields x, y, z; + - * / and unary -; ==; methods
// length, dot, cross, normalized.
void open_vectors(lua_State* lua);

// A vec, or a list of three numbers; none: it is something else.
std::optional<Vec3> vector_at(lua_State* lua, int index);
bool is_vector(lua_State* lua, int index);
// Raises a Lua error where it is none: a list that was one may have changed since.
Vec3 to_vector(lua_State* lua, int index);

}  // namespace limber::demos

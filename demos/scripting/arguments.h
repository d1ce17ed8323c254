#pragma once

#include <cstdint>
#include <lua.hpp>
#include <string>
#include <vector>

#include "core/environment/track.h"
#include "core/modeller/material.h"
#include "demos/scripting/field.h"
#include "demos/scripting/lua_types.h"

namespace limber::demos {

// The named fields that a script gave to a function, {name = value, ...}, checked against what the
// function takes: every reader finds what it asks for, or its default.
class Arguments {
 public:
  // Reads the table at `index` of the stack; nothing or nil counts as an empty one. `where` names
  // the function in messages. Raises a Lua error for a field that does not exist (with the nearest
  // name), is missing, of another kind or out of range. All three have to outlive this.
  Arguments(lua_State* lua, int index, const std::vector<Field>& fields, const std::string& where);

  lua_State* lua() const { return lua_; }
  const std::string& where() const { return where_; }

  bool has(const char* name) const;  // given, or with a default
  double number(const char* name) const;
  int whole(const char* name) const;
  bool flag(const char* name) const;
  std::string text(const char* name) const;
  Vec3 vector(const char* name) const;
  std::array<int, 3> wholes(const char* name) const;
  Mat3 rotation(const char* name) const;  // of a record {axis, angle}
  Track<double> steps(const char* name) const;
  Track<Vec3> path(const char* name) const;
  std::vector<Vec3> vectors(const char* name) const;
  std::vector<double> numbers(const char* name) const;
  Material material(const char* name) const;
  // Puts it on the stack; nil where it was not given.
  void push(const char* name) const;

  template <class T>
  T* handle(const char* name) const {  // null: it is another kind of thing
    push(name);
    T* const found = as<T>(lua_, -1);
    lua_pop(lua_, 1);  // the table keeps it
    return found;
  }

  // Does `work(arguments)` with each table of a list, or with the one of a record, where it is
  // given.
  template <class Work>
  void each(const char* name, const Work& work) const {
    if (!given(name)) return;
    const Field& of = field_of(name);
    push(name);
    const int list = lua_gettop(lua_);
    if (of.kind == Kind::kRecord) {
      work(Arguments(lua_, list, of.fields, where_));
    } else {
      const auto count = static_cast<lua_Integer>(lua_rawlen(lua_, list));
      for (lua_Integer i = 1; i <= count; ++i) {
        lua_rawgeti(lua_, list, i);
        work(Arguments(lua_, lua_gettop(lua_), of.fields, where_));
        lua_pop(lua_, 1);
      }
    }
    lua_pop(lua_, 1);
  }

 private:
  const Field& field_of(const char* name) const;
  bool given(const char* name) const;

  lua_State* lua_;
  int table_;                // 0: none
  std::uint64_t given_ = 0;  // a bit for each field, in their order: at most 64
  const std::vector<Field>& fields_;
  const std::string& where_;
};

// The field {axis = ..., angle = ...} of a rotation.
Field rotation_field(std::string meaning);

}  // namespace limber::demos

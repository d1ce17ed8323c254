#pragma once

#include <lua.hpp>
#include <string>
#include <vector>

#include "demos/scripting/arguments.h"
#include "demos/scripting/field.h"

namespace limber::demos {

// One function that scripts may call, with all that is said and checked about it: from this table
// come the checks and messages, the reference (docs/scripting_reference.md), the stubs for editors,
// and a test that runs the example.
struct ApiFunction {
  std::string owner;  // a library ("shape"), a type ("model": a method) or empty: a global
  std::string name;
  std::string summary;
  std::vector<Field> fields;
  std::string returns;  // the type for editors; empty: nothing
  std::string example;  // a whole script
  int (*call)(const Arguments&);
  bool running = false;  // only while the scene runs

  bool is_method() const;
  std::string full_name() const;  // "shape.box", "model:place", "spawn"
};

// A function that a script may define, and that is called.
struct ApiCallback {
  std::string name;
  std::string summary;
  std::vector<Field> arguments;  // positional
  std::vector<Field> event;      // fields of a table, the only argument then; may be empty
  std::string example;
};

// A library or type, in the order of the reference.
struct ApiOwner {
  std::string name;
  std::string summary;
  bool is_type = false;
};

const std::vector<ApiFunction>& api_functions();
const std::vector<ApiCallback>& api_callbacks();
const std::vector<ApiOwner>& api_owners();

// The groups that api_functions() puts together; each stands in a file of its own.
std::vector<ApiFunction> scene_functions();
std::vector<ApiFunction> shape_functions();
std::vector<ApiFunction> material_functions();
std::vector<ApiFunction> model_functions();
std::vector<ApiFunction> rigid_functions();
std::vector<ApiFunction> body_functions();
std::vector<ApiFunction> joint_functions();
std::vector<ApiFunction> spawn_functions();
std::vector<ApiFunction> object_queries();
std::vector<ApiFunction> object_actions();
std::vector<ApiFunction> wind_functions();

// The largest values of a field: what is beyond is a mistake, or hurts single precision.
inline constexpr double kMostMetres = 1e4;
inline constexpr double kMostSpeed = 1e4;  // m/s, rad/s

// Results of functions: one value each.
int give(const Arguments& arguments, const Vec3& value);
int give(const Arguments& arguments, const std::string& value);

// Makes libraries and types of them in a new state.
void open_api(lua_State* lua);
void open_materials(lua_State* lua);  // the type `material`; a part of it

// The value that a method was called on.
template <class T>
T& self(const Arguments& arguments) {
  return *as<T>(arguments.lua(), 1);
}

}  // namespace limber::demos

#include "demos/scripting/api_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "demos/scripting/api.h"

namespace limber::demos {
namespace {

constexpr const char* kHead = R"(# Scripting reference

Made from the table that scripts are checked against, by `limber api`; do not edit it. [scripting.md](scripting.md) is the
way in. Every example here is run by the tests.

Units are SI, angles radians, Y is up. Functions take one table of named fields, `rigid.box{size = {1, 1, 1}}`; methods
are called with a colon, `ball:push{impulse = {1, 0, 0}}`. Fields without a default have to be given unless they are
optional. Elements are counted from 1. What is marked *running* can be called in callbacks and timers alone.

`vec(x, y, z)` makes a vector with the fields `x`, `y`, `z`, the operators `+ - * / ==` and the methods `length()`,
`dot(v)`, `cross(v)`, `normalized()`. `{x, y, z}` does wherever a vector is wanted. Of Lua's own libraries there are
`math`, `string` and `table`; `print` goes to standard error, `require "parts.leaf"` reads `parts/leaf.lua` in the scene's
folder.
)";

std::string in_table(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) {
    text.insert(at, 1, '\\');
  }
  return text;
}

std::string value_text(const Field& f) {
  const std::string range = range_text(f);
  return in_table(wanted(f) + (range.empty() ? "" : ": " + range));
}

std::string otherwise_text(const Field& f) {
  if (std::holds_alternative<Field::Optional>(f.otherwise)) return "optional";
  const std::string value = default_text(f);
  return value.empty() ? "" : '`' + value + '`';
}

void add_rows(std::string& text, const std::vector<Field>& fields, const std::string& within) {
  for (const Field& f : fields) {
    text += fmt::format("| `{}{}` | {} | {} | {} |\n", within, f.name, value_text(f),
                        otherwise_text(f), in_table(f.meaning));
    add_rows(text, f.fields, within + f.name + ".");
  }
}

std::string fields_table(const std::vector<Field>& fields, const char* what) {
  if (fields.empty()) return "";
  std::string text = fmt::format("\n| {} | takes | default | meaning |\n|---|---|---|---|\n", what);
  add_rows(text, fields, "");
  return text;
}

std::string example_text(const std::string& example) {
  return fmt::format("\n```lua\n{}\n```\n", example);
}

std::string function_text(const ApiFunction& function) {
  return fmt::format("\n### `{}`\n\n{}{}{}\n{}{}", function.full_name(), function.summary,
                     function.returns.empty() ? "" : " Gives a " + function.returns + ".",
                     function.running ? " *Running.*" : "", fields_table(function.fields, "field"),
                     example_text(function.example));
}

std::string callback_text(const ApiCallback& callback) {
  const bool event = !callback.event.empty();
  std::vector<std::string> names;
  for (const Field& f : callback.arguments) names.push_back(f.name);
  if (event) names.push_back("event");
  return fmt::format("\n### `{}({})`\n\n{}\n{}{}", callback.name, fmt::join(names, ", "),
                     callback.summary,
                     event ? fields_table(callback.event, "field of event")
                           : fields_table(callback.arguments, "argument"),
                     example_text(callback.example));
}

std::string owner_title(const ApiOwner& owner) {
  if (owner.name.empty()) return "Functions";
  return '`' + owner.name + '`' + (owner.is_type ? ": methods" : "");
}

// The type that editors know a field by.
std::string stub_type(const Field& f) {
  switch (f.kind) {
    case Kind::kNumber:
      return "number";
    case Kind::kWhole:
      return "integer";
    case Kind::kFlag:
      return "boolean";
    case Kind::kText:
      return "string";
    case Kind::kChoice:
      return fmt::format("\"{}\"", fmt::join(f.choices, "\"|\""));
    case Kind::kVector:
    case Kind::kDirection:
    case Kind::kColour:
    case Kind::kWholes:
      return "vec|number[]";
    case Kind::kSteps:
      return "number|number[][]";
    case Kind::kPath:
      return "vec|number[]|table[]";
    case Kind::kVectors:
      return "(vec|number[])[]";
    case Kind::kNumbers:
      return "number[]";
    case Kind::kFunction:
      return "function";
    case Kind::kMaterial:
      return "material|string";
    case Kind::kModel:
      return "model";
    case Kind::kThing:
      return "object|body";
    case Kind::kBody:
      return "body";
    case Kind::kRecord:
      return "table";
    case Kind::kRecords:
      return "table[]";
  }
  return "any";
}

std::string class_of_fields(const std::string& name, const std::vector<Field>& fields) {
  std::string text = fmt::format("\n---@class {}\n", name);
  for (const Field& f : fields) {
    const bool needed = std::holds_alternative<Field::Required>(f.otherwise);
    text += fmt::format("---@field {}{} {} {}{}\n", f.name, needed ? "" : "?", stub_type(f),
                        f.unit.empty() ? "" : f.unit + ", ", f.meaning);
  }
  return text;
}

std::string identifier(const ApiFunction& function) {
  std::string name = function.full_name();
  std::ranges::replace(name, '.', '_');
  std::ranges::replace(name, ':', '_');
  return name + "_fields";
}

std::string function_stub(const ApiFunction& function) {
  std::string text;
  const bool fields = !function.fields.empty();
  if (fields) text += class_of_fields(identifier(function), function.fields);
  text += fmt::format("\n---{}\n", function.summary);
  if (fields) text += fmt::format("---@param fields {}\n", identifier(function));
  if (!function.returns.empty()) text += fmt::format("---@return {}\n", function.returns);
  return text + fmt::format("function {}({}) end\n", function.full_name(), fields ? "fields" : "");
}

std::string callback_stub(const ApiCallback& callback) {
  std::string text;
  std::vector<std::string> names;
  if (!callback.event.empty()) {
    text += class_of_fields(callback.name + "_event", callback.event);
    names.emplace_back("event");
  }
  text += fmt::format("\n---{}\n", callback.summary);
  if (!names.empty()) text += fmt::format("---@param event {}_event\n", callback.name);
  for (const Field& f : callback.arguments) {
    names.push_back(f.name);
    text += fmt::format("---@param {} {} {}\n", f.name, stub_type(f), f.meaning);
  }
  return text + fmt::format("function {}({}) end\n", callback.name, fmt::join(names, ", "));
}

constexpr const char* kStubHead = R"(---@meta
-- What scenes of Limber can use, for the Lua language server: made by `limber api --stubs`.

---@class vec
---@field x number
---@field y number
---@field z number
---@operator add(vec): vec
---@operator sub(vec): vec
---@operator mul(number): vec
---@operator div(number): vec
---@operator unm: vec
---@field length fun(self: vec): number
---@field dot fun(self: vec, other: vec|number[]): number
---@field cross fun(self: vec, other: vec|number[]): vec
---@field normalized fun(self: vec): vec

---@param x number
---@param y number
---@param z number
---@return vec
function vec(x, y, z) end
)";

}  // namespace

std::string api_reference() {
  std::string text = kHead;
  for (const ApiOwner& owner : api_owners()) {
    text += fmt::format("\n## {}\n\n{}\n", owner_title(owner), owner.summary);
    for (const ApiFunction& function : api_functions()) {
      if (function.owner == owner.name) text += function_text(function);
    }
  }
  text +=
      "\n## Callbacks\n\nA script defines those it wants; they are called while the scene runs.\n";
  for (const ApiCallback& callback : api_callbacks()) text += callback_text(callback);
  return text;
}

std::string api_stubs() {
  std::string text = kStubHead;
  for (const ApiOwner& owner : api_owners()) {
    if (owner.is_type) text += fmt::format("\n---@class {0}\n{0} = {{}}\n", owner.name);
    if (!owner.is_type && !owner.name.empty()) text += fmt::format("\n{} = {{}}\n", owner.name);
  }
  for (const ApiFunction& function : api_functions()) {
    // A material's values can be read: it is a class with the fields that make one.
    if (function.name == "material") text += class_of_fields("material", function.fields);
    text += function_stub(function);
  }
  for (const ApiCallback& callback : api_callbacks()) text += callback_stub(callback);
  return text;
}

}  // namespace limber::demos

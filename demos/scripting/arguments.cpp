#include "demos/scripting/arguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/model/nearest_name.h"
#include "core/modeller/material_table.h"
#include "demos/scripting/lua_state.h"

namespace limber::demos {
namespace {

constexpr lua_Unsigned kMostItems = 1'000'000;  // of one list
constexpr std::size_t kMostTextBytes = 1000;    // names are kept outside of Lua's memory
constexpr double kMostWhole = 2147483647.0;

// One value against its field. Raises what is wrong.
class Check {
 public:
  Check(lua_State* lua, int index, const Field& field, const std::string& where)
      : lua_(lua), index_(lua_absindex(lua, index)), field_(field), where_(where) {}

  void run() const {
    switch (field_.kind) {
      case Kind::kNumber:
      case Kind::kWhole:
        return check_number(index_);
      case Kind::kFlag:
        return require(lua_isboolean(lua_, index_));
      case Kind::kText:
        return check_text();
      case Kind::kChoice:
        return check_choice();
      case Kind::kVector:
      case Kind::kDirection:
      case Kind::kColour:
      case Kind::kWholes:
        return check_vector(index_);
      case Kind::kSteps:
        if (lua_type(lua_, index_) == LUA_TNUMBER) return check_number(index_);
        return check_keys();
      case Kind::kPath:
        if (is_vector(lua_, index_)) return check_vector(index_);
        return check_keys();
      case Kind::kVectors:
      case Kind::kNumbers:
        return check_list();
      case Kind::kFunction:
        return require(lua_isfunction(lua_, index_));
      case Kind::kMaterial:
        return check_material();
      case Kind::kModel:
        return require(as<ModelHandle>(lua_, index_));
      case Kind::kThing:
        return require(as<ObjectHandle>(lua_, index_) || as<BodyHandle>(lua_, index_));
      case Kind::kBody:
        return require(as<BodyHandle>(lua_, index_));
      case Kind::kRecord:
      case Kind::kRecords:
        return check_records();
    }
  }

 private:
  [[noreturn]] void complain(const std::string& is) const {
    const std::string range = range_text(field_);
    raise(lua_, fmt::format("{}: '{}' is {}; give {}{}", where_, field_.name, is, wanted(field_),
                            range.empty() ? "" : ", " + range));
  }

  [[noreturn]] void complain_of_kind() const {
    complain(fmt::format("a {}", luaL_typename(lua_, index_)));
  }

  void require(bool good) const {
    if (!good) complain_of_kind();
  }

  void check_value(double value) const {
    if (std::isnan(value)) complain("not a number");
    const bool low = field_.least_allowed ? value >= field_.least : value > field_.least;
    if (!low || value > field_.most) complain(fmt::format("{:g}", value));
    const bool whole = field_.kind == Kind::kWhole || field_.kind == Kind::kWholes;
    if (whole && (value != std::floor(value) || std::abs(value) > kMostWhole)) {
      complain(fmt::format("{:g}", value));
    }
  }

  void check_number(int index) const {
    require(lua_type(lua_, index) == LUA_TNUMBER);
    check_value(lua_tonumber(lua_, index));
  }

  void check_vector(int index) const {
    const std::optional<Vec3> given = vector_at(lua_, index);
    if (!given) {
      if (lua_istable(lua_, index)) complain("no list of three numbers");
      complain_of_kind();
    }
    const Vec3& v = *given;
    if (!v.allFinite()) complain("not finite");
    if (field_.kind == Kind::kDirection && !(v.norm() > 0.0)) complain("zero");
    if (field_.kind == Kind::kDirection || field_.kind == Kind::kPath) return;
    for (int i = 0; i < 3; ++i) check_value(v[i]);
  }

  lua_Integer checked_length() const {
    require(lua_istable(lua_, index_));
    const lua_Unsigned length = lua_rawlen(lua_, index_);
    if (length == 0) complain("an empty list");
    if (length > kMostItems) complain(fmt::format("a list of {} items", length));
    state_of(lua_).spend(length);
    return static_cast<lua_Integer>(length);
  }

  void check_list() const {
    const lua_Integer length = checked_length();
    for (lua_Integer i = 1; i <= length; ++i) {
      lua_rawgeti(lua_, index_, i);
      const int item = lua_gettop(lua_);
      field_.kind == Kind::kVectors ? check_vector(item) : check_number(item);
      lua_pop(lua_, 1);
    }
  }

  // Of a track: {{time, value}, ...}, in ascending order.
  void check_keys() const {
    const lua_Integer length = checked_length();
    double last = -std::numeric_limits<double>::infinity();
    for (lua_Integer i = 1; i <= length; ++i) {
      if (lua_rawgeti(lua_, index_, i) != LUA_TTABLE) complain_of_kind();
      const int key = lua_gettop(lua_);
      if (lua_rawgeti(lua_, key, 1) != LUA_TNUMBER) complain("without a time, s, first in an item");
      const double time = lua_tonumber(lua_, -1);
      if (!(time > last) || !std::isfinite(time)) complain("not ascending in time, s");
      last = time;
      lua_rawgeti(lua_, key, 2);
      const int value = lua_gettop(lua_);
      field_.kind == Kind::kPath ? check_vector(value) : check_number(value);
      lua_pop(lua_, 3);
    }
  }

  void check_text() const {
    require(lua_type(lua_, index_) == LUA_TSTRING);
    const std::size_t bytes = lua_rawlen(lua_, index_);
    if (bytes <= kMostTextBytes) return;
    raise(lua_, fmt::format("{}: '{}' is a text of {} bytes; give at most {}", where_, field_.name,
                            bytes, kMostTextBytes));
  }

  void check_choice() const {
    require(lua_type(lua_, index_) == LUA_TSTRING);
    const std::string_view word = lua_tostring(lua_, index_);
    if (std::ranges::find(field_.choices, word) == field_.choices.end()) {
      complain(fmt::format("\"{}\"", word));
    }
  }

  void check_material() const {
    if (as<Material>(lua_, index_)) return;
    require(lua_type(lua_, index_) == LUA_TSTRING);
    material_named(lua_tostring(lua_, index_));  // throws with the nearest name
  }

  void check_records() const {
    require(lua_istable(lua_, index_));
    if (field_.kind == Kind::kRecord) {
      Arguments(lua_, index_, field_.fields, where_ + ": " + field_.name);
      return;
    }
    const lua_Integer length = checked_length();
    for (lua_Integer i = 1; i <= length; ++i) {
      if (lua_rawgeti(lua_, index_, i) != LUA_TTABLE) complain("a list of something else");
      Arguments(lua_, lua_gettop(lua_), field_.fields, where_ + ": " + field_.name);
      lua_pop(lua_, 1);
    }
  }

  lua_State* lua_;
  int index_;
  const Field& field_;
  const std::string& where_;
};

[[noreturn]] void complain_of_name(lua_State* lua, const std::vector<Field>& fields,
                                   const std::string& where, const std::string& name) {
  if (fields.empty())
    raise(lua, fmt::format("{}: it takes no fields; leave out '{}'", where, name));
  raise(lua, fmt::format("{}: there is no field '{}'; did you mean '{}'?", where, name,
                         nearest_name(fields, name)));
}

// The place of a name among the fields; none of that name: their number.
std::size_t place_of(const std::vector<Field>& fields, std::string_view name) {
  std::size_t place = 0;
  while (place < fields.size() && fields[place].name != name) ++place;
  return place;
}

// Of names that are no fields, the first in the alphabet: Lua's own order differs from run to run.
[[noreturn]] void complain_of_unknown_name(lua_State* lua, int table,
                                           const std::vector<Field>& fields,
                                           const std::string& where) {
  std::string first;
  for (lua_pushnil(lua); lua_next(lua, table) != 0; lua_pop(lua, 1)) {
    if (lua_type(lua, -2) != LUA_TSTRING) {
      raise(lua, fmt::format("{}: it takes named fields; write {}{{{} = ...}}", where, where,
                             fields.empty() ? "name" : fields.front().name));
    }
    std::size_t length = 0;
    const char* const text = lua_tolstring(lua, -2, &length);
    const std::string_view name(text, length);
    if (place_of(fields, name) == fields.size() && (first.empty() || name < first)) first = name;
  }
  complain_of_name(lua, fields, where, first);
}

// Which fields the table has: one bit each.
std::uint64_t fields_given(lua_State* lua, int table, const std::vector<Field>& fields,
                           const std::string& where) {
  std::uint64_t given = 0;
  for (lua_pushnil(lua); lua_next(lua, table) != 0; lua_pop(lua, 1)) {
    std::size_t place = fields.size();
    if (lua_type(lua, -2) == LUA_TSTRING) {
      std::size_t length = 0;
      const char* const name = lua_tolstring(lua, -2, &length);
      place = place_of(fields, {name, length});
    }
    if (place == fields.size()) complain_of_unknown_name(lua, table, fields, where);
    given |= std::uint64_t{1} << place;
  }
  return given;
}

void check_given(lua_State* lua, int table, const std::vector<Field>& fields, std::uint64_t given,
                 const std::string& where) {
  for (std::size_t place = 0; place < fields.size(); ++place) {
    if (!(given >> place & 1)) continue;
    lua_getfield(lua, table, fields[place].name.c_str());
    Check(lua, -1, fields[place], where).run();
    lua_pop(lua, 1);
  }
}

void require_complete(lua_State* lua, const std::vector<Field>& fields, std::uint64_t given,
                      const std::string& where) {
  for (std::size_t place = 0; place < fields.size(); ++place) {
    const Field& f = fields[place];
    if (given >> place & 1 || !std::holds_alternative<Field::Required>(f.otherwise)) continue;
    raise(lua,
          fmt::format("{}: '{}' is missing; give {}: {}", where, f.name, wanted(f), f.meaning));
  }
}

}  // namespace

Arguments::Arguments(lua_State* lua, int index, const std::vector<Field>& fields,
                     const std::string& where)
    : lua_(lua),
      table_(lua_isnoneornil(lua, index) ? 0 : lua_absindex(lua, index)),
      fields_(fields),
      where_(where) {
  luaL_checkstack(lua, 20, "too deep");
  if (table_ != 0) {
    if (!lua_istable(lua, table_)) {
      raise(lua, fmt::format("{}: it got a {}; give named fields in a table: {}{{...}}", where,
                             luaL_typename(lua, table_), where));
    }
    if (lua_getmetatable(lua, table_)) {
      raise(lua, fmt::format("{}: its table has a metatable; give a plain one", where));
    }
    given_ = fields_given(lua, table_, fields, where);
    check_given(lua, table_, fields, given_, where);
  }
  require_complete(lua, fields, given_, where);
}

const Field& Arguments::field_of(const char* name) const {
  const std::size_t place = place_of(fields_, name);
  if (place < fields_.size()) return fields_[place];
  complain_of_name(lua_, fields_, where_, name);
}

bool Arguments::given(const char* name) const {
  const std::size_t place = place_of(fields_, name);
  return place < fields_.size() && (given_ >> place & 1) != 0;
}

bool Arguments::has(const char* name) const {
  return given(name) || !std::holds_alternative<Field::Optional>(field_of(name).otherwise);
}

void Arguments::push(const char* name) const {
  if (!given(name)) {
    lua_pushnil(lua_);
  } else {
    lua_getfield(lua_, table_, name);
  }
}

double Arguments::number(const char* name) const {
  if (!given(name)) return std::get<double>(field_of(name).otherwise);
  push(name);
  const double value = lua_tonumber(lua_, -1);
  lua_pop(lua_, 1);
  return value;
}

int Arguments::whole(const char* name) const { return static_cast<int>(number(name)); }

bool Arguments::flag(const char* name) const {
  if (!given(name)) return std::get<bool>(field_of(name).otherwise);
  push(name);
  const bool value = lua_toboolean(lua_, -1);
  lua_pop(lua_, 1);
  return value;
}

std::string Arguments::text(const char* name) const {
  if (!given(name)) return std::get<std::string>(field_of(name).otherwise);
  push(name);
  std::size_t length = 0;
  const char* const text = lua_tolstring(lua_, -1, &length);
  std::string value(text, length);
  lua_pop(lua_, 1);
  return value;
}

Vec3 Arguments::vector(const char* name) const {
  if (!given(name)) return std::get<Vec3>(field_of(name).otherwise);
  push(name);
  const Vec3 value = to_vector(lua_, -1);
  lua_pop(lua_, 1);
  return value;
}

std::array<int, 3> Arguments::wholes(const char* name) const {
  const Vec3 v = vector(name);
  return {static_cast<int>(v.x()), static_cast<int>(v.y()), static_cast<int>(v.z())};
}

Mat3 Arguments::rotation(const char* name) const {
  Mat3 rotation = Mat3::Identity();
  each(name, [&](const Arguments& of) {
    rotation =
        Eigen::AngleAxisd(of.number("angle"), of.vector("axis").normalized()).toRotationMatrix();
  });
  return rotation;
}

namespace {

template <class T, class Read>
Track<T> track(lua_State* lua, const Read& read) {
  const int list = lua_gettop(lua);
  std::vector<typename Track<T>::Key> keys;
  const auto length = static_cast<lua_Integer>(lua_rawlen(lua, list));
  for (lua_Integer i = 1; i <= length; ++i) {
    if (lua_rawgeti(lua, list, i) != LUA_TTABLE) {
      raise(lua, "a list changed while it was read; leave it alone in callbacks");
    }
    lua_rawgeti(lua, -1, 1);
    lua_rawgeti(lua, -2, 2);
    keys.push_back({lua_tonumber(lua, -2), read(lua_gettop(lua))});
    lua_pop(lua, 3);
  }
  return Track<T>(std::move(keys));
}

}  // namespace

Track<double> Arguments::steps(const char* name) const {
  push(name);
  if (!lua_istable(lua_, -1)) {
    lua_pop(lua_, 1);
    return number(name);
  }
  Track<double> steps = track<double>(lua_, [&](int i) { return lua_tonumber(lua_, i); });
  lua_pop(lua_, 1);
  return steps;
}

Track<Vec3> Arguments::path(const char* name) const {
  push(name);
  if (lua_isnil(lua_, -1) || is_vector(lua_, -1)) {
    lua_pop(lua_, 1);
    return vector(name);
  }
  Track<Vec3> path = track<Vec3>(lua_, [&](int i) { return to_vector(lua_, i); });
  lua_pop(lua_, 1);
  return path;
}

std::vector<Vec3> Arguments::vectors(const char* name) const {
  std::vector<Vec3> values;
  push(name);
  const auto length = static_cast<lua_Integer>(lua_rawlen(lua_, -1));
  for (lua_Integer i = 1; i <= length; ++i) {
    lua_rawgeti(lua_, -1, i);
    values.push_back(to_vector(lua_, -1));
    lua_pop(lua_, 1);
  }
  lua_pop(lua_, 1);
  return values;
}

std::vector<double> Arguments::numbers(const char* name) const {
  std::vector<double> values;
  push(name);
  const auto length = static_cast<lua_Integer>(lua_rawlen(lua_, -1));
  for (lua_Integer i = 1; i <= length; ++i) {
    lua_rawgeti(lua_, -1, i);
    values.push_back(lua_tonumber(lua_, -1));
    lua_pop(lua_, 1);
  }
  lua_pop(lua_, 1);
  return values;
}

Material Arguments::material(const char* name) const {
  if (const Material* own = handle<Material>(name)) return *own;
  return material_named(text(name)).material;
}

Field rotation_field(std::string meaning) {
  return record("rotation",
                {field("axis", Kind::kDirection, "", "that it turns about, right-handed")
                     .or_else(Vec3(0.0, 1.0, 0.0)),
                 number("angle", "rad", "how far it turns")},
                std::move(meaning))
      .optional();
}

}  // namespace limber::demos

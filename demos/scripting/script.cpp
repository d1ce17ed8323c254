#include "demos/scripting/script.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <utility>

#include "core/model/nearest_name.h"
#include "demos/scripting/api.h"
#include "demos/scripting/safe_strings.h"
#include "demos/scripting/sandbox.h"

namespace limber::demos {
namespace {

constexpr std::size_t kMostTimers = 10'000;
constexpr std::size_t kMostInputs = 100'000;
constexpr const char* kDeclared = "the script was read for its scene{} alone";

// "scene.lua:12: WHAT; REMEDY" and where it was called from, as a message of ours.
Diagnostic diagnostic_of(const LuaFailure& failure, const std::string& script) {
  std::string where = script, what = failure.message, remedy = "mend the script";
  const auto digits = what.find_first_of("0123456789", what.find(':'));
  const auto end = what.find(": ");
  if (digits != std::string::npos && end != std::string::npos && digits < end) {
    where = what.substr(0, end);
    what = what.substr(end + 2);
  }
  if (const auto split = what.find("; "); split != std::string::npos) {
    remedy = what.substr(split + 2);
    what.resize(split);
  }
  if (!failure.traceback.empty()) remedy += '\n' + failure.traceback;
  return {where, what, remedy};
}

void require_function(lua_State* lua, const std::string& name) {
  if (lua_getglobal(lua, name.c_str()) != LUA_TFUNCTION) {
    raise(lua, fmt::format("'{}' is a {}, and nothing could call it; write function {}(...)", name,
                           luaL_typename(lua, -1), name));
  }
  lua_pop(lua, 1);
}

}  // namespace

Script& script_of(lua_State* lua) { return *static_cast<Script*>(owner_of(lua)); }

Script::Script(const ScriptSource& source, const ParameterValues& values,
               const ScriptSettings& settings)
    : source_(source),
      values_(values),
      settings_(settings),
      state_(settings.limits),
      inputs_(settings.inputs),
      points_left_(static_cast<double>(settings.limits.points)),
      objects_left_(settings.limits.objects),
      bodies_left_(settings.limits.bodies),
      print_left_(settings.limits.printed_bytes) {
  scene_.name = std::filesystem::path(source.name).stem().string();
  std::ranges::stable_sort(inputs_, {}, &InputEvent::time_s);
  open();
  run_main();
}

Script::Script(const ScriptSource& source, const ScriptSettings& settings)
    : source_(source),
      settings_(settings),
      header_only_(true),
      state_(settings.limits),
      points_left_(static_cast<double>(settings.limits.points)),
      objects_left_(settings.limits.objects),
      bodies_left_(settings.limits.bodies),
      print_left_(0) {
  open();
}

void Script::open() {
  state_.set_owner(this);
  const bool good = state_.protect([](lua_State* lua) {
    lua_register(lua, "print", print);
    lua_register(lua, "require", require);
    lua_newtable(lua);
    lua_setfield(lua, LUA_REGISTRYINDEX, "limber modules");
    open_sandbox(lua);
    lua_register(lua, "print", print);
    open_api(lua);
  });
  if (!good) throw as_input_error();
}

void Script::load(lua_State* lua, const std::string& name, const std::string& text) {
  // Text alone: what is compiled already may break Lua's machine.
  if (luaL_loadbufferx(lua, text.data(), text.size(), ("@" + name).c_str(), "t") != LUA_OK) {
    lua_error(lua);
  }
}

void Script::run_main() {
  state_.allow(settings_.limits.load_steps, "setting the scene up");
  const bool good = state_.protect([this](lua_State* lua) {
    load(lua, source_.name, source_.text);
    if (source_.model) {
      push(lua, std::make_shared<PhysicalModel>(*source_.model));
    } else {
      lua_pushnil(lua);
    }
    lua_call(lua, 1, 0);
    refuse_unknown_callbacks(lua);
  });
  if (!good) throw as_input_error();
}

void Script::refuse_unknown_callbacks(lua_State* lua) {
  const auto& callbacks = api_callbacks();
  for (const std::string& name : global_names(lua)) {
    if (!name.starts_with("on_")) continue;
    if (std::ranges::find(callbacks, name, &ApiCallback::name) != callbacks.end()) {
      require_function(lua, name);
      continue;
    }
    raise(lua, fmt::format("nothing calls '{}'; did you mean '{}'?", name,
                           nearest_name(callbacks, name)));
  }
}

InputError Script::as_input_error() const {
  return InputError(diagnostic_of(state_.failure(), source_.name));
}

ScriptHeader read_header(const ScriptSource& source, const ScriptSettings& settings) {
  Script script(source, settings);
  try {
    script.run_main();
  } catch (const InputError&) {
    if (!script.header_) throw;
  }
  return script.header_.value_or(ScriptHeader{});
}

void Script::declare(const std::string& summary, std::vector<Parameter> parameters) {
  if (header_) raise(state_.raw(), "scene{} was called before; call it once, first of all");
  header_ = ScriptHeader{summary, std::move(parameters)};
  if (header_only_) state_.stop(kDeclared);
}

int Script::print(lua_State* lua) {
  Script& script = script_of(lua);
  std::string line;
  bool fits = true;
  for (int i = 1; i <= lua_gettop(lua); ++i) {
    push_text(lua, i);
    std::size_t length = 0;
    const char* const text = lua_tolstring(lua, -1, &length);
    state_of(lua).spend(length + 1);
    fits = fits && line.size() + length + (i > 1 ? 1 : 0) < script.print_left_;
    if (fits) line.append(i > 1 ? "\t" : "").append(text, length);
    lua_pop(lua, 1);
  }
  if (!fits || line.size() >= script.print_left_) return 0;
  script.print_left_ -= line.size() + 1;
  const bool silent = script.settings_.silent_set_up && !script.simulation_;
  if (silent || !script.settings_.printed) return 0;
  *script.settings_.printed << line << '\n';
  return 0;
}

// Each module runs once; what it returns is kept.
int Script::require(lua_State* lua) {
  Script& script = script_of(lua);
  const std::string name = luaL_checkstring(lua, 1);
  lua_settop(lua, 1);
  lua_getfield(lua, LUA_REGISTRYINDEX, "limber modules");
  if (lua_getfield(lua, -1, name.c_str()) != LUA_TNIL) return 1;
  std::string message;
  try {
    const std::string path = module_path(name);
    ScriptSource module = script_in_file(script.file(path), script.settings_.limits.file_bytes);
    module.name = path;
    script.load(lua, module.name, module.text);
  } catch (const InputError& error) {
    message = error.diagnostic.text();
  }
  if (!message.empty()) raise(lua, message);
  lua_call(lua, 0, 1);
  if (lua_isnil(lua, -1)) lua_pushboolean(lua, 1);
  lua_pushvalue(lua, -1);
  lua_setfield(lua, 2, name.c_str());
  return 1;
}

void Script::require_setting_up(const std::string& where) {
  if (simulation_) {
    raise(state_.raw(), where + ": the scene runs already; call it while the scene is set up");
  }
}

Simulation& Script::require_running(const std::string& where) {
  if (!simulation_) {
    raise(state_.raw(), where +
                            ": the scene does not run yet; call it in on_start, on_tick, "
                            "another callback or a timer");
  }
  return *simulation_;
}

void Script::take_points(double count) {
  if (!(count <= points_left_)) {
    raise(state_.raw(),
          fmt::format("the models and meshes of a script may have {} points in all, and this "
                      "would be {:.0f} too many; take larger cells",
                      settings_.limits.points, count - points_left_));
  }
  points_left_ -= count;
}

void Script::take_object() {
  if (objects_left_ == 0) {
    raise(state_.raw(),
          fmt::format("a scene has at most {} objects; spawn fewer", settings_.limits.objects));
  }
  --objects_left_;
}

void Script::take_body() {
  if (bodies_left_ == 0) {
    raise(state_.raw(),
          fmt::format("a scene has at most {} rigid bodies; make fewer", settings_.limits.bodies));
  }
  --bodies_left_;
}

std::filesystem::path Script::file(const std::string& name) const {
  if (settings_.on_file) settings_.on_file(source_.folder / name);
  return file_beside(source_, name);
}

void Script::add_timer(double time_s, std::optional<double> period) {
  lua_State* const lua = state_.raw();
  if (timers_.size() >= kMostTimers) {
    raise(lua, fmt::format("there are {} timers already; end some", kMostTimers));
  }
  timers_.push_back({time_s, period, luaL_ref(lua, LUA_REGISTRYINDEX)});
}

void Script::add_input(InputEvent input) {
  if (inputs_.size() - next_input_ >= kMostInputs) {
    raise(state_.raw(), fmt::format("there are {} inputs already; play fewer", kMostInputs));
  }
  if (2 * next_input_ > inputs_.size()) {  // seldom: what is to come moves
    inputs_.erase(inputs_.begin(), inputs_.begin() + static_cast<std::ptrdiff_t>(next_input_));
    next_input_ = 0;
  }
  const auto from = inputs_.begin() + static_cast<std::ptrdiff_t>(next_input_);
  const auto place =
      std::ranges::upper_bound(from, inputs_.end(), input.time_s, {}, &InputEvent::time_s);
  state_.spend(static_cast<std::uint64_t>(inputs_.end() - place));
  inputs_.insert(place, std::move(input));
}

Air& Script::air() {
  if (!air_) air_ = scene_.air.value_or(Air{});
  return *air_;
}

}  // namespace limber::demos

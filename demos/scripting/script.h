#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "demos/scenes/simulation.h"
#include "demos/scripting/lua_state.h"
#include "demos/scripting/script_source.h"

namespace limber::demos {

// What a player, or who stands in for one, does at an instant.
struct InputEvent {
  double time_s = 0.0;
  std::string name;
  double value = 0.0;
};

struct ScriptSettings {
  ScriptLimits limits = {};
  std::vector<InputEvent> inputs = {};
  std::ostream* printed = nullptr;  // where print() goes; null: nowhere
  bool silent_set_up = false;       // it was printed before: the script runs once more
  // Called before a module, mesh or model is read that the script names, be it there or not.
  std::function<void(const std::filesystem::path&)> on_file = {};
};

// What a script says about itself by scene{}.
struct ScriptHeader {
  std::string summary;
  std::vector<Parameter> parameters;
};

// Runs a script up to its scene{}. Throws InputError with file, line and traceback for what is
// wrong until there.
ScriptHeader read_header(const ScriptSource& source, const ScriptSettings& settings);

// A script in a state of Lua of its own. Made, it has set up its scene; as the behaviour of a
// running one it is called for what happens. What scripts call is in api.h.
class Script : public Behaviour {
 public:
  // Runs the script. Throws InputError with file, line and traceback.
  Script(const ScriptSource& source, const ParameterValues& values, const ScriptSettings& settings);

  const Scene& scene() const { return scene_; }
  bool has_callbacks();  // or timers: is there anything to do while the scene runs?

  void start(Simulation& simulation) override;
  void before_tick(Simulation& simulation, double dt) override;
  void after_tick(Simulation& simulation) override;

  // What the functions of the API use. Those that may raise Lua errors say so.

  // While the scene is set up.
  Scene& draft() { return scene_; }
  // Raises unless the scene is being set up, or, of the other, runs.
  void require_setting_up(const std::string& where);
  Simulation& require_running(const std::string& where);
  Simulation* simulation() { return simulation_; }  // null while the scene is set up
  const Scene& scene_now() const { return simulation_ ? simulation_->scene() : scene_; }

  void declare(const std::string& summary, std::vector<Parameter> parameters);  // raises
  double parameter(const std::string& name) const { return values_.at(name); }

  // Takes from what the limits leave; raises when there is not as much.
  void take_points(double count);
  void take_object();
  void take_body();

  // A file in the scene's folder or below, to be read at once. Throws InputError.
  std::filesystem::path file(const std::string& name) const;

  // The function on top of the stack, which it takes, is called at this simulated time, and then
  // again every `period` s (none: once) until it returns false.
  void add_timer(double time_s, std::optional<double> period);
  void add_input(InputEvent input);

  // The pieces of an object as they are just now; those of all are put together when they are
  // first asked for in a tick.
  std::span<const bullet::PieceView> pieces_of(std::size_t object);
  // Where they are, after pushes as well: these change only how they move.
  std::span<const bullet::PieceView> places_of(std::size_t object);
  void state_changed() { pieces_.reset(); }
  void motion_changed() { pushed_ = true; }

  // The wind, which takes effect with the next tick.
  Air& air();
  void air_changed() { air_changed_ = true; }

 private:
  struct Timer {
    double time_s = 0.0;
    std::optional<double> period;
    int function = 0;  // in Lua's registry
  };
  friend ScriptHeader read_header(const ScriptSource& source, const ScriptSettings& settings);
  Script(const ScriptSource& source, const ScriptSettings& settings);  // for the header alone

  static int print(lua_State* lua);
  static int require(lua_State* lua);
  void open();
  void run_main();
  void load(lua_State* lua, const std::string& name, const std::string& text);
  void refuse_unknown_callbacks(lua_State* lua);
  InputError as_input_error() const;
  // Works on the running simulation; throws BehaviourError when the script fails.
  void while_running(Simulation& simulation, const std::function<void(lua_State*)>& work);
  void run_timers(lua_State* lua);
  void run_inputs(lua_State* lua);
  void tell_switches(lua_State* lua);
  void tell_breaks(lua_State* lua);
  void tell_splits(lua_State* lua);
  void tell_contacts(lua_State* lua);
  void give_air(Simulation& simulation);

  ScriptSource source_;
  ParameterValues values_;
  ScriptSettings settings_;
  bool header_only_ = false;
  std::optional<ScriptHeader> header_;
  LuaState state_;
  Scene scene_;
  Simulation* simulation_ = nullptr;
  std::vector<Timer> timers_;
  std::vector<InputEvent> inputs_;  // ascending in time, from next_input_ on still to come
  std::size_t next_input_ = 0;
  std::optional<Air> air_;
  bool air_changed_ = false;
  std::optional<std::vector<bullet::PieceView>> pieces_;  // by object
  std::vector<std::size_t> first_piece_;                  // of each object, and the end
  bool pushed_ = false;                                   // since pieces_ were put together
  double points_left_;
  std::size_t objects_left_, bodies_left_, print_left_;
  std::size_t switches_seen_ = 0, breaks_seen_ = 0, splits_seen_ = 0;
  std::vector<std::pair<bullet::StageThing, bullet::StageThing>> touching_;  // ascending
};

Script& script_of(lua_State* lua);

}  // namespace limber::demos

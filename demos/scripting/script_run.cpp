#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "demos/scripting/api.h"
#include "demos/scripting/lua_types.h"
#include "demos/scripting/script.h"

// A script while its scene runs: what it is told, in this order. Before a tick timers that are due,
// inputs, on_tick; after it what happened in it.

namespace limber::demos {
namespace {

// Puts the callback on the stack; false, and nothing there, if the script has none of this name.
bool push_callback(lua_State* lua, const char* name) {
  lua_pushglobaltable(lua);
  lua_pushstring(lua, name);
  const bool there = lua_rawget(lua, -2) == LUA_TFUNCTION;
  lua_remove(lua, -2);
  if (!there) lua_pop(lua, 1);
  return there;
}

// Fills the table of an event, on top of the stack.
class Event {
 public:
  explicit Event(lua_State* lua) : lua_(lua) { lua_createtable(lua, 0, 6); }

  Event& number(const char* name, double value) {
    lua_pushnumber(lua_, value);
    lua_setfield(lua_, -2, name);
    return *this;
  }
  Event& text(const char* name, const std::string& value) {
    lua_pushlstring(lua_, value.data(), value.size());
    lua_setfield(lua_, -2, name);
    return *this;
  }
  template <class T>
  Event& value(const char* name, T value) {
    push(lua_, std::move(value));
    lua_setfield(lua_, -2, name);
    return *this;
  }
  Event& thing(const char* name, const bullet::StageThing& thing) {
    if (thing.kind == bullet::StageThing::Kind::kObject) value(name, ObjectHandle{thing.index});
    if (thing.kind == bullet::StageThing::Kind::kBody) value(name, BodyHandle{thing.index});
    return *this;
  }

 private:
  lua_State* lua_;
};

}  // namespace

bool Script::has_callbacks() {
  bool any = !timers_.empty() || !inputs_.empty();
  state_.protect([&](lua_State* lua) {
    for (const ApiCallback& callback : api_callbacks()) {
      if (!push_callback(lua, callback.name.c_str())) continue;
      lua_pop(lua, 1);
      any = true;
    }
  });
  return any;
}

void Script::while_running(Simulation& simulation, const std::function<void(lua_State*)>& work) {
  simulation_ = &simulation;
  const bool good = state_.protect(work);
  simulation_ = nullptr;
  if (good) return;
  const Diagnostic why = as_input_error().diagnostic;
  throw BehaviourError(
      {why.where, fmt::format("at {:.4g} s: {}", simulation.time_s(), why.what), why.remedy});
}

void Script::start(Simulation& simulation) {
  const auto& limber = simulation.stage().co_simulation();
  switches_seen_ = limber.switches().size();
  state_.allow(settings_.limits.load_steps, "on_start");
  while_running(simulation, [](lua_State* lua) {
    if (push_callback(lua, "on_start")) lua_call(lua, 0, 0);
  });
}

void Script::before_tick(Simulation& simulation, double dt) {
  state_changed();
  state_.allow(settings_.limits.tick_steps, "the callbacks of this tick");
  while_running(simulation, [&](lua_State* lua) {
    run_timers(lua);
    run_inputs(lua);
    if (!push_callback(lua, "on_tick")) return;
    lua_pushnumber(lua, dt);
    lua_call(lua, 1, 0);
  });
  give_air(simulation);
}

void Script::give_air(Simulation& simulation) {
  if (!std::exchange(air_changed_, false)) return;
  simulation.stage().co_simulation().set_air(air_);
}

void Script::after_tick(Simulation& simulation) {
  state_changed();
  while_running(simulation, [this](lua_State* lua) {
    tell_switches(lua);
    tell_breaks(lua);
    tell_splits(lua);
    tell_contacts(lua);
  });
}

// Those that are due, the earliest first; one that starts another has it wait for the next tick.
void Script::run_timers(lua_State* lua) {
  const double now = simulation_->time_s();
  std::vector<Timer> due;
  std::erase_if(timers_, [&](const Timer& timer) {
    if (timer.time_s > now) return false;
    due.push_back(timer);
    return true;
  });
  std::ranges::stable_sort(due, {}, &Timer::time_s);
  for (Timer& timer : due) {
    lua_rawgeti(lua, LUA_REGISTRYINDEX, timer.function);
    lua_call(lua, 0, 1);
    const bool ended = lua_isboolean(lua, -1) && !lua_toboolean(lua, -1);
    lua_pop(lua, 1);
    if (timer.period && !ended) {
      timer.time_s += *timer.period;
      timers_.push_back(timer);
    } else {
      luaL_unref(lua, LUA_REGISTRYINDEX, timer.function);
    }
  }
}

void Script::run_inputs(lua_State* lua) {
  const double now = simulation_->time_s();
  while (next_input_ < inputs_.size() && inputs_[next_input_].time_s <= now) {
    const InputEvent input = inputs_[next_input_++];
    if (!push_callback(lua, "on_input")) continue;
    lua_pushlstring(lua, input.name.data(), input.name.size());
    lua_pushnumber(lua, input.value);
    lua_call(lua, 2, 0);
  }
}

void Script::tell_switches(lua_State* lua) {
  const auto& switches = simulation_->stage().co_simulation().switches();
  while (switches_seen_ < switches.size()) {
    const bullet::SwitchRecord record = switches[switches_seen_++];
    if (!push_callback(lua, record.books.to_flexible ? "on_flexible" : "on_rigid")) continue;
    Event(lua)
        .value("object", ObjectHandle{record.object})
        .text("cause", record.cause)
        .number("time", record.time)
        .number("piece", static_cast<double>(record.piece));
    lua_call(lua, 1, 0);
  }
}

void Script::tell_breaks(lua_State* lua) {
  const auto& breaks = simulation_->stage().co_simulation().breaks();
  while (breaks_seen_ < breaks.size()) {
    const bullet::BreakRecord record = breaks[breaks_seen_++];
    if (!push_callback(lua, "on_break")) continue;
    Event(lua)
        .value("object", ObjectHandle{record.object})
        .value("at", record.where)
        .number("time", record.time)
        .number("edge", record.edge + 1.0);
    lua_call(lua, 1, 0);
  }
}

void Script::tell_splits(lua_State* lua) {
  const auto& splits = simulation_->stage().co_simulation().splits();
  while (splits_seen_ < splits.size()) {
    const bullet::SplitRecord record = splits[splits_seen_++];
    if (!push_callback(lua, "on_split")) continue;
    Event(lua)
        .value("object", ObjectHandle{record.object})
        .number("time", record.time)
        .number("pieces", static_cast<double>(record.parts.size()))
        .number("particles", static_cast<double>(record.particles));
    lua_call(lua, 1, 0);
  }
}

// Of pairs that did not touch in the tick before.
void Script::tell_contacts(lua_State* lua) {
  if (!push_callback(lua, "on_contact")) return;
  lua_pop(lua, 1);
  std::vector<std::pair<bullet::StageThing, bullet::StageThing>> now;
  for (const bullet::StageContact& contact : simulation_->stage().contacts()) {
    // Whichever is the lattice: the floor last, bodies before objects, in the order they were made.
    auto [thing, other] = std::pair(std::minmax(contact.first, contact.second));
    now.emplace_back(thing, other);
    if (std::ranges::binary_search(touching_, now.back())) continue;
    const bool floor_first = thing.kind == bullet::StageThing::Kind::kFloor;
    push_callback(lua, "on_contact");
    Event(lua)
        .thing("thing", floor_first ? other : thing)
        .thing("other", floor_first ? thing : other)
        .value("at", contact.at)
        .number("impulse", contact.impulse);
    lua_call(lua, 1, 0);
  }
  std::ranges::sort(now);
  touching_ = std::move(now);
}

std::span<const bullet::PieceView> Script::places_of(std::size_t object) {
  if (!pieces_) {
    const bullet::CoSimulation& limber = simulation_->stage().co_simulation();
    pieces_ = limber.pieces();
    pushed_ = false;
    std::ranges::stable_sort(*pieces_, {}, &bullet::PieceView::object);
    first_piece_.assign(1, 0);
    for (std::size_t o = 0; o < limber.object_count(); ++o) {
      std::size_t end = first_piece_.back();
      while (end < pieces_->size() && (*pieces_)[end].object == o) ++end;
      first_piece_.push_back(end);
    }
  }
  return std::span(*pieces_).subspan(first_piece_[object],
                                     first_piece_[object + 1] - first_piece_[object]);
}

std::span<const bullet::PieceView> Script::pieces_of(std::size_t object) {
  if (pushed_) state_changed();
  return places_of(object);
}

}  // namespace limber::demos

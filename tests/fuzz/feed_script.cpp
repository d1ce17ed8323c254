#include "tests/fuzz/feed_script.h"

#include "demos/scripting/script_scene.h"

namespace limber::demos::fuzz {
namespace {

ScriptSettings small_limits() {
  ScriptSettings settings;
  settings.limits.memory_bytes = std::size_t{4} << 20;
  settings.limits.load_steps = 1'000'000;
  settings.limits.tick_steps = 200'000;
  settings.limits.points = 1000;
  settings.limits.bodies = 40;
  settings.limits.objects = 20;
  return settings;
}

std::string fault_in(const Diagnostic& said) {
  if (said.where.empty() || said.what.empty() || said.remedy.empty()) {
    return "a message that lacks something: " + said.text();
  }
  return "";
}

}  // namespace

std::string fault_of(const std::string& script) {
  try {
    const SceneEntry entry = script_entry({"fuzz.lua", script, {}}, small_limits());
    ParameterValues values;
    for (const Parameter& p : entry.parameters) values[p.name] = p.value;
    const Scene scene = entry.build(values);
    RunOptions options;
    options.tick = 1.0 / 60.0;
    options.seconds = 2.0 / 60.0;
    const RunResult result = run(scene, options);
    return result.failure ? fault_in(*result.failure) : "";
  } catch (const InputError& error) {
    return fault_in(error.diagnostic);
  } catch (const SimulationError& error) {
    return fault_in(error.diagnostic);
  } catch (const std::exception& error) {
    return std::string("an exception that is no message: ") + error.what();
  }
}

}  // namespace limber::demos::fuzz

#include "demos/cli/watch.h"

#include <chrono>
#include <filesystem>
#include <ostream>
#include <thread>

#include "demos/cli/interrupt.h"
#include "demos/cli/run_report.h"
#include "demos/cli/watched_files.h"

namespace limber::demos {
namespace {

using Clock = std::chrono::steady_clock;

// Between two looks at the files: soon enough for a person who saves and looks up.
constexpr std::chrono::milliseconds kLookPause(200);

class Watch {
 public:
  Watch(const SceneOptions& options, Terminal& terminal) : options_(options), terminal_(terminal) {}

  void run() {
    while (!interrupt_.came()) {
      run_once();
      if (interrupt_.came()) return;
      terminal_.out.flush();
      terminal_.err << "limber: waiting for a change; Ctrl-C ends" << std::endl;
      while (!interrupt_.came() && !files_.changed()) std::this_thread::sleep_for(kLookPause);
      terminal_.err << (interrupt_.came() ? "" : "limber: it was saved, and runs again\n");
    }
  }

 private:
  void run_once() {
    files_.clear();
    files_.add(options_.scene);
    looked_ = Clock::now();
    saved_ = false;
    try {
      const Scene scene =
          scene_of(options_, terminal_, [&](const std::filesystem::path& f) { files_.add(f); });
      say_notes(scene.notes, terminal_);
      const RunResult result =
          run_with_progress(options_, scene, terminal_, [&] { return !ended_early(); });
      if (saved_) return;  // it is about another file than there is now
      report_run(options_, scene, result, terminal_);
    } catch (const InputError& error) {
      say_failure(error.diagnostic, terminal_);
    } catch (const SimulationError& error) {
      say_failure(error.diagnostic, terminal_);
    }
  }

  bool ended_early() {
    if (interrupt_.came()) return true;
    if (Clock::now() - looked_ < kLookPause) return false;
    looked_ = Clock::now();
    saved_ = files_.changed();
    return saved_;
  }

  const SceneOptions& options_;
  Terminal& terminal_;
  Interrupt interrupt_;
  WatchedFiles files_;
  Clock::time_point looked_;
  bool saved_ = false;  // in the middle of a run
};

}  // namespace

void watch_scene(const SceneOptions& options, Terminal& terminal) {
  if (!std::filesystem::is_regular_file(options.scene)) {
    throw InputError({"--watch", "there is no file '" + options.scene + "' to watch",
                      "name a script of your own, my_scene.lua for instance"});
  }
  Watch(options, terminal).run();
}

}  // namespace limber::demos

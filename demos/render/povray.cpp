#include "demos/render/povray.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <deque>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "core/model/errors.h"

extern char** environ;

namespace limber::demos {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScene = "scene.pov";
constexpr const char* kImage = "image.png";
constexpr const char* kLog = "povray.log";
constexpr std::size_t kLogLines = 4;  // shown of a failure

// A folder of our own that goes with everything in it.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (fs::temp_directory_path() / "limber-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      throw InputError({name, fmt::format("cannot be made: {}", std::strerror(errno)),
                        "let TMPDIR name a folder where you may write"});
    }
    path_ = name;
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

struct SpawnActions {
  posix_spawn_file_actions_t actions;
  SpawnActions() { ::posix_spawn_file_actions_init(&actions); }
  ~SpawnActions() { ::posix_spawn_file_actions_destroy(&actions); }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;
};

int wait_for(pid_t process) {
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

// Runs POV-Ray inside `folder`, where alone its own settings allow it to read and write everywhere
// we go; what it says lands in the log there. Returns the wait status.
int run_povray(const fs::path& folder, std::vector<std::string> arguments) {
  SpawnActions spawn;
  ::posix_spawn_file_actions_addchdir_np(&spawn.actions, folder.c_str());
  ::posix_spawn_file_actions_addopen(&spawn.actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&spawn.actions, STDOUT_FILENO, kLog,
                                     O_WRONLY | O_CREAT | O_APPEND, 0600);
  ::posix_spawn_file_actions_adddup2(&spawn.actions, STDOUT_FILENO, STDERR_FILENO);
  arguments.insert(arguments.begin(), "povray");
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  pid_t process = 0;
  const int error =
      ::posix_spawnp(&process, "povray", &spawn.actions, nullptr, argv.data(), environ);
  if (error == 0) return wait_for(process);
  throw InputError({"POV-Ray", fmt::format("cannot be started: {}", std::strerror(error)),
                    "install it, on Debian with `apt install povray`"});
}

std::string contents_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// Joined by " | ", for a message of one line.
std::string last_lines(const fs::path& log) {
  std::ifstream in(log);
  std::deque<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    lines.push_back(line);
    if (lines.size() > kLogLines) lines.pop_front();
  }
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : " | ") + line;
  return text;
}

std::string ending(int status) {
  if (WIFSIGNALED(status)) return fmt::format("was ended by signal {}", WTERMSIG(status));
  return fmt::format("failed with exit code {}", WEXITSTATUS(status));
}

}  // namespace

void require_povray() {
  const ScratchFolder folder;
  run_povray(folder.path(), {"--version"});
}

std::string trace_png(const std::string& pov_text, const PictureSize& size) {
  const ScratchFolder folder;
  std::ofstream(folder.path() / kScene, std::ios::binary) << pov_text;
  // No display, 8-bit PNG, recursive anti-aliasing without jitter: the same pixels every time.
  const int status =
      run_povray(folder.path(), {fmt::format("+I{}", kScene), fmt::format("+O{}", kImage),
                                 fmt::format("+W{}", size.width), fmt::format("+H{}", size.height),
                                 "-D", "-P", "+FN8", "+A0.2", "+AM2", "+R2", "-J"});
  std::string png = contents_of(folder.path() / kImage);
  if (status == 0 && !png.empty()) return png;
  throw SimulationError({"POV-Ray",
                         fmt::format("{}: {}", ending(status), last_lines(folder.path() / kLog)),
                         "check the free memory and the room in the temporary folder"});
}

}  // namespace limber::demos

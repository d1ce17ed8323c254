#include "demos/render/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <deque>
#include <fstream>
#include <sstream>

#include "core/model/errors.h"

extern char** environ;

namespace limber::demos {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLog = "program.log";
constexpr std::size_t kLogLines = 4;  // shown of a failure

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

// Returns the wait status.
int run(const Program& program, std::vector<std::string> arguments, const fs::path& folder) {
  SpawnActions spawn;
  ::posix_spawn_file_actions_addchdir_np(&spawn.actions, folder.c_str());
  ::posix_spawn_file_actions_addopen(&spawn.actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&spawn.actions, STDOUT_FILENO, kLog,
                                     O_WRONLY | O_CREAT | O_APPEND, 0600);
  ::posix_spawn_file_actions_adddup2(&spawn.actions, STDOUT_FILENO, STDERR_FILENO);
  arguments.insert(arguments.begin(), program.command);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  pid_t process = 0;
  const int error =
      ::posix_spawnp(&process, program.command, &spawn.actions, nullptr, argv.data(), environ);
  if (error == 0) return wait_for(process);
  throw InputError({program.name, fmt::format("cannot be started: {}", std::strerror(error)),
                    fmt::format("install it, on Debian with `apt install {}`", program.package)});
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

ScratchFolder::ScratchFolder() {
  std::string name = (fs::temp_directory_path() / "limber-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) {
    throw InputError({name, fmt::format("cannot be made: {}", std::strerror(errno)),
                      "let TMPDIR name a folder where you may write"});
  }
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void run_program(const Program& program, const std::vector<std::string>& arguments,
                 const fs::path& folder) {
  const int status = run(program, arguments, folder);
  if (status == 0) return;
  throw SimulationError({program.name,
                         fmt::format("{}: {}", ending(status), last_lines(folder / kLog)),
                         "check the free memory and the room in the temporary folder"});
}

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace limber::demos

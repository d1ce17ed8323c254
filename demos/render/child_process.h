#pragma once

#include <filesystem>
#include <string>
#include <vector>

// Programs of others, run in a folder of their own: what they write and say is gone with it.
namespace limber::demos {

// A folder of our own that goes with everything in it. Throws InputError where none can be made.
class ScratchFolder {
 public:
  ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder();
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// A program as its user knows it.
struct Program {
  const char* name;     // "gnuplot"
  const char* command;  // found by PATH
  const char* package;  // of Debian
};

// Runs it with `folder` as its working directory, without standard input, and waits. Throws
// InputError with the way to install it where it cannot be started, SimulationError with the last
// lines that it said where it fails.
void run_program(const Program& program, const std::vector<std::string>& arguments,
                 const std::filesystem::path& folder);

// All bytes of a file; none, where there is no file.
std::string bytes_of(const std::filesystem::path& file);

}  // namespace limber::demos

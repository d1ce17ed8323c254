#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "demos/cli/cli_main.h"

namespace limber::test {

// What the program answers to a command line.
struct Said {
  int code;
  std::string out, err;
};

inline Said limber(const std::vector<std::string>& arguments) {
  std::vector<const char*> argv = {"limber"};
  for (const std::string& a : arguments) argv.push_back(a.c_str());
  std::ostringstream out, err;
  const int code = demos::cli_main(static_cast<int>(argv.size()), argv.data(), out, err);
  return {code, out.str(), err.str()};
}

}  // namespace limber::test

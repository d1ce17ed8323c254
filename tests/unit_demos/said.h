#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
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

// limber: WHERE: WHAT; REMEDY on one line, and nothing on standard output.
inline void expect_refused(const std::vector<std::string>& arguments) {
  SCOPED_TRACE(testing::PrintToString(arguments));
  const Said said = limber(arguments);
  EXPECT_EQ(said.code, 2);
  EXPECT_EQ(said.out, "");
  EXPECT_THAT(said.err, testing::MatchesRegex("limber: [^:\n]+: [^;\n]+; [^\n]+\n"));
}

// Sets PATH for the life of one test.
class PathVariable {
 public:
  explicit PathVariable(const std::string& value) : old_(std::getenv("PATH")) {
    ::setenv("PATH", value.c_str(), 1);
  }
  ~PathVariable() { ::setenv("PATH", old_.c_str(), 1); }
  PathVariable(const PathVariable&) = delete;
  PathVariable& operator=(const PathVariable&) = delete;

 private:
  std::string old_;
};

}  // namespace limber::test

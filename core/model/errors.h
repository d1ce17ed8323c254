#pragma once

#include <stdexcept>
#include <string>

namespace limber {

// "WHERE: WHAT; REMEDY" - the one form of every message a user sees.
struct Diagnostic {
  std::string where;
  std::string what;
  std::string remedy;

  std::string text() const { return where + ": " + what + "; " + remedy; }
};

// Bad authoring or bad usage: the input has to change. Programs exit with 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(Diagnostic d) : std::runtime_error(d.text()), diagnostic(std::move(d)) {}
  Diagnostic diagnostic;
};

// The simulation could not go on (blow-up, overload): a setting has to change. Programs exit
// with 1.
class SimulationError : public std::runtime_error {
 public:
  explicit SimulationError(Diagnostic d) : std::runtime_error(d.text()), diagnostic(std::move(d)) {}
  Diagnostic diagnostic;
};

}  // namespace limber

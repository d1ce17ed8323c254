#pragma once

#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/model/errors.h"

namespace limber {

// "G2 both ends are point ", 4 -> one string; enough digits to find a number again in the input.
template <class... Parts>
std::string say(const Parts&... parts) {
  std::ostringstream out;
  out.precision(9);
  (out << ... << parts);
  return out.str();
}

// Collects what is wrong with one model, until there is enough of it.
class DiagnosticList {
 public:
  DiagnosticList(std::string model_name, std::size_t most)
      : model_name_(std::move(model_name)), most_(most) {}

  bool full() const { return items_.size() >= most_; }

  // `element` as in "point 17".
  void add(const std::string& element, std::string what, std::string remedy) {
    if (full()) return;
    items_.push_back({model_name_ + ": " + element, std::move(what), std::move(remedy)});
  }

  std::vector<Diagnostic> take() { return std::move(items_); }

 private:
  std::string model_name_;
  std::size_t most_;
  std::vector<Diagnostic> items_;
};

}  // namespace limber

#pragma once

#include <locale>
#include <sstream>
#include <string>

namespace limber {

// say() for what people read once: numbers with three significant digits, in every locale.
template <class... Parts>
std::string say_briefly(const Parts&... parts) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(3);
  (out << ... << parts);
  return out.str();
}

inline std::string three_digits(double number) { return say_briefly(number); }

}  // namespace limber

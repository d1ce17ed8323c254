#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace limber::demos {

// A finite number in decimal ("0.0166", "1e-3") or as a fraction ("1/60"), independent of the
// locale. Throws InputError naming `where`.
double parse_number(std::string_view text, const std::string& where);

// A whole number from `least` to `most`.
int parse_whole(std::string_view text, int least, int most, const std::string& where);

// "NAME=VALUE" of --set.
std::pair<std::string, double> parse_assignment(std::string_view text);

}  // namespace limber::demos

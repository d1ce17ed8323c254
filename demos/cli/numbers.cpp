#include "demos/cli/numbers.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>

#include "core/model/errors.h"

namespace limber::demos {
namespace {

// The whole of `text` or nothing.
template <class Number>
std::optional<Number> read(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  Number value{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

std::optional<double> read_ratio(std::string_view text) {
  const auto slash = text.find('/');
  if (slash == std::string_view::npos) return read<double>(text);
  const auto above = read<double>(text.substr(0, slash));
  const auto below = read<double>(text.substr(slash + 1));
  if (!above || !below) return std::nullopt;
  return *above / *below;
}

}  // namespace

double parse_number(std::string_view text, const std::string& where) {
  const std::optional<double> value = read_ratio(text);
  if (value && std::isfinite(*value)) return *value;
  throw InputError({where, fmt::format("'{}' is not a finite number", text),
                    "write it like 0.25, 1e-3 or 1/60"});
}

int parse_whole(std::string_view text, int least, int most, const std::string& where) {
  const std::optional<int> value = read<int>(text);
  if (value && least <= *value && *value <= most) return *value;
  throw InputError({where,
                    fmt::format("'{}' is not a whole number from {} to {}", text, least, most),
                    "give one in that range"});
}

std::pair<std::string, double> parse_assignment(std::string_view text) {
  const auto equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0) {
    throw InputError({"--set", fmt::format("'{}' is not NAME=VALUE", text),
                      "`limber run` lists the parameters of every scene"});
  }
  std::string name(text.substr(0, equals));
  const double value = parse_number(text.substr(equals + 1), "--set " + name);
  return {std::move(name), value};
}

}  // namespace limber::demos

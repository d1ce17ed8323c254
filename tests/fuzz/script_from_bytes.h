#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace limber::demos::fuzz {

// Bytes as a script. The first one chooses: the others are Lua as they stand, or they are read as
// decisions: which functions of the API are called, which fields they get, and with what, from
// values that fit to every wrong kind and range.
std::string script_from_bytes(std::span<const std::uint8_t> bytes);

// A first byte for Lua as it stands.
inline constexpr std::uint8_t kAsItStands = 0;

}  // namespace limber::demos::fuzz

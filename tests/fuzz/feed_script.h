#pragma once

#include <string>

namespace limber::demos::fuzz {

// Runs a script under small limits for two ticks. Whatever it is, it is accepted, or refused by a
// message with a remedy: anything else is a fault, which is returned; empty: none. A crash is one
// too, of course.
std::string fault_of(const std::string& script);

}  // namespace limber::demos::fuzz

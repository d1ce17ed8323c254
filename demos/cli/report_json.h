#pragma once

#include <cstdint>
#include <string>

#include "demos/cli/comparison.h"
#include "demos/scenes/simulation.h"

// The machine interface, field by field as docs/command_line.md lists it. null: not measured.
namespace limber::demos {

std::string run_json(const RunResult& run, Policy policy);
std::string comparison_json(const ComparedRuns& runs, const Comparison& comparison);

std::string hex_hash(std::uint64_t hash);  // 16 digits
const char* name_of(Policy policy);

}  // namespace limber::demos

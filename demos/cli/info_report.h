#pragma once

#include <string>

#include "core/storage/sealed_file.h"
#include "demos/cli/model_facts.h"

namespace limber::demos {

// The facts for people.
std::string info_report(const std::string& file, const Seal& seal, const ModelFacts& facts);

// And for programs.
std::string info_json(const std::string& file, const Seal& seal, const ModelFacts& facts);

// A text from a file, without what would make a terminal do something: control characters become
// question marks.
std::string printable(std::string text);

}  // namespace limber::demos

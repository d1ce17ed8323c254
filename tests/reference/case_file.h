#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/reference/kinds.h"

namespace limber::reference {

// One case of a file. What it expects only the judge may see.
struct CaseRecord {
  std::string id;
  Case input;
  nlohmann::json expected;  // quantity -> {value, how, tol, ...}
};

// The second field of a case's id ("G01.dumbbell.p0" -> "dumbbell"); empty without one.
std::string kind_of(const std::string& case_id);

// Is the quantity a sample time or the like, given and not asked for?
bool is_input(const nlohmann::json& quantity);

// Throws InputError for a file that is missing, is no JSON or does not have the schema.
std::vector<CaseRecord> read_cases(const std::filesystem::path& file);

}  // namespace limber::reference

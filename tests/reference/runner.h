#pragma once

#include "tests/reference/case_file.h"

namespace limber::reference {

// What came of one case: the quantities that could be read off, and what was left out and why.
struct Outcome {
  nlohmann::json quantities;          // name -> value; null when the case was not run
  std::vector<std::string> left_out;  // "quantity: reason", or the reason alone for the whole case
};

// Never throws for what a case or a kind does wrong: that goes into left_out.
Outcome run_case(const CaseRecord& record);

}  // namespace limber::reference

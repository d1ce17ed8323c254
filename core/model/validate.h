#pragma once

#include <vector>

#include "core/model/errors.h"
#include "core/model/physical_model.h"

namespace limber {

// Every violated invariant of docs/invariants.md, in the order of the hierarchy, each naming the
// offending element and the remedy: {"teapot: point 17", "P2 mass is -1 kg", "give it ..."}.
// At most `most` are listed. The geometric form is for authors and asks for positive volumes (G8)
// too; the physical form also takes what the simulator gives back, where cells may be squashed.
std::vector<Diagnostic> validate(const GeometricModel& model, const std::string& name,
                                 std::size_t most = 20);
std::vector<Diagnostic> validate(const PhysicalModel& model, std::size_t most = 20);

// Throws InputError with the first diagnostic, if there is one.
void require_valid(const PhysicalModel& model);

}  // namespace limber

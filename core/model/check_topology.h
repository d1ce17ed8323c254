#pragma once

#include "core/model/diagnostic_list.h"
#include "core/model/geometric_model.h"

namespace limber {

// G1 to G7 and G9 to G11 of docs/invariants.md: what holds in every state of a model. Internal to
// validate().
void check_topology(const GeometricModel& model, DiagnosticList& out);

}  // namespace limber

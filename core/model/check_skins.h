#pragma once

#include "core/model/diagnostic_list.h"
#include "core/model/physical_model.h"

namespace limber {

// S1 to S3 of docs/invariants.md. Internal to validate().
void check_skins(const PhysicalModel& model, DiagnosticList& out);

}  // namespace limber

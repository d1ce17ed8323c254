#pragma once

#include "core/environment/flow_field.h"
#include "tests/reference/json_values.h"

namespace limber::reference {

// The "primitives" of a case. Their cores are a micrometre: too small to be met.
FlowField flow_of(const Json& primitives);

}  // namespace limber::reference

#pragma once

#include "core/model/physical_model.h"

namespace limber::test {

// Fails the test unless both models are the same in every field, to the bit (0.0 is not -0.0).
void expect_same_model(const PhysicalModel& a, const PhysicalModel& b);

// A broken block of two subobjects with skins, textures, values, drag and every attribute away from
// its default: whatever a file could lose is in it.
PhysicalModel rich_model();

}  // namespace limber::test

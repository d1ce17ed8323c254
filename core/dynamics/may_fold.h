#pragma once

#include "core/model/physical_model.h"

namespace limber {

// Can parts of the model turn against each other at next to no strain? Ropes, sheets, solids
// without enough diagonals and cells that hang together by an edge can; what is made of braced
// cells that share faces, or of such parts held by six bonds or more that do not all meet one line,
// cannot. In doubt yes: it knows rigid cells, and what joins two clusters of them, not more.
bool may_fold(const PhysicalModel& model);

}  // namespace limber

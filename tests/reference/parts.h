#pragma once

#include "tests/reference/kinds.h"

namespace limber::reference {

// Parts of a group that have a file of their own.
Kinds statics_kinds();        // group 3: lattices at rest under a load
Kinds flow_kinds();           // group 6: the flow alone
Kinds drop_kinds();           // group 12: a point and a soft ground
Kinds equipartition_kinds();  // group 12: energies of a vibrating lattice

}  // namespace limber::reference

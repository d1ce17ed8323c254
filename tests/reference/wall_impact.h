#pragma once

#include "tests/reference/build.h"
#include "tests/reference/kinds.h"

namespace limber::reference {

// A chain that flies end-on into a wall: the part of group 7 that is one-dimensional.
Json chain_impact(const Case& c);
Json bessel_front(const Case& c);

}  // namespace limber::reference

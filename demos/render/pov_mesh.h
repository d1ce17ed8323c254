#pragma once

#include <string>

#include "demos/scenes/simulation.h"

namespace limber::demos {

// How the state of a triangle shows in a picture:
//   rigid just now              the subobject's own colour, glazed
//   flexible just now           the same drawn towards amber, with its lattice on it
//   exposed by breaking         rough reddish clay, sharp edges; amber-lit where flexible
// One mesh2 and, for the lattice, thin cylinders. Empty for a body without visible triangles.
std::string pov_body(const Snapshot::Body& body);

}  // namespace limber::demos

#pragma once

#include <string>

#include "demos/scenes/simulation.h"

namespace limber::demos {

// How the state of a triangle shows in a picture:
//   rigid just now              the subobject's own colour, glazed
//   flexible just now           the same drawn towards amber, with its lattice on it
//   exposed by breaking         rough reddish clay, sharp edges; amber-lit where flexible
// One mesh2 for all that is opaque and one for each index of refraction of what is transparent;
// thin cylinders for the lattice, thicker ones for ropes, balls for grains. Empty for a body of which nothing is visible. Images (texture) are
// not drawn: a lattice says nothing about where on an image its points lie.
std::string pov_body(const Snapshot::Body& body);

}  // namespace limber::demos

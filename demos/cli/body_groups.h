#pragma once

#include <vector>

#include "demos/scenes/simulation.h"

namespace limber::demos {

// From this many bodies of one kind on they are shown as one row.
inline constexpr std::size_t kLeastBodyGroup = 4;

// For people: bodies whose names differ in their last number only ("leaf 1", "leaf 2") are one
// kind, and many of a kind become one summary in the place of its first: "320 x leaf", with the
// sums of masses, broken edges and fragments, the centre of mass and the velocity of all of them,
// the largest softening, and "318 rigid, 2 flexible".
std::vector<BodySummary> grouped_bodies(const std::vector<BodySummary>& bodies);

}  // namespace limber::demos

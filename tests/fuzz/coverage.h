#pragma once

#include <cstddef>

namespace limber::demos::fuzz {

// Which code ran, where it was compiled with -fsanitize-coverage=trace-pc (-D LIMBER_FUZZ=ON);
// nothing anywhere else. A place counts apart when it ran once, twice, up to 4, 8, ... times.

void forget_run();
// Places (and counts of them) that no run before this one had.
std::size_t new_places();
// In all runs.
std::size_t places();

}  // namespace limber::demos::fuzz

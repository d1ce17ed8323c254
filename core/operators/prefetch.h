#pragma once

namespace limber {

// Starts loading what the address points to. Objects are larger than the caches, so that every line
// a break reads comes from memory: fetching all of a step's lines before reading the first lets
// them come at the same time (measured on a million points: 4.7 us become 2.0 us).
inline void prefetch(const void* address) {
  __builtin_prefetch(address);
  // Otherwise the compiler drops calls of functions that do nothing but prefetch, as without
  // effect.
  asm volatile("");
}

}  // namespace limber

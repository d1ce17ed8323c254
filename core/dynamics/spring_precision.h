#pragma once

namespace limber {

// How the forces of springs are summed. Motion is integrated in double precision either way.
enum class SpringPrecision {
  kDouble,  // one edge after the other: the reference
  kSingle,  // by vector instructions (docs/accuracy.md says what that costs)
};

// The instruction set that kSingle runs on, such as "AVX3" (AVX-512): results are the same to the
// bit on any machine that runs the same one and rounds reciprocals alike, and for any number of
// threads.
const char* vector_instructions();

}  // namespace limber

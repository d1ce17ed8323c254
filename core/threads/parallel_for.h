#pragma once

#include <cstddef>
#include <memory>

namespace limber {

// How many threads the simulation may use, all bodies of the process together; 1 at first. Results
// do not depend on it, to the bit. Not while something is simulated. Throws InputError for less
// than 1.
void set_threads(int count);
int threads();

// A reference to something that can be called with a range [from, to).
class RangeBody {
 public:
  template <class Body>
  RangeBody(const Body& body)  // NOLINT: implicit, for lambdas
      : body_(std::addressof(body)), call_([](const void* b, std::size_t from, std::size_t to) {
          (*static_cast<const Body*>(b))(from, to);
        }) {}
  void operator()(std::size_t from, std::size_t to) const { call_(body_, from, to); }

 private:
  const void* body_;
  void (*call_)(const void*, std::size_t, std::size_t);
};

// Runs body over [0, count), in ranges of `grain` that begin at multiples of it, each once and in
// any order. What is no larger than two grains runs at once and in place: make a grain worth 20
// microseconds, ten times what waking a thread takes. Of what ranges throw the caller gets that of
// the lowest one.
void parallel_for(std::size_t count, std::size_t grain, RangeBody body);

// The same for a few tasks of very different size, each worth 20 microseconds: one by one, to
// whoever is free.
void parallel_tasks(std::size_t count, RangeBody body);

}  // namespace limber

#include "tests/reference/edge_recorder.h"

#include <cmath>

namespace limber::reference {
namespace {

Reading stretch_reading(const Run& run, std::size_t edge) {
  return {run.time(), stretch(run.lattice(), edge), stretch_rate(run.lattice(), edge)};
}

}  // namespace

EdgeRecorder::EdgeRecorder(const Run& run) : peaks_(run.lattice().springs.size()) { read(run); }

void EdgeRecorder::read(const Run& run) {
  for (std::size_t e = 0; e < peaks_.size(); ++e) peaks_[e].read(stretch_reading(run, e));
}

std::size_t EdgeRecorder::farthest() const {
  constexpr double kTie = 1e-9;
  std::size_t best = 0;
  for (std::size_t e = 1; e < peaks_.size(); ++e) {
    if (distance(e) > (1.0 + kTie) * distance(best)) best = e;
  }
  return best;
}

double EdgeRecorder::distance(std::size_t edge) const {
  return std::abs(peaks_[edge].farthest().value);
}

std::vector<Reading> first_extrema(Run& run, const std::vector<std::size_t>& edges, double dt,
                                   double least) {
  std::vector<Reading> last, found(edges.size());
  for (std::size_t e : edges) last.push_back(stretch_reading(run, e));
  for (std::size_t missing = edges.size(); missing > 0;) {
    run.step(dt);
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Reading now = stretch_reading(run, edges[i]);
      const auto extremum = extremum_between(last[i], now);
      last[i] = now;
      if (!extremum || std::abs(extremum->value) < least || found[i].time > 0.0) continue;
      found[i] = *extremum;
      --missing;
    }
  }
  return found;
}

}  // namespace limber::reference

#pragma once

#include <cstdint>
#include <vector>

#include "core/dynamics/edge_kernel.h"
#include "core/dynamics/lattice.h"
#include "core/dynamics/quanta.h"

namespace limber {

// Springs between any points, in columns for vector instructions: the general path of
// spring_forces.h in single precision. Like stencil_springs.h it copies the motion of its points
// anew for every sum of forces.
class EdgeSprings {
 public:
  // Takes these active springs of the lattice, in this order. What single precision cannot hold, an
  // object at a time, is left out: has() says what it took.
  void rebuild(const Lattice& lattice, const std::vector<std::int32_t>& active);

  bool has(std::int32_t edge) const { return column_of_[edge] >= 0; }
  std::size_t size() const { return edge_.size(); }

  void require_measurable(const Lattice& lattice) const;

  // The edge broke. Does nothing for edges it does not have.
  void remove(std::int32_t edge);

  // Adds to lattice.force; appends edges that passed a threshold, by the lattice's own double
  // precision. The same bits on any number of threads.
  // Throws SimulationError for a spring too long for single precision, where dt (s) is the step
  // since the last time.
  void add_forces(Lattice& lattice, double dt, std::vector<std::int32_t>& overstretched_edges);

 private:
  // Of one object's springs.
  struct Frame {
    Quanta quanta;
    bool holds = false;              // in single precision
    std::int32_t origin_point = -1;  // a dynamic one
    PointMotion origin;
  };

  void find_frames(const Lattice& lattice, const std::vector<std::int32_t>& active);
  void append(const Spring& spring, std::int32_t edge, const Quanta& quanta);
  void pad();
  void list_points(const Lattice& lattice);
  void list_pulls_of_points(const Lattice& lattice);
  void read_motion(const Lattice& lattice);
  const Quanta& quanta_of(const Lattice& lattice, std::int32_t edge) const;
  void pull_all();
  void gather_pulls(std::size_t from, std::size_t to);
  EdgeColumns columns() const;

  std::vector<Frame> frames_;            // shape (objects)
  std::vector<std::int32_t> column_of_;  // shape (E), or -1
  std::vector<std::int32_t> edge_;       // shape (columns): of the lattice

  // Shape (columns), padded to whole batches
  std::vector<std::int32_t> a_, b_;
  std::vector<float> stiffness_, damping_, rest_length_, longest_, shortest_;
  std::vector<float> pulls_;
  std::vector<std::uint64_t> flags_;  // shape (batches)

  std::vector<std::int32_t> points_;  // of the lattice: ends of springs, ascending
  std::vector<std::int32_t> packed_;  // shape (P): place in points_
  std::vector<PackedMotion> motion_;  // shape (points_)
  std::vector<PackedForce> force_;    // shape (points_)
  std::vector<double> fastest_;       // quanta/s, of each range of a parallel loop
  IndexRows pulls_of_;                // packed point -> columns; ~column where it is the second end
};

}  // namespace limber

// What an object pays for what it needs: the same 16 x 16 x 16 points and their springs, with each
// feature added to the one before. Counters: memory and time of a substep, per point.

#include <benchmark/benchmark.h>

#include "core/dynamics/memory_use.h"
#include "core/modeller/cubic_lattice.h"
#include "core/operators/time_operator.h"

namespace limber {
namespace {

struct Features {
  bool cells = false;
  bool breaking = false;
  bool point_contact = false;
  bool air = false;
  bool internal_damping = false;
};

// Points and edges alone: what a rope is made of.
GeometricModel without_cells(const GeometricModel& from) {
  GeometricModelBuilder builder;
  builder.begin_subobject("block");
  for (const Vec3& point : from.points) builder.add_point(point);
  for (const Edge& edge : from.edges) builder.edge(edge.a, edge.b);
  return builder.finish();
}

PhysicalModel block(const Features& features) {
  PhysicalModel model = cubic_lattice({.points = {16, 16, 16},
                                       .spacing = 0.01,
                                       .springs = {.axial = 1e3, .face_diagonal = 1e3},
                                       .mass = 1e-3,
                                       .damping_per_stiffness = 1e-5});
  if (!features.cells) {
    PhysicalModel bare = with_default_attributes(without_cells(model.geometry), "block");
    bare.points = model.points;
    bare.edges = model.edges;
    model = std::move(bare);
  }
  if (features.breaking) {
    for (EdgeAttributes& edge : model.edges) edge.break_threshold = 1e-3;
  }
  if (features.air) {
    for (FaceAttributes& face : model.faces) face.normal_drag = 1.0;
  }
  model.object.contact_share = features.point_contact ? 0.45 : 0.0;
  model.object.internal_damping = features.internal_damping ? 1.0 : 0.0;
  return model;
}

void substep(benchmark::State& state, const Features& features) {
  constexpr int kSubsteps = 64;
  Lattice lattice;
  add_object(lattice, block(features));
  rebuild_active(lattice);
  TimeOperator time(lattice);
  Environment environment{.gravity = {0.0, -9.81, 0.0}};
  if (features.air) environment.air.emplace();
  const double dt = 1e-6;  // so that it stays in one piece however long this takes
  for (auto _ : state) time.advance(kSubsteps, dt, environment);
  const auto points = static_cast<double>(lattice.motion.size());
  const MemoryUse memory = memory_use(lattice);
  state.counters["simulated_bytes_per_point"] =
      static_cast<double>(memory.total() - memory.authored) / points;
  state.counters["authored_bytes_per_point"] = static_cast<double>(memory.authored) / points;
  state.counters["time_per_point_and_substep"] =
      benchmark::Counter(points * kSubsteps, benchmark::Counter::kIsIterationInvariantRate |
                                                 benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(substep, 1_springs, Features{})->Name("features/1_springs_alone");
BENCHMARK_CAPTURE(substep, 2_breaking, Features{.breaking = true})->Name("features/2_and_breaking");
BENCHMARK_CAPTURE(substep, 3_cells, (Features{.cells = true, .breaking = true}))
    ->Name("features/3_and_cells");
BENCHMARK_CAPTURE(substep, 4_contact,
                  (Features{.cells = true, .breaking = true, .point_contact = true}))
    ->Name("features/4_and_point_contact");
BENCHMARK_CAPTURE(substep, 5_air,
                  (Features{.cells = true, .breaking = true, .point_contact = true, .air = true}))
    ->Name("features/5_and_air");
BENCHMARK_CAPTURE(substep, 6_damping, (Features{true, true, true, true, true}))
    ->Name("features/6_and_internal_damping");

}  // namespace
}  // namespace limber

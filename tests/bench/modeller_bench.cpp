#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <filesystem>

#include "core/model/validate.h"
#include "core/modeller/box_lattice.h"
#include "core/modeller/material.h"
#include "core/storage/model_file.h"

// What it takes to make a model: `modeller/box/N` for N x N x N points. Peak memory is that of the
// process so far: run one size at a time (--benchmark_filter=modeller/box/100).

namespace limber {
namespace {

using Clock = std::chrono::steady_clock;

class Stopwatch {
 public:
  double lap() {  // s
    const Clock::time_point now = Clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  Clock::time_point last_ = Clock::now();
};

double peak_memory_GB() {
  rusage use{};
  getrusage(RUSAGE_SELF, &use);
  return 1024.0 * static_cast<double>(use.ru_maxrss) / 1e9;
}

Material clay() {
  return {
      .density = 2000.0, .youngs_modulus = 1.5e7, .strain_at_break = 0.01, .damping_ratio = 0.2};
}

void model_write_and_read(benchmark::State& state) {
  const int cells = static_cast<int>(state.range(0)) - 1;
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / "limber_modeller_bench.limber";
  for (auto _ : state) {
    Stopwatch watch;
    {
      GeometricModel box =
          box_lattice({cells, cells, cells}, Vec3::Constant(0.01), Vec3::Zero(), "box");
      state.counters["shape_s"] = watch.lap();
      const PhysicalModel model = with_material(std::move(box), "box", clay());
      state.counters["material_s"] = watch.lap();
      if (!validate(model).empty()) state.SkipWithError("the model is not valid");
      state.counters["validate_s"] = watch.lap();
      write_model(model, file);
      state.counters["write_s"] = watch.lap();
    }
    watch.lap();
    const PhysicalModel model = read_model(file);
    state.counters["read_s"] = watch.lap();
    state.counters["points"] = static_cast<double>(model.points.size());
    state.counters["file_GB"] = static_cast<double>(std::filesystem::file_size(file)) / 1e9;
  }
  state.counters["peak_GB"] = peak_memory_GB();
  std::filesystem::remove(file);
}

BENCHMARK(model_write_and_read)
    ->Name("modeller/box")
    ->Arg(10)
    ->Arg(30)
    ->Arg(100)
    ->Iterations(1)
    ->Unit(benchmark::kSecond);

}  // namespace
}  // namespace limber

#include "demos/render/gnuplot.h"

#include <fmt/format.h>

#include <fstream>

#include "core/model/errors.h"
#include "demos/render/child_process.h"

namespace limber::demos {
namespace {

constexpr Program kGnuplot = {"gnuplot", "gnuplot", "gnuplot-nox"};
constexpr const char* kScript = "plot.gp";
constexpr const char* kPlot = "plot.out";

// -d: without the user's own settings, so that the plot is the same for everybody.
std::string draw(const std::string& terminal, const Plot& plot) {
  const ScratchFolder folder;
  std::ofstream(folder.path() / kScript, std::ios::binary)
      << fmt::format("set terminal {}\nset output '{}'\n", terminal, kPlot) << plot.script;
  run_program(kGnuplot, {"-d", kScript}, folder.path());
  std::string image = bytes_of(folder.path() / kPlot);
  if (!image.empty()) return image;
  throw SimulationError(
      {kGnuplot.name, "wrote no picture", "check that it is a whole installation"});
}

}  // namespace

void require_gnuplot() {
  const ScratchFolder folder;
  run_program(kGnuplot, {"--version"}, folder.path());
}

std::string plot_png(const Plot& plot) {
  return draw(fmt::format("pngcairo enhanced size {},{} font 'Sans,11'", plot.width, plot.height),
              plot);
}

std::string plot_svg(const Plot& plot) {
  return draw(fmt::format("svg enhanced size {},{} font 'sans-serif,14'", plot.width, plot.height),
              plot);
}

}  // namespace limber::demos

#pragma once

#include <string>
#include <vector>

#include "core/analysis/stability_atlas.h"
#include "demos/render/gnuplot.h"

// The pictures of docs/stability.md.
namespace limber::demos {

struct NamedPlot {
  std::string name;  // of the files, without .png or .svg
  Plot plot;
};

std::vector<NamedPlot> stability_plots(const StabilityAtlas& atlas);

}  // namespace limber::demos

#pragma once

#include <string>

// Plots by gnuplot, as a separate process.
namespace limber::demos {

// Throws InputError with the way to install it where gnuplot cannot be started.
void require_gnuplot();

// A drawing in gnuplot's language, without terminal and output, which are added here.
struct Plot {
  std::string script;
  int width = 900, height = 600;  // pixels
};

// The bytes of the PNG or SVG file: the same every time. Throws SimulationError with the last lines
// that gnuplot said where it fails.
std::string plot_png(const Plot& plot);
std::string plot_svg(const Plot& plot);

}  // namespace limber::demos

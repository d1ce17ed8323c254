#include "demos/cli/stability_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

namespace limber::demos {
namespace {

// Told apart by every kind of eye (Okabe and Ito, Color Universal Design, 2008).
constexpr std::array kColours = {"#0072B2", "#56B4E9", "#D55E00", "#009E73", "#CC79A7", "#E69F00"};
constexpr std::array kSymbols = {7, 6, 9, 5, 13, 11};

std::size_t style(std::size_t scheme) { return scheme % kColours.size(); }

constexpr const char* kLook =
    "set encoding utf8\nset grid lt 1 lw 0.5 lc rgb '#e0e0e0'\nset border lc rgb '#606060'\n"
    "set tics textcolor rgb 'black'\nset key noautotitle samplen 2\n";
constexpr const char* kPowersOfTen = "'10^{%L}'";

// gnuplot leaves out what is no number.
std::string number(double x) { return std::isfinite(x) ? fmt::format("{:.9g}", x) : "NaN"; }

// The block of data `name` + the scheme's number: a row for each item of it.
template <class Item, class Row>
std::string data_blocks(const char* name, const std::vector<Item>& items, Row row) {
  std::string text;
  for (std::size_t s = 0; s < schemes().size(); ++s) {
    text += fmt::format("${}{} << END\n", name, s);
    for (const Item& item : items) {
      if (is_of(item.scheme, schemes()[s])) text += row(item) + "\n";
    }
    text += "END\n";
  }
  return text;
}

// "plot A, B, ...": one entry a scheme by `entry`, and others.
template <class Entry>
std::string plot_of(Entry entry, const std::string& others = {}) {
  std::string text;
  for (std::size_t s = 0; s < schemes().size(); ++s) {
    const std::string one = entry(s, schemes()[s]);
    if (!one.empty()) text += (text.empty() ? "plot " : ", \\\n  ") + one;
  }
  return text + (others.empty() ? "" : ", \\\n  " + others) + "\n";
}

std::string points_of(std::size_t s, const char* data, const char* columns, const char* title) {
  return fmt::format("${}{} using {} with points pt {} ps 0.8 lc rgb '{}' title '{}'", data, s,
                     columns, kSymbols[style(s)], kColours[style(s)], title);
}

std::string line_of(std::size_t s, const char* data, const char* columns, const char* title) {
  // Single precision lies on top of double.
  const int dash = schemes()[s].precision == SpringPrecision::kSingle ? 2 : 1;
  return fmt::format("${}{} using {} with lines lw 2 dt {} lc rgb '{}' title '{}'", data, s,
                     columns, dash, kColours[style(s)], title);
}

bool has_limit(const Scheme& scheme) { return std::isfinite(scheme.step_limit(1.0, 1.0)); }

// The analytic line of what single precision shares with double is there already.
bool is_first_of_limit(std::size_t s) {
  const auto all = schemes().first(s);
  return std::ranges::none_of(
      all, [&](const Scheme& other) { return other.step_limit == schemes()[s].step_limit; });
}

Plot damping_plot(const StabilityAtlas& atlas) {
  std::string text = data_blocks("d", atlas.damping, [](const LimitSample& l) {
    return fmt::format("{:.9g} {} {}", l.at, number(l.analytic), number(l.measured));
  });
  text += kLook;
  text +=
      "set multiplot title 'Largest stable step of a damped oscillator'\n"
      "set logscale xy\nset xrange [0.009:110]\nset format x '%g'\nset format y '%g'\n"
      "set lmargin 12\nset size 1,0.64\nset origin 0,0.31\n"
      "set ylabel 'ω × step'\nset yrange [0.003:10]\n"
      "set key inside bottom center title 'lines: analytic; points: measured'\n";
  text += plot_of([](std::size_t s, const Scheme& scheme) {
    if (!has_limit(scheme)) return std::string();
    const std::string points = points_of(s, "d", "1:3", scheme.name);
    return is_first_of_limit(s) ? line_of(s, "d", "1:2", "") + ", \\\n  " + points : points;
  });
  text +=
      "unset logscale y\nset size 1,0.32\nset origin 0,0\nset yrange [0.995:1.005]\n"
      "set ytics 0.002\nset xlabel 'damping ratio'\nset ylabel 'measured / analytic'\nunset key\n";
  text += plot_of([](std::size_t s, const Scheme& scheme) {
    return has_limit(scheme) ? points_of(s, "d", "1:($3/$2)", scheme.name) : "";
  });
  return {text + "unset multiplot\n", 900, 800};
}

bool is_on_map(const StabilityResult& result) {
  return std::strcmp(result.tried.sweep, kMapSweep) == 0;
}

std::string map_rows(const StabilityAtlas& atlas, std::size_t s, StabilityOutcome outcome) {
  std::string rows = fmt::format("$m{}{} << END\n", s, name_of(outcome));
  for (const StabilityResult& r : atlas.cases) {
    if (!is_on_map(r) || r.outcome != outcome || !is_of(r.tried.scheme, schemes()[s])) continue;
    rows += fmt::format("{:.9g} {:.9g}\n", r.tried.stiffness, r.tried.step);
  }
  return rows + "END\n";
}

std::string limit_rows(const StabilityAtlas& atlas, std::size_t s) {
  std::string rows = fmt::format("$limit{} << END\n", s);
  for (const StabilityResult& r : atlas.cases) {
    if (!is_on_map(r) || !is_of(r.tried.scheme, schemes()[s])) continue;
    rows += fmt::format("{:.9g} {}\n", r.tried.stiffness, number(r.limit));
  }
  return rows + "END\n";
}

constexpr std::array kMapColours = {std::pair{StabilityOutcome::kStable, "#009E73"},
                                    std::pair{StabilityOutcome::kGrew, "#E69F00"},
                                    std::pair{StabilityOutcome::kStopped, "#D55E00"},
                                    std::pair{StabilityOutcome::kRefused, "#909090"}};

// One for all panels.
std::string map_legend() {
  std::string entries;
  for (const auto& [outcome, colour] : kMapColours) {
    entries += fmt::format("keyentry with points pt 5 ps 1.5 lc rgb '{}' title '{}', \\\n  ",
                           colour, name_of(outcome));
  }
  return entries + "keyentry with lines lw 3 lc rgb 'black' title 'analytic limit', \\\n  ";
}

std::string map_panel(const StabilityAtlas& atlas, std::size_t s) {
  std::string data, entries = s == 0 ? map_legend() : "";
  for (const auto& [outcome, colour] : kMapColours) {
    data += map_rows(atlas, s, outcome);
    entries += fmt::format("$m{}{} using 1:2 with points pt 5 ps pointscale lc rgb '{}', \\\n  ", s,
                           name_of(outcome), colour);
  }
  return data + limit_rows(atlas, s) +
         fmt::format("set title '{}'\nplot {}$limit{} using 1:2 with lines lw 3 lc rgb 'black'\n",
                     schemes()[s].name, entries, s);
}

Plot map_plot(const StabilityAtlas& atlas) {
  const std::size_t rows = (schemes().size() + 1) / 2;
  const int height = static_cast<int>(400 * rows) + 120;
  const auto on_map = std::ranges::count_if(atlas.cases, is_on_map);
  const bool coarse = on_map / static_cast<std::ptrdiff_t>(schemes().size()) < 200;
  std::string text = kLook;
  text += fmt::format(
      "pointscale = {}\nset multiplot layout {},2 margins 0.08,0.98,{:.4f},{:.4f} spacing "
      "0.1,{:.4f} title 'A block of 4 × 4 × 4 points of 1 kg, damping ratio {}: what steps do'\n"
      "set logscale xy\nset xrange [5e-3:2e12]\nset yrange [7e-6:0.15]\nset format xy {}\n"
      "set xtics 1e-2,100\nset xlabel 'stiffness of a spring, N/m'\nset ylabel 'step, s'\n"
      "set key at screen 0.5,{:.4f} center horizontal maxrows 1\n",
      coarse ? 2.6 : 1.5, rows, 115.0 / height, 1.0 - 75.0 / height, 100.0 / height,
      kMapDampingRatio, kPowersOfTen, 30.0 / height);
  for (std::size_t s = 0; s < schemes().size(); ++s) text += map_panel(atlas, s);
  return {text + "unset multiplot\n", 1100, height};
}

Plot mass_ratio_plot(const StabilityAtlas& atlas) {
  std::string text = data_blocks("r", atlas.mass_ratio, [](const LimitSample& l) {
    return fmt::format("{:.9g} {}", l.at, number(l.measured / l.analytic));
  });
  text += kLook;
  text += fmt::format("set format x {}\n", kPowersOfTen);
  text +=
      "set title 'Largest stable step of a chain of 8 points, every second one heavier or lighter, "
      "damping ratio 1'\n"
      "set logscale x\nset xrange [5e-7:2e6]\nset yrange [0.8:1.05]\nset xtics 1e-6,100\n"
      "set xlabel 'mass ratio between neighbours'\n"
      "set ylabel 'largest stable step / analytic limit'\n"
      "set key bottom center\n";
  text += plot_of(
      [](std::size_t s, const Scheme& scheme) {
        return has_limit(scheme) ? points_of(s, "r", "1:2", scheme.name) : "";
      },
      fmt::format("1 with lines lw 2 lc rgb 'black' title 'analytic limit', {} with lines lw 2 "
                  "dt 2 lc rgb '#808080' title 'below: nothing may stop'",
                  kSafeShare));
  return {text, 900, 560};
}

Plot accuracy_plot(const StabilityAtlas& atlas) {
  std::string text = data_blocks("f", atlas.frequency, [](const FrequencySample& f) {
    // Beyond the limit there is no frequency; explicit Euler is beyond it with every step.
    const double limit = f.scheme.step_limit(1.0, 0.0);
    const bool lost = limit > 0.0 && f.omega_step > limit;
    return fmt::format("{:.9g} {} {}", f.omega_step,
                       lost ? "NaN" : number(std::abs(f.frequency_error)), number(f.factor));
  });
  text += kLook;
  text += fmt::format(
      "set multiplot layout 1,2 title 'An undamped oscillator: what a step costs in accuracy'\n"
      "set logscale xy\nset xrange [0.01:4]\nset format x '%g'\nset xlabel 'ω × step'\n"
      "set format y {}\nset yrange [1e-8:1]\nset ylabel 'error of the frequency, relative'\n"
      "set key inside bottom right\n",
      kPowersOfTen);
  text += plot_of(
      [](std::size_t s, const Scheme& scheme) { return line_of(s, "f", "1:2", scheme.name); });
  text +=
      "unset key\nunset logscale y\nset format y '%g'\nset yrange [0:2]\nset ytics 0.25\n"
      "set ylabel 'amplitude after one step / before'\n";
  text += plot_of(
      [](std::size_t s, const Scheme& scheme) { return line_of(s, "f", "1:3", scheme.name); });
  return {text + "unset multiplot\n", 1100, 560};
}

}  // namespace

std::vector<NamedPlot> stability_plots(const StabilityAtlas& atlas) {
  return {{"stability_damping", damping_plot(atlas)},
          {"stability_map", map_plot(atlas)},
          {"stability_mass_ratio", mass_ratio_plot(atlas)},
          {"stability_accuracy", accuracy_plot(atlas)}};
}

}  // namespace limber::demos

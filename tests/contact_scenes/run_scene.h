#pragma once

#include <string>
#include <vector>

#include "tests/contact_scenes/scene.h"

namespace limber::bullet::test {

enum class Engine { kLimber, kBulletSoft };

// What was found of a demand or of a limit.
struct Finding {
  std::string what;
  double value = 0.0;
  double most = 0.0;

  bool met() const { return value <= most; }  // not by what is not a number
};

struct Measured {
  double penetration = 0.0;       // m
  double energy_start = 0.0;      // J
  double energy_rise = 0.0;       // J, above the start
  double energy_climb = 0.0;      // J, above the least before; bounces have some: contact stores it
  double rest_speed = 0.0;        // m/s
  double momentum_error = 0.0;    // share
  double angular_error = 0.0;     // share
  double ms_per_frame = 0.0;      // of 1/60 s; for reports only
  double seconds = 0.0;           // simulated
  std::string failure;            // why it stopped before the end; empty: it did not
  std::vector<Finding> findings;  // all that the scene demands

  std::vector<Finding> unmet() const;
  bool good() const { return failure.empty() && unmet().empty(); }
  std::string verdict() const;  // "ok", or what is not
};

// Runs the scene in ticks of this length, s, of which a whole number is a frame of 1/60 s or a
// whole number of frames is one.
Measured run_scene(const Scene& scene, Engine engine, double tick = kFrame);

}  // namespace limber::bullet::test

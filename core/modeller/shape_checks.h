#pragma once

#include <string>

#include "core/model/vec3.h"

namespace limber {

// Internal to the geometric modellers: refuse senseless numbers with one message. All throw
// InputError that begins with `where`, the name of the shape.

// The most points that a shape may get: a model of that size takes tens of gigabytes.
inline constexpr double kMostShapePoints = 2e7;

// "radius" is -1 m; give a finite value above 0.
void require_positive(const std::string& where, const std::string& quantity, double value,
                      const std::string& unit);

// There are 0 "cells around".
void require_at_least(const std::string& where, const std::string& what, int count, int least);

// `count` is an estimate, in double because a wrong spacing may ask for more than integers hold.
void require_affordable(const std::string& where, double count, const std::string& remedy);

void require_finite(const std::string& where, const std::string& what, const Vec3& value_m);

}  // namespace limber

#pragma once

#include <string>

#include "core/model/vec3.h"

// Numbers as POV-Ray reads them, in every locale.
namespace limber::demos {

// Throws SimulationError for what is not finite: POV-Ray would stop at "nan" with a syntax error.
std::string pov(double number);
std::string pov(const Vec3& v);              // <x,y,z>
std::string pov_colour(const Vec3& linear);  // rgb <r,g,b>, each kept within 0..1

}  // namespace limber::demos

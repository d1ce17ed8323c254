#pragma once

#include "core/environment/flow_field.h"

namespace limber {

// One step of dt (s) of a massless particle that drifts with the air, x' = v(x, t): smoke, or the
// line it draws. By the classical Runge-Kutta method (Kutta 1901): the error of one step is of
// fifth order in dt |grad v|. `at` in m, `time` in s; returns where it is at time + dt.
Vec3 drifted(const FlowField& field, const Vec3& at, double time, double dt);

}  // namespace limber

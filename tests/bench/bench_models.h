#pragma once

#include "core/model/physical_model.h"

namespace limber::bench {

// A fired brick with 26 neighbours a point: cubic cells, `points` along every edge of `side_m`, its
// lowest corner at `corner_m`. Damped and breakable, softened a thousand times.
PhysicalModel brick(int points, double side_m, const Vec3& corner_m);

// The same, narrower towards its top by a third: its proxy is a hull and no box.
PhysicalModel tapered_brick(int points, double side_m, const Vec3& corner_m);

}  // namespace limber::bench

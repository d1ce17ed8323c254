#include "core/modeller/rope.h"

#include <algorithm>
#include <cmath>

#include "core/model/diagnostic_list.h"
#include "core/model/errors.h"
#include "core/modeller/arc_length.h"
#include "core/modeller/shape_checks.h"

namespace limber {
namespace {

constexpr int kLeastSamples = 1024;  // of a curve, for its length
constexpr int kSamplesPerSegment = 16;

void require_usable(std::span<const Vec3> points, std::size_t least, const std::string& name) {
  if (points.size() < least) {
    throw InputError(
        {name, say("it has ", points.size(), " points"), say("give at least ", least)});
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    require_finite(name, say("point ", i), points[i]);
    if (i == 0 || points[i] != points[i - 1]) continue;
    throw InputError({name, say("points ", i - 1, " and ", i, " are in the same place"),
                      "leave one of them out"});
  }
}

ArcLength arc_of(const Curve& curve, int samples) {
  const std::vector<double> t = evenly(0.0, 1.0, samples);
  ArcLength arc(t);
  Vec3 previous = curve(t[0]);
  for (std::size_t i = 1; i < t.size(); ++i) {
    const Vec3 next = curve(t[i]);
    require_finite("curve", say("its point at ", t[i]), next);
    arc.append((next - previous).norm());
    previous = next;
  }
  return arc;
}

}  // namespace

Curve polyline(std::vector<Vec3> points_m) {
  require_usable(points_m, 2, "polyline");
  const std::size_t steps = points_m.size() - 1;
  std::vector<double> t;
  for (std::size_t i = 0; i <= steps; ++i) t.push_back(static_cast<double>(i));
  ArcLength arc(std::move(t));
  for (std::size_t i = 0; i < steps; ++i) arc.append((points_m[i + 1] - points_m[i]).norm());
  return [points = std::move(points_m), arc, steps](double along) -> Vec3 {
    const double at = arc.parameter_at(along * arc.total());
    const std::size_t i = std::min(steps - 1, static_cast<std::size_t>(std::max(0.0, at)));
    return points[i] + (at - static_cast<double>(i)) * (points[i + 1] - points[i]);
  };
}

double curve_length(const Curve& curve) { return arc_of(curve, 16 * kLeastSamples).total(); }

std::vector<Vec3> points_along(const Curve& curve, int segments) {
  require_at_least("curve", "segments", segments, 1);
  require_affordable("curve", segments, "give fewer segments");
  const ArcLength arc = arc_of(curve, std::max(kLeastSamples, kSamplesPerSegment * segments));
  require_positive("curve", "length", arc.total(), "m");
  std::vector<Vec3> points;
  for (int i = 0; i <= segments; ++i) {
    points.push_back(curve(arc.parameter_at(arc.total() * i / segments)));
  }
  return points;
}

int segments_of(const Curve& curve, double spacing_m) {
  require_positive("curve", "spacing", spacing_m, "m");
  const double segments = curve_length(curve) / spacing_m;
  require_affordable("curve", segments, "give a larger spacing");
  return std::max(1, static_cast<int>(std::lround(segments)));
}

GeometricModel rope(std::span<const Vec3> points_m, const std::string& name, RopeEnds ends) {
  const bool ring = ends == RopeEnds::kJoined;
  require_usable(points_m, ring ? 3 : 2, name);
  GeometricModelBuilder builder;
  builder.begin_subobject(name);
  PointId previous;
  for (const Vec3& p : points_m) {
    const PointId next = builder.add_point(p);
    if (previous.valid()) builder.edge(previous, next);
    previous = next;
  }
  if (ring) {
    if (points_m.front() == points_m.back()) {
      throw InputError({name, "the first and the last point of the ring are in the same place",
                        "leave one of them out"});
    }
    builder.edge(previous, PointId(std::size_t{0}));
  }
  return builder.finish();
}

}  // namespace limber

#include "core/modeller/flaws.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/model/errors.h"

namespace limber {
namespace {

// SplitMix64 (Steele, Lea and Flood 2014): the standard library's distributions give different
// numbers on different platforms, this gives the same everywhere.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

// What a number is drawn for: streams with one seed share nothing.
enum class Stream : std::uint64_t { radius = 1, angle = 2, site = 3 };

std::uint64_t hash(std::uint64_t seed, Stream stream, std::uint64_t index) {
  return mixed(mixed(mixed(seed) ^ static_cast<std::uint64_t>(stream)) ^ index);
}

// In (0, 1): 53 bits and half a step, so that its logarithm is finite.
double uniform(std::uint64_t seed, Stream stream, std::uint64_t index) {
  return (static_cast<double>(hash(seed, stream, index) >> 11) + 0.5) * 0x1.0p-53;
}

// Standard normal number of one edge, after Box and Muller (1958), clipped at 3 sigma: a threshold
// stays positive up to a scatter of 1/3.
double clipped_normal(std::uint64_t seed, std::uint64_t index) {
  const double radius = std::sqrt(-2.0 * std::log(uniform(seed, Stream::radius, index)));
  const double angle = 2.0 * std::numbers::pi * uniform(seed, Stream::angle, index);
  return std::clamp(radius * std::cos(angle), -3.0, 3.0);
}

void require_range(bool good, const std::string& name, const std::string& what,
                   const std::string& remedy) {
  if (!good) throw InputError({name + ": flaws", what, remedy});
}

void check(const Flaws& flaws, const std::string& name, std::size_t points) {
  require_range(flaws.scatter >= 0.0 && flaws.scatter < 1.0 / 3.0, name,
                "scatter is " + std::to_string(flaws.scatter),
                "give 0 to below 1/3: 3 sigma must leave some strength");
  require_range(flaws.seams >= 0 && std::size_t(flaws.seams) <= points, name,
                std::to_string(flaws.seams) + " seams on " + std::to_string(points) + " points",
                "give 0 to the number of points");
  require_range(flaws.seam_strength > 0.0 && std::isfinite(flaws.seam_strength), name,
                "seam strength is " + std::to_string(flaws.seam_strength),
                "give a positive factor");
}

// Lowers each point's squared distance to the nearest site and remembers which site that is.
void claim_points(const GeometricModel& model, std::int32_t site, const Vec3& position,
                  std::vector<double>& squared_distance, IdVector<PointId, std::int32_t>& region) {
  for (PointId p : ids_of(model.points)) {
    const double d = (model.points[p] - position).squaredNorm();
    if (d >= squared_distance[p.index()]) continue;
    squared_distance[p.index()] = d;
    region[p] = site;
  }
}

}  // namespace

// Sites by best-candidate sampling (Mitchell 1991): of some random points, more for each further
// site, the one farthest from the sites so far. Well spread without being regular.
IdVector<PointId, std::int32_t> voronoi_regions(const GeometricModel& model, int sites,
                                                std::uint64_t seed) {
  constexpr std::uint64_t kCandidatesPerSite = 4;
  const std::size_t n = model.points.size();
  IdVector<PointId, std::int32_t> region(n, 0);
  std::vector<double> squared_distance(n, kUnbreakable);
  std::uint64_t draw = 0;
  for (std::int32_t site = 0; site < sites; ++site) {
    std::size_t best = hash(seed, Stream::site, draw++) % n;
    for (std::uint64_t i = 0; i < kCandidatesPerSite * std::uint64_t(site); ++i) {
      const std::size_t candidate = hash(seed, Stream::site, draw++) % n;
      if (squared_distance[candidate] > squared_distance[best]) best = candidate;
    }
    claim_points(model, site, model.points[PointId(best)], squared_distance, region);
  }
  return region;
}

void add_flaws(PhysicalModel& model, const Flaws& flaws) {
  check(flaws, model.name, model.points.size());
  const auto region = voronoi_regions(model.geometry, flaws.seams, flaws.seed);
  for (EdgeId e : ids_of(model.edges)) {
    const auto [a, b] = model.geometry.edges[e];
    double factor = 1.0 + flaws.scatter * clipped_normal(flaws.seed, e.index());
    if (region[a] != region[b]) factor *= flaws.seam_strength;
    model.edges[e].break_threshold *= factor;
  }
}

}  // namespace limber

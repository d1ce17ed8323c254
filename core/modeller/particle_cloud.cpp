#include "core/modeller/particle_cloud.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/model/diagnostic_list.h"
#include "core/model/errors.h"
#include "core/model/random.h"
#include "core/modeller/shape_checks.h"

namespace limber {
namespace {

constexpr const char* kWhere = "particle cloud";

void require_usable(const Box3& box, const std::string& what, double distance_m) {
  require_finite(kWhere, "a corner of the box", box.min());
  require_finite(kWhere, "a corner of the box", box.max());
  require_positive(kWhere, what, distance_m, "m");
  if (!((box.sizes().array() > 0.0).all())) {
    throw InputError(
        {kWhere, "the box is empty", "give the lowest corner first, then the highest"});
  }
  const auto count = (box.sizes() / distance_m).cwiseMax(1.0).prod();  // thin boxes: one across
  require_affordable(kWhere, count, "give a larger " + what);
}

Box3 box_around(const Vec3& centre_m, double radius_m) {
  require_positive(kWhere, "radius", radius_m, "m");
  return {centre_m - Vec3::Constant(radius_m), centre_m + Vec3::Constant(radius_m)};
}

// Whole spacings that fit into a length; one that misses by rounding fits.
int fitting(double length, double spacing) {
  return static_cast<int>(std::floor(length / spacing * (1.0 + 1e-12)));
}

// low + (0, 1, ..., n - 1) spacing along each axis.
std::vector<Vec3> grid(const Vec3& low, std::array<int, 3> n, double spacing) {
  std::vector<Vec3> places;
  for (int z = 0; z < n[2]; ++z) {
    for (int y = 0; y < n[1]; ++y) {
      for (int x = 0; x < n[0]; ++x) places.push_back(low + spacing * Vec3(x, y, z));
    }
  }
  return places;
}

std::size_t index_below(std::size_t n, Random& random) {
  return std::min(n - 1, static_cast<std::size_t>(random.uniform() * static_cast<double>(n)));
}

// Evenly in the shell between one and two distances from the origin.
Vec3 in_shell(double distance, Random& random) {
  const double radius = distance * std::cbrt(1.0 + 7.0 * random.uniform());
  const double cosine = 2.0 * random.uniform() - 1.0;
  const double azimuth = 2.0 * std::numbers::pi * random.uniform();
  const double sine = std::sqrt(1.0 - cosine * cosine);
  return radius * Vec3(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine);
}

// Places with a least distance, found again by a grid whose cells (sides least distance / sqrt(3))
// hold one place each.
class SpacedPlaces {
 public:
  SpacedPlaces(const Box3& box, double least_distance)
      : box_(box), least_(least_distance), side_(least_distance / std::numbers::sqrt3) {
    for (int axis = 0; axis < 3; ++axis) n_[axis] = 1 + int(box.sizes()[axis] / side_);
    cell_.assign(std::size_t(n_[0]) * std::size_t(n_[1]) * std::size_t(n_[2]), -1);
  }

  const std::vector<Vec3>& places() const { return places_; }

  std::size_t cells() const { return cell_.size(); }
  bool is_taken(std::size_t cell) const { return cell_[cell] >= 0; }

  // What of the box is in this cell.
  Box3 box_of(std::size_t cell) const {
    const std::size_t nx = std::size_t(n_[0]), ny = std::size_t(n_[1]);
    const Vec3 at(double(cell % nx), double(cell / nx % ny), double(cell / nx / ny));
    const Vec3 low = (box_.min() + side_ * at).cwiseMin(box_.max());
    return {low, (low + Vec3::Constant(side_)).cwiseMin(box_.max())};
  }

  bool has_room_at(const Vec3& p) const {
    const std::array<int, 3> at = cell_of(p);
    for (int z = std::max(0, at[2] - 2); z <= std::min(n_[2] - 1, at[2] + 2); ++z) {
      for (int y = std::max(0, at[1] - 2); y <= std::min(n_[1] - 1, at[1] + 2); ++y) {
        for (int x = std::max(0, at[0] - 2); x <= std::min(n_[0] - 1, at[0] + 2); ++x) {
          const std::int32_t other = cell_[flat({x, y, z})];
          if (other >= 0 && (places_[std::size_t(other)] - p).norm() < least_) return false;
        }
      }
    }
    return true;
  }

  void add(const Vec3& p) {
    cell_[flat(cell_of(p))] = static_cast<std::int32_t>(places_.size());
    places_.push_back(p);
  }

 private:
  std::array<int, 3> cell_of(const Vec3& p) const {
    std::array<int, 3> at;
    for (int axis = 0; axis < 3; ++axis) {
      at[axis] = std::clamp(int((p[axis] - box_.min()[axis]) / side_), 0, n_[axis] - 1);
    }
    return at;
  }

  std::size_t flat(const std::array<int, 3>& at) const {
    return std::size_t(at[0]) +
           std::size_t(n_[0]) * (std::size_t(at[1]) + std::size_t(n_[1]) * std::size_t(at[2]));
  }

  Box3 box_;
  double least_, side_;
  std::array<int, 3> n_;
  std::vector<std::int32_t> cell_;  // the place in each, or -1
  std::vector<Vec3> places_;
};

constexpr int kTries = 30;        // Bridson's k
constexpr int kTriesInACell = 4;  // there are some five cells to a place

using Inside = std::function<bool(const Vec3&)>;

bool added(const Vec3& p, const Inside& inside, SpacedPlaces& spaced) {
  if (!inside(p) || !spaced.has_room_at(p)) return false;
  spaced.add(p);
  return true;
}

// New places in the shell around one that is there, until none of kTries has room.
void spread_from(const Vec3& first, const Inside& inside, double least_distance,
                 SpacedPlaces& spaced, Random& random) {
  for (std::vector<Vec3> active = {first}; !active.empty();) {
    const std::size_t at = index_below(active.size(), random);
    bool found = false;
    for (int i = 0; i < kTries && !found; ++i) {
      const Vec3 p = active[at] + in_shell(least_distance, random);
      found = added(p, inside, spaced);
      if (found) active.push_back(p);
    }
    if (found) continue;
    active[at] = active.back();
    active.pop_back();
  }
}

// The front of new places dies out where most of each shell is outside: in boxes thinner than the
// distance nearly at once. So each cell of the grid that is still empty may start it anew.
std::vector<Vec3> scattered(const Box3& box, const Inside& inside, const Vec3& first,
                            double least_distance, Random& random) {
  SpacedPlaces spaced(box, least_distance);
  spaced.add(first);
  spread_from(first, inside, least_distance, spaced, random);
  for (std::size_t cell = 0; cell < spaced.cells(); ++cell) {
    for (int i = 0; i < kTriesInACell && !spaced.is_taken(cell); ++i) {
      const Vec3 p = random.in_box(spaced.box_of(cell));
      if (added(p, inside, spaced)) spread_from(p, inside, least_distance, spaced, random);
    }
  }
  return spaced.places();
}

}  // namespace

GeometricModel particle_cloud(std::span<const Vec3> positions_m, const std::string& name) {
  if (positions_m.empty()) throw InputError({name, "it has no points", "give at least one"});
  GeometricModelBuilder builder;
  builder.begin_subobject(name);
  for (const Vec3& p : positions_m) {
    require_finite(name, "a position", p);
    builder.add_point(p);
  }
  return builder.finish();
}

std::vector<Vec3> grid_in_box(const Vec3& low_m, const Vec3& high_m, double spacing_m) {
  const Box3 box(low_m, high_m);
  require_usable(box, "spacing", spacing_m);
  std::array<int, 3> n;
  Vec3 first;
  for (int axis = 0; axis < 3; ++axis) {
    n[axis] = fitting(box.sizes()[axis], spacing_m);
    first[axis] = 0.5 * (low_m[axis] + high_m[axis] - (n[axis] - 1) * spacing_m);
    if (n[axis] > 0) continue;
    throw InputError({kWhere,
                      say("the box is ", box.sizes()[axis], " m long along axis ", axis,
                          ", less than the spacing of ", spacing_m, " m"),
                      "give a smaller spacing"});
  }
  return grid(first, n, spacing_m);
}

std::vector<Vec3> grid_in_sphere(const Vec3& centre_m, double radius_m, double spacing_m) {
  const Box3 box = box_around(centre_m, radius_m);
  require_usable(box, "spacing", spacing_m);
  const int half = fitting(radius_m, spacing_m);
  const int n = 2 * half + 1;
  std::vector<Vec3> places = grid(Vec3::Constant(-half * spacing_m), {n, n, n}, spacing_m);
  std::erase_if(places, [&](const Vec3& p) { return p.norm() > radius_m * (1.0 + 1e-12); });
  for (Vec3& p : places) p += centre_m;
  return places;
}

std::vector<Vec3> scattered_in_box(const Vec3& low_m, const Vec3& high_m, double least_distance_m,
                                   std::uint64_t seed) {
  const Box3 box(low_m, high_m);
  require_usable(box, "least distance", least_distance_m);
  Random random(seed);
  const Vec3 first = random.in_box(box);
  return scattered(
      box, [&](const Vec3& p) { return box.contains(p); }, first, least_distance_m, random);
}

std::vector<Vec3> scattered_in_sphere(const Vec3& centre_m, double radius_m,
                                      double least_distance_m, std::uint64_t seed) {
  const Box3 box = box_around(centre_m, radius_m);
  require_usable(box, "least distance", least_distance_m);
  const auto inside = [&](const Vec3& p) { return (p - centre_m).norm() <= radius_m; };
  Random random(seed);
  Vec3 first = random.in_box(box);
  while (!inside(first)) first = random.in_box(box);
  return scattered(box, inside, first, least_distance_m, random);
}

}  // namespace limber

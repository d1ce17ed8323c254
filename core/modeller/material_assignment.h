#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/modeller/material.h"

namespace limber {

// Where a cell is: what the choice of its material may depend on.
struct CellPlace {
  CellId cell;
  Vec3 centre;                   // m, the mean of its corners
  const std::string& subobject;  // the name of the part it belongs to
};

// Chooses: an index into a list of materials. Any function will do; two common ones are below.
using MaterialChoice = std::function<std::size_t(const CellPlace&)>;

// What an object has once, however many materials it is made of. Where materials disagree on such a
// value it has to be stated here.
struct WholeObjectValues {
  std::optional<double> damping_ratio = {};
  std::optional<double> internal_damping = {};  // 1/s
  std::optional<double> friction = {};
  std::optional<double> restitution = {};
};

// with_material() with a material for every cell. Masses and spring constants are summed over the
// cells that share a point or an edge; a shared edge breaks at the smaller of their strains.
// All materials have to have the same softening S, which scales time, and agree on the damping
// ratio, internal damping, friction and restitution, unless `whole` states these. Throws InputError
// when they do not, when a choice is no index, when a material is given to no cell (a name or a
// region that meets nothing), and as with_material().
PhysicalModel with_materials(GeometricModel geometry, std::string name,
                             std::span<const Material> materials, const MaterialChoice& which,
                             const WholeObjectValues& whole = {});

// Gives nothing: a cell that only this was chosen for is an error.
inline constexpr std::size_t kNoMaterial = std::numeric_limits<std::size_t>::max();

// by_subobject({{"wall", 0}, {"handle", 1}}): by the name of the part; `otherwise` for the others.
MaterialChoice by_subobject(std::vector<std::pair<std::string, std::size_t>> index_of_name,
                            std::size_t otherwise = kNoMaterial);

// A part of space: whether a place (m) is in it. Boundaries count as inside.
using Region = std::function<bool(const Vec3&)>;
Region in_box(const Vec3& low_m, const Vec3& high_m);
Region in_sphere(const Vec3& centre_m, double radius_m);
// The side of the plane through `point_m` that `inward` points to.
Region in_half_space(const Vec3& point_m, const Vec3& inward);

// by_region({{in_sphere(c, r), 1}}, 0): the first region that the cell's centre is in.
MaterialChoice by_region(std::vector<std::pair<Region, std::size_t>> index_of_region,
                         std::size_t otherwise = kNoMaterial);

// The edges whose middle is in the region, ascending, for values of one's own:
//   for (EdgeId e : edges_in(model.geometry, seam)) model.edges[e].break_threshold *= 0.5;
// Everything in PhysicalModel may be set so; subobjects have their edges as a range. After a change
// of stiffness or mass call set_stiffness_proportional_damping() again.
std::vector<EdgeId> edges_in(const GeometricModel& geometry, const Region& region);

}  // namespace limber

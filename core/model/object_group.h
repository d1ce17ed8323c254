#pragma once

#include <string>
#include <vector>

#include "core/model/errors.h"
#include "core/model/physical_model.h"

namespace limber {

// Objects that belong together, the highest level of the paper's hierarchy: they are placed and set
// in motion as one. Nothing joins the objects of a group; gluing does that.
struct ObjectGroup {
  std::string name;
  std::vector<PhysicalModel> objects;
  std::vector<ObjectGroup> groups;
};

// Sum over all objects at every depth, kg.
double total_mass(const ObjectGroup& group);

// The common centre of mass, m. Throws InputError where there is no mass.
Vec3 centre_of_mass(const ObjectGroup& group);

// Rigid placement of everything in the group about the world's origin: place().
void place(ObjectGroup& group, const Mat3& rotation, const Vec3& translation_m);

// Adds v + omega x (x - common centre of mass) to the velocity of every point: the group moves as
// one rigid body would, on top of how its objects moved before.
void set_in_motion(ObjectGroup& group, const Vec3& velocity_m_s, const Vec3& omega_rad_s);

// What a simulation takes: a group's own objects, then those of its groups, depth first, each with
// its path as its name: "kitchen/shelf/teapot".
std::vector<PhysicalModel> flattened(const ObjectGroup& group);

// N1 of docs/invariants.md, then every violated invariant of each object, named by its path. At
// most `most` are listed.
std::vector<Diagnostic> validate(const ObjectGroup& group, std::size_t most = 20);

}  // namespace limber

#include "core/model/object_group.h"

#include <set>

#include "core/model/diagnostic_list.h"
#include "core/model/validate.h"

namespace limber {
namespace {

// visit(object, path) for all objects in the order of flattened(). `Group` may be const.
template <class Group, class Visit>
void for_each_object(Group& group, const std::string& path, Visit& visit) {
  for (auto& object : group.objects) visit(object, path + "/" + object.name);
  for (auto& inner : group.groups) for_each_object(inner, path + "/" + inner.name, visit);
}

template <class Group, class Visit>
void for_each_object(Group& group, Visit visit) {
  for_each_object(group, group.name, visit);
}

std::vector<std::string> names_in(const ObjectGroup& group) {
  std::vector<std::string> names;
  for (const PhysicalModel& object : group.objects) names.push_back(object.name);
  for (const ObjectGroup& inner : group.groups) names.push_back(inner.name);
  return names;
}

// N1: paths tell objects apart.
void check_names(const ObjectGroup& group, const std::string& path, std::vector<Diagnostic>& out) {
  std::set<std::string> seen;
  for (const std::string& name : names_in(group)) {
    if (name.empty() || name.find('/') != std::string::npos)
      out.push_back({path, "N1 the name '" + name + "' is empty or has a '/' in it", "change it"});
    else if (!seen.insert(name).second)
      out.push_back({path, "N1 the name '" + name + "' is used twice", "rename one of the two"});
  }
  for (const ObjectGroup& inner : group.groups) check_names(inner, path + "/" + inner.name, out);
}

}  // namespace

double total_mass(const ObjectGroup& group) {
  double mass = 0.0;
  for_each_object(
      group, [&](const PhysicalModel& object, const std::string&) { mass += total_mass(object); });
  return mass;
}

Vec3 centre_of_mass(const ObjectGroup& group) {
  const double mass = total_mass(group);
  if (!(mass > 0.0))
    throw InputError({group.name, say("P2 its mass adds up to ", mass, " kg"),
                      "add objects whose points have a mass"});
  Vec3 moment = Vec3::Zero();
  for_each_object(group, [&](const PhysicalModel& object, const std::string&) {
    if (!object.points.empty()) moment += total_mass(object) * centre_of_mass(object);
  });
  return moment / mass;
}

void place(ObjectGroup& group, const Mat3& rotation, const Vec3& translation_m) {
  for_each_object(group, [&](PhysicalModel& object, const std::string&) {
    place(object, rotation, translation_m);
  });
}

void set_in_motion(ObjectGroup& group, const Vec3& velocity_m_s, const Vec3& omega_rad_s) {
  const Vec3 centre = centre_of_mass(group);
  for_each_object(group, [&](PhysicalModel& object, const std::string&) {
    set_in_motion(object, velocity_m_s, omega_rad_s, centre);
  });
}

std::vector<PhysicalModel> flattened(const ObjectGroup& group) {
  std::vector<PhysicalModel> models;
  for_each_object(group, [&](const PhysicalModel& object, const std::string& path) {
    models.push_back(object);
    models.back().name = path;
  });
  return models;
}

std::vector<Diagnostic> validate(const ObjectGroup& group, std::size_t most) {
  std::vector<Diagnostic> found;
  check_names(group, group.name, found);
  for_each_object(group, [&](const PhysicalModel& object, const std::string& path) {
    if (found.size() >= most) return;
    for (Diagnostic& d : validate(object, most)) {
      d.where = path + d.where.substr(object.name.size());  // they begin with the object's name
      found.push_back(std::move(d));
    }
  });
  if (found.size() > most) found.resize(most);
  return found;
}

}  // namespace limber

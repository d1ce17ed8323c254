#include "demos/cli/body_groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

namespace limber::demos {
namespace {

using Members = std::vector<const BodySummary*>;

std::string kind_of(const std::string& name) {
  const auto end = name.find_last_not_of("0123456789");
  if (end == std::string::npos || end + 1 == name.size()) return name;
  const auto word = name.find_last_not_of(' ', end);
  return word == std::string::npos ? name : name.substr(0, word + 1);
}

std::string representations(const Members& members) {
  std::map<std::string, std::size_t> count;
  for (const BodySummary* body : members) ++count[body->representation];
  if (count.size() == 1) return count.begin()->first;
  std::string text;
  for (const auto& [name, n] : count)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, name);
  return text;
}

BodySummary sum_of(const std::string& kind, const Members& members) {
  BodySummary sum;
  sum.name = fmt::format("{} x {}", members.size(), kind);
  sum.representation = representations(members);
  sum.centre_of_mass = sum.velocity = Vec3::Zero();
  for (const BodySummary* body : members) {
    sum.mass_kg += body->mass_kg;
    sum.centre_of_mass += body->mass_kg * body->centre_of_mass;
    sum.velocity += body->mass_kg * body->velocity;
    sum.broken_edges += body->broken_edges;
    sum.fragments += body->fragments;
    sum.softening = std::max(sum.softening, body->softening);
  }
  sum.centre_of_mass /= sum.mass_kg;
  sum.velocity /= sum.mass_kg;
  return sum;
}

}  // namespace

std::vector<BodySummary> grouped_bodies(const std::vector<BodySummary>& bodies) {
  std::map<std::string, Members> kinds;
  for (const BodySummary& body : bodies) kinds[kind_of(body.name)].push_back(&body);
  std::vector<BodySummary> rows;
  for (const BodySummary& body : bodies) {
    const Members& members = kinds[kind_of(body.name)];
    if (members.size() < kLeastBodyGroup)
      rows.push_back(body);
    else if (members.front() == &body)
      rows.push_back(sum_of(kind_of(body.name), members));
  }
  return rows;
}

}  // namespace limber::demos

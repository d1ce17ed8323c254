#include "demos/cli/info_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "demos/cli/report_json.h"
#include "demos/cli/text_table.h"
#include "demos/cli/vector_json.h"

namespace limber::demos {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostSubobjects = 24;  // lines of one report
constexpr std::size_t kMostName = 60;        // bytes of a name in it

// Of the further bytes of a character in UTF-8.
bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

// Cut between two characters.
std::string shortened(const std::string& name) {
  const std::string text = printable(name);
  if (text.size() <= kMostName) return text;
  std::size_t end = kMostName - 3;
  while (end > 0 && continues_character(text[end])) --end;
  return text.substr(0, end) + "...";
}

std::string vector_text(const Vec3& v) {
  return fmt::format("{:.4g} {:.4g} {:.4g}", v.x(), v.y(), v.z());
}

std::string range_text(const Range& range) {
  if (range.empty()) return "-";
  if (range.least == range.most) return significant(range.least);
  return fmt::format("{} to {}", significant(range.least), significant(range.most));
}

std::string section(const TextTable& table) { return fmt::format("\n{}", table.text()); }

std::string headline(const std::string& file, const Seal& seal, const ModelFacts& facts) {
  return fmt::format("{}: limber {}, version {}, {} bytes, checksum {}\n\"{}\"\n", file, seal.kind,
                     seal.version, grouped(seal.file_size), hex_hash(seal.checksum),
                     shortened(facts.name));
}

void add_counts(TextTable& table, const std::string& name, const LevelCounts& n) {
  table.add_row({name, grouped(n.points), grouped(n.edges), grouped(n.faces), grouped(n.cells)});
}

std::string counts_section(const ModelFacts& facts) {
  TextTable table;
  table.add_row({"subobject", "points", "edges", "faces", "cells"});
  const std::size_t shown = std::min(facts.subobjects.size(), kMostSubobjects);
  for (std::size_t i = 0; i < shown; ++i)
    add_counts(table, shortened(facts.subobjects[i].name), facts.subobjects[i].count);
  if (shown < facts.subobjects.size())
    table.add_row({fmt::format("and {} more; --json FILE lists them all",
                               grouped(facts.subobjects.size() - shown))});
  add_counts(table, "all", facts.count);
  return section(table);
}

std::string body_section(const ModelFacts& facts) {
  TextTable table;
  table.add_row({"size, m", vector_text(facts.highest - facts.lowest)});
  table.add_row({"from, m", vector_text(facts.lowest)});
  table.add_row({"to, m", vector_text(facts.highest)});
  table.add_row({"mass, kg", significant(facts.mass_kg)});
  table.add_row({"centre of mass, m", vector_text(facts.centre_of_mass)});
  table.add_row({"pinned points", grouped(facts.pinned_points)});
  table.add_row({"broken edges", grouped(facts.broken_edges)});
  table.add_row({"invalid cells", grouped(facts.invalid_cells)});
  table.add_row({"skins", grouped(facts.skin.skins)});
  if (facts.skin.skins > 0) table.add_row({"triangles of skins", grouped(facts.skin.triangles)});
  return section(table);
}

std::string softening_text(double softening) {
  if (softening <= 1.0) return "1 (the real material)";
  return fmt::format("{} (real modulus / simulated)", significant(softening));
}

std::string springs_section(const ModelFacts& facts) {
  TextTable table;
  table.add_row({"softening S", softening_text(facts.object.softening)});
  table.add_row({"stiffness, N/m", range_text(facts.stiffness)});
  table.add_row({"rest length, m", range_text(facts.rest_length)});
  table.add_row({"damping ratio at the highest frequency", significant(facts.damping_ratio)});
  table.add_row({"internal damping, 1/s", significant(facts.object.internal_damping)});
  table.add_row({"breaks at a stretch of, m", range_text(facts.break_threshold)});
  table.add_row({"breaks at a shortening of, m", range_text(facts.crush_threshold)});
  table.add_row({"edges that never break", grouped(facts.unbreakable_edges)});
  table.add_row({"longest stable substep, s",
                 std::isfinite(facts.stable_step_s) ? significant(facts.stable_step_s) : "any"});
  return section(table);
}

std::string contact_section(const ModelFacts& facts) {
  TextTable table;
  table.add_row({"friction", significant(facts.object.friction)});
  table.add_row({"restitution", significant(facts.object.restitution)});
  table.add_row({"contact radius / shortest edge", significant(facts.object.contact_share)});
  table.add_row({"radius of lone points, m", significant(facts.object.particle_radius)});
  return section(table);
}

Json range_json(const Range& range) {
  return range.empty() ? Json(nullptr) : Json::array({range.least, range.most});
}

Json counts_json(const LevelCounts& n) {
  return {{"points", n.points}, {"edges", n.edges}, {"faces", n.faces}, {"cells", n.cells}};
}

Json subobjects_json(const ModelFacts& facts) {
  Json list = Json::array();
  for (const SubobjectFacts& s : facts.subobjects) {
    Json one = {{"name", s.name}};
    one.update(counts_json(s.count));
    list.push_back(std::move(one));
  }
  return list;
}

Json body_json(const ModelFacts& facts) {
  return {{"lowest_m", vector_json(facts.lowest)},
          {"highest_m", vector_json(facts.highest)},
          {"mass_kg", facts.mass_kg},
          {"com_m", vector_json(facts.centre_of_mass)},
          {"pinned_points", facts.pinned_points},
          {"broken_edges", facts.broken_edges},
          {"invalid_cells", facts.invalid_cells},
          {"skins",
           {{"skins", facts.skin.skins},
            {"cells", facts.skin.cells},
            {"vertices", facts.skin.vertices},
            {"triangles", facts.skin.triangles}}}};
}

Json springs_json(const ModelFacts& facts) {
  const double step = facts.stable_step_s;
  return {{"softening", facts.object.softening},
          {"stiffness_n_m", range_json(facts.stiffness)},
          {"rest_length_m", range_json(facts.rest_length)},
          {"damping_ratio", facts.damping_ratio},
          {"internal_damping_1_s", facts.object.internal_damping},
          {"break_threshold_m", range_json(facts.break_threshold)},
          {"crush_threshold_m", range_json(facts.crush_threshold)},
          {"unbreakable_edges", facts.unbreakable_edges},
          {"stable_step_s", std::isfinite(step) ? Json(step) : Json(nullptr)},
          {"friction", facts.object.friction},
          {"restitution", facts.object.restitution},
          {"contact_share", facts.object.contact_share},
          {"particle_radius_m", facts.object.particle_radius}};
}

}  // namespace

std::string printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(),
      [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, '?');
  return text;
}

std::string info_report(const std::string& file, const Seal& seal, const ModelFacts& facts) {
  return headline(file, seal, facts) + counts_section(facts) + body_section(facts) +
         springs_section(facts) + contact_section(facts) + "\nvalid: every invariant holds\n";
}

std::string info_json(const std::string& file, const Seal& seal, const ModelFacts& facts) {
  Json json = {{"file", file},
               {"kind", seal.kind},
               {"version", seal.version},
               {"bytes", seal.file_size},
               {"checksum", hex_hash(seal.checksum)},
               {"valid", true},
               {"name", facts.name}};
  json.update(counts_json(facts.count));
  json["subobjects"] = subobjects_json(facts);
  json.update(body_json(facts));
  json.update(springs_json(facts));
  // Names come from the model's author: a wrong byte must not cost the rest.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace limber::demos

#include "demos/cli/model_facts.h"

#include <algorithm>

#include "core/dynamics/lattice.h"
#include "core/model/bounds.h"

namespace limber::demos {
namespace {

LevelCounts counts_of(const GeometricModel& g) {
  return {g.points.size(), g.edges.size(), g.faces.size(), g.cells.size()};
}

std::vector<SubobjectFacts> subobjects_of(const GeometricModel& g) {
  std::vector<SubobjectFacts> facts;
  for (const Subobject& s : g.subobjects)
    facts.push_back({s.name, {s.points.size(), s.edges.size(), s.faces.size(), s.cells.size()}});
  return facts;
}

SkinCounts skins_of(const PhysicalModel& model) {
  SkinCounts n;
  n.skins = model.skins.size();
  for (const Skin& skin : model.skins) {
    n.cells += skin.cells.size();
    n.vertices += skin.vertices.size();
    n.triangles += skin.triangles.size();
  }
  return n;
}

void take_points(ModelFacts& facts, const PhysicalModel& model) {
  facts.pinned_points = static_cast<std::size_t>(
      std::count_if(model.points.begin(), model.points.end(),
                    [](const PointAttributes& point) { return point.pinned; }));
  facts.mass_kg = total_mass(model);
  if (model.points.empty()) return;
  facts.centre_of_mass = centre_of_mass(model);
  const Box3 box = bounds_of(model.geometry.points);
  facts.lowest = box.min();
  facts.highest = box.max();
}

void take_edge(ModelFacts& facts, const EdgeAttributes& edge) {
  facts.stiffness.take(edge.stiffness);
  facts.rest_length.take(edge.rest_length);
  const bool breaks = edge.break_threshold < kUnbreakable;
  const bool crushes = edge.crush_threshold < kUnbreakable;
  if (breaks) facts.break_threshold.take(edge.break_threshold);
  if (crushes) facts.crush_threshold.take(edge.crush_threshold);
  if (!breaks && !crushes) ++facts.unbreakable_edges;
}

void take_edges(ModelFacts& facts, const PhysicalModel& model) {
  for (const EdgeAttributes& edge : model.edges) {
    if (edge.broken)
      ++facts.broken_edges;
    else
      take_edge(facts, edge);
  }
}

// As the simulator will have it.
void take_step(ModelFacts& facts, PhysicalModel model) {
  Lattice lattice;
  add_object(lattice, std::move(model));
  const LatticeObject& object = lattice.objects.front();
  facts.stable_step_s = object.largest_step;
  if (object.spring_frequency > 0.0)
    facts.damping_ratio = object.spring_damping / (2.0 * object.spring_frequency);
}

}  // namespace

void Range::take(double x) {
  least = std::min(least, x);
  most = std::max(most, x);
}

ModelFacts model_facts(PhysicalModel model) {
  ModelFacts facts;
  facts.name = model.name;
  facts.count = counts_of(model.geometry);
  facts.subobjects = subobjects_of(model.geometry);
  facts.skin = skins_of(model);
  take_points(facts, model);
  take_edges(facts, model);
  facts.invalid_cells = static_cast<std::size_t>(
      std::count_if(model.cells.begin(), model.cells.end(),
                    [](const CellAttributes& cell) { return !cell.valid; }));
  facts.object = model.object;
  take_step(facts, std::move(model));
  return facts;
}

}  // namespace limber::demos

#include "core/operators/glue_notes.h"

#include <algorithm>

#include "core/model/diagnostic_list.h"
#include "core/model/median.h"

namespace limber {
namespace {

constexpr double kSpacings = 1.5;
constexpr double kPoints = 2.0;
constexpr std::size_t kBondsOfAPoint = 9;
constexpr double kLengths = 3.0;

IdVector<PointId, double> shortest_edges(const PhysicalModel& model) {
  IdVector<PointId, double> shortest(model.points.size(), kUnbreakable);
  for (std::size_t e = 0; e < model.edges.size(); ++e) {
    const auto [p, q] = model.geometry.edges[EdgeId(e)];
    const double length = (model.geometry.points[q] - model.geometry.points[p]).norm();
    shortest[p] = std::min(shortest[p], length);
    shortest[q] = std::min(shortest[q], length);
  }
  return shortest;
}

GlueSeam::Side side_of(const PhysicalModel& model, std::span<const PointPair> bonds,
                       PointId PointPair::*end) {
  IdVector<PointId, std::size_t> count(model.points.size(), 0);
  for (const PointPair& bond : bonds) ++count[bond.*end];
  const IdVector<PointId, double> shortest = shortest_edges(model);
  GlueSeam::Side side;
  std::vector<double> spacings;
  for (std::size_t i = 0; i < count.size(); ++i) {
    const PointId p(i);
    if (count[p] == 0) continue;
    ++side.points;
    if (shortest[p] < kUnbreakable) spacings.push_back(shortest[p]);
    if (count[p] <= side.most_bonds) continue;
    side.most_bonds = count[p];
    side.most_bonded = p;
  }
  side.spacing_m = upper_median(std::move(spacings));
  return side;
}

bool apart(double x, double y, double factor) {
  return std::max(x, y) > factor * std::min(x, y) * (1.0 + 1e-9);
}

using Notes = std::vector<Diagnostic>;

void note_spacing(const std::string& where, const GlueSeam& s, Notes& notes) {
  if (s.a.spacing_m == 0.0 || s.b.spacing_m == 0.0) return;
  if (!apart(s.a.spacing_m, s.b.spacing_m, kSpacings)) return;
  notes.push_back({where,
                   say("the spacings do not match: points are ", s.a.spacing_m,
                       " m apart on one side, ", s.b.spacing_m, " m on the other; ", s.a.points,
                       " points meet ", s.b.points, " over bonds of ", s.median_m, " m (median)"),
                   "model both with a similar spacing at the seam"});
}

void note_crowding(const std::string& where, const PhysicalModel& a, const PhysicalModel& b,
                   const GlueSeam& s, Notes& notes) {
  const double points_a = static_cast<double>(s.a.points),
               points_b = static_cast<double>(s.b.points);
  const bool uneven = std::max(points_a, points_b) >= kPoints * std::min(points_a, points_b);
  const bool a_is_crowded = s.a.most_bonds >= s.b.most_bonds;
  const GlueSeam::Side& crowded = a_is_crowded ? s.a : s.b;
  if (crowded.most_bonds < 2 || !(uneven || crowded.most_bonds > kBondsOfAPoint)) return;
  notes.push_back({where,
                   say("many points meet one: point ", crowded.most_bonded.value, " of ",
                       (a_is_crowded ? a : b).name, " has ", crowded.most_bonds, " of ", s.bonds,
                       " bonds; ", s.a.points, " points meet ", s.b.points),
                   "glue at a smaller distance, one to one, or with a similar spacing"});
}

void note_lengths(const std::string& where, const GlueSeam& s, Notes& notes) {
  if (!apart(s.shortest_m, s.longest_m, kLengths)) return;
  notes.push_back({where,
                   say("the bonds are of different lengths, ", s.shortest_m, " m to ", s.longest_m,
                       " m (median ", s.median_m, " m), and equally stiff"),
                   "glue at a smaller distance, or leave a gap as wide everywhere"});
}

// What an object has once comes from the first: what the second had must not vanish unseen.
void note_object_values(const std::string& where, const PhysicalModel& a, const PhysicalModel& b,
                        Notes& notes) {
  const auto compare = [&](double ObjectAttributes::*value, const char* quantity) {
    if (a.object.*value == b.object.*value) return;
    notes.push_back({where,
                     say(quantity, " becomes ", a.object.*value, ", that of ", a.name, "; ", b.name,
                         " had ", b.object.*value),
                     "set it in the glued model's object"});
  };
  compare(&ObjectAttributes::softening, "softening S");
  compare(&ObjectAttributes::friction, "friction");
  compare(&ObjectAttributes::restitution, "restitution");
  compare(&ObjectAttributes::internal_damping, "internal damping");
  compare(&ObjectAttributes::contact_share, "contact share");
  compare(&ObjectAttributes::particle_radius, "particle radius");
}

}  // namespace

GlueSeam glue_seam(const PhysicalModel& a, const PhysicalModel& b,
                   std::span<const PointPair> bonds) {
  GlueSeam seam;
  seam.a = side_of(a, bonds, &PointPair::a);
  seam.b = side_of(b, bonds, &PointPair::b);
  seam.bonds = bonds.size();
  std::vector<double> lengths;
  for (const PointPair& bond : bonds) lengths.push_back(bond.distance);
  if (lengths.empty()) return seam;
  seam.shortest_m = *std::ranges::min_element(lengths);
  seam.longest_m = *std::ranges::max_element(lengths);
  seam.median_m = upper_median(std::move(lengths));
  return seam;
}

std::vector<Diagnostic> glue_notes(const PhysicalModel& a, const PhysicalModel& b,
                                   const GlueSeam& seam) {
  const std::string where = "glue: " + a.name + " + " + b.name;
  Notes notes;
  note_spacing(where, seam, notes);
  note_crowding(where, a, b, seam, notes);
  note_lengths(where, seam, notes);
  note_object_values(where, a, b, notes);
  return notes;
}

}  // namespace limber

// Group 11: the gluing operator's pairs.

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/dynamics/components.h"
#include "core/operators/gluing_operator.h"
#include "core/operators/point_pairs.h"
#include "tests/reference/cubic.h"
#include "tests/reference/kinds.h"
#include "tests/reference/readings.h"

namespace limber::reference {
namespace {

PhysicalModel grid(const Json& points, double spacing, const Vec3& origin) {
  CubicLattice shape;
  shape.points = points.get<std::array<int, 3>>();
  shape.spacing = spacing;
  shape.origin = origin;
  shape.springs.axial = 1.0;
  return cubic_lattice(shape);
}

// Coordinates of a case are whole micrometres, so that squared distances are whole numbers: a
// distance as its file writes it, to the last digit.
double on_micrometre_grid(double distance) {
  const double micrometres = distance * 1e6;
  return std::sqrt(std::round(micrometres * micrometres)) * 1e-6;
}

bool is_surely_below(const PointPair& pair, double distance) {
  return pair.distance + pair.rounding < distance;
}

double largest_distance(const std::vector<PointPair>& pairs) {
  double largest = 0.0;
  for (const PointPair& pair : pairs) largest = std::max(largest, pair.distance);
  return on_micrometre_grid(largest);
}

// Of those that are not among the pairs within `distance`; -1 without any.
double next_distance(const std::vector<PointPair>& all, double distance) {
  double next = -1.0;
  for (const PointPair& pair : all) {
    if (pair.distance - pair.rounding <= distance) continue;
    if (next < 0.0 || pair.distance < next) next = pair.distance;
  }
  return next < 0.0 ? -1.0 : on_micrometre_grid(next);
}

// How many pairs each point is in.
std::map<PointId, int> partners(const std::vector<PointPair>& pairs, PointId PointPair::*end) {
  std::map<PointId, int> count;
  for (const PointPair& pair : pairs) ++count[pair.*end];
  return count;
}

int most(const std::map<PointId, int>& count) {
  int largest = 0;
  for (const auto& [point, n] : count) largest = std::max(largest, n);
  return largest;
}

// Pieces that are joined where a pair has one end in each.
int joined(const Components& pieces, const std::vector<PointPair>& pairs, std::size_t points_of_a) {
  std::vector<std::int32_t> label = pieces.label;
  for (const PointPair& pair : pairs) {
    const std::int32_t from = label[points_of_a + pair.b.index()], to = label[pair.a.index()];
    std::replace(label.begin(), label.end(), from, to);
  }
  return static_cast<int>(std::set(label.begin(), label.end()).size());
}

// Connected pieces of both after gluing. glue() refuses points that coincide, as a bond between
// them would have no direction; but they are in one place, so that any pair joins.
int bodies_after_gluing(const PhysicalModel& a, const PhysicalModel& b, double distance,
                        const std::vector<PointPair>& pairs) {
  const auto coincide = [](const PointPair& pair) { return pair.distance <= pair.rounding; };
  if (pairs.empty() || std::any_of(pairs.begin(), pairs.end(), coincide)) {
    return joined(components(compiled({a, b})), pairs, a.points.size());
  }
  return components(compiled(glue(a, b, {.distance = distance, .stiffness = 1.0}).model)).count;
}

Json row(const PhysicalModel& a, const PhysicalModel& b, const std::vector<PointPair>& all,
         double distance) {
  const auto pairs = pairs_within(a.geometry.points, b.geometry.points, distance);
  const auto below = std::count_if(pairs.begin(), pairs.end(), [&](const PointPair& pair) {
    return is_surely_below(pair, distance);
  });
  const auto of_a = partners(pairs, &PointPair::a), of_b = partners(pairs, &PointPair::b);
  return {distance,
          pairs.size(),
          below,
          of_a.size(),
          of_b.size(),
          one_to_one(pairs).size(),
          most(of_a),
          largest_distance(pairs),
          next_distance(all, distance),
          bodies_after_gluing(a, b, distance, pairs)};
}

double reach(const PhysicalModel& a, const PhysicalModel& b) {
  double farthest = 0.0;
  for (const Vec3& p : a.geometry.points) {
    for (const Vec3& q : b.geometry.points) farthest = std::max(farthest, (q - p).norm());
  }
  return farthest;
}

Json glue_table(const Case& c) {
  const PhysicalModel a = grid(c.params.at("nA"), c.params.at("aA"), Vec3::Zero());
  const PhysicalModel b = grid(c.params.at("nB"), c.params.at("aB"), vec3(c.params.at("oB")));
  const auto all = pairs_within(a.geometry.points, b.geometry.points, reach(a, b));
  Json rows = Json::array();
  for (double distance : c.params.at("d_values")) rows.push_back(row(a, b, all, distance));
  return {{"columns",
           {"d", "pairs_le_d", "pairs_lt_d", "A_points_with_partner", "B_points_with_partner",
            "greedy_one_to_one", "max_partners_of_one_A_point", "largest_distance_le_d",
            "smallest_distance_gt_d_or_-1", "bodies_after_gluing"}},
          {"rows", rows}};
}

}  // namespace

Kinds gluing_kinds() { return {{"glue", glue_table}}; }

}  // namespace limber::reference

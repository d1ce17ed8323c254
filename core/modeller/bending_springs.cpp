#include "core/modeller/bending_springs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "core/model/diagnostic_list.h"
#include "core/model/errors.h"
#include "core/modeller/plane_fit.h"
#include "core/modeller/shape_checks.h"

namespace limber {
namespace {

constexpr double kLeastCosine = std::numbers::sqrt3 / 2.0;  // of 30 degrees, between two edges

// The sheet around each point.
struct Surroundings {
  IdVector<PointId, std::vector<PointId>> neighbours;  // ascending by edge
  IdVector<PointId, Vec3> normal;                      // m^2, sum of the faces' areas as vectors
  IdVector<PointId, double> area;                      // m^2, the point's share of the sheet

  // False where there is none, and where it is folded flat: nothing says which way is out of it.
  bool is_sheet_at(PointId p) const {
    constexpr double kFolded = 1e-6;
    return area[p] > 0.0 && normal[p].norm() > kFolded * area[p];
  }
};

Surroundings surroundings_of(const GeometricModel& model) {
  const std::size_t n = model.points.size();
  Surroundings around{IdVector<PointId, std::vector<PointId>>(n),
                      IdVector<PointId, Vec3>(n, Vec3::Zero()), IdVector<PointId, double>(n, 0.0)};
  for (const auto& [a, b] : model.edges) {
    around.neighbours[a].push_back(b);
    around.neighbours[b].push_back(a);
  }
  for (const Face& face : model.faces) {
    const auto& [a, b, c] = face.corners;
    const Vec3 area =
        0.5 * (model.points[b] - model.points[a]).cross(model.points[c] - model.points[a]);
    for (PointId p : face.corners) {
      around.normal[p] += area;
      around.area[p] += area.norm() / 3.0;
    }
  }
  return around;
}

// Two edges that meet in a point and run on in nearly the same direction.
struct Pair {
  PointId a, middle, b;
  double cosine;  // of the turn
};

// The straightest ones first, each edge in one pair at most.
std::vector<Pair> pairs_at(const GeometricModel& model, const Surroundings& around,
                           PointId middle) {
  const std::vector<PointId>& ends = around.neighbours[middle];
  std::vector<Pair> candidates;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    for (std::size_t j = i + 1; j < ends.size(); ++j) {
      const Vec3 in = (model.points[middle] - model.points[ends[i]]).normalized();
      const Vec3 out = (model.points[ends[j]] - model.points[middle]).normalized();
      if (in.dot(out) >= kLeastCosine)
        candidates.push_back({ends[i], middle, ends[j], in.dot(out)});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Pair& p, const Pair& q) { return p.cosine > q.cosine; });
  std::vector<Pair> chosen;
  std::set<PointId> used;
  for (const Pair& pair : candidates) {
    if (used.count(pair.a) > 0 || used.count(pair.b) > 0) continue;
    used.insert({pair.a, pair.b});
    chosen.push_back(pair);
  }
  return chosen;
}

// How far the middle stands out of the sheet over the chord, m.
double rise_of(const GeometricModel& model, const Pair& pair, const Vec3& normal) {
  const Vec3 chord = (model.points[pair.b] - model.points[pair.a]).normalized();
  const Vec3 to_middle = model.points[pair.middle] - model.points[pair.a];
  const Vec3 rise = to_middle - to_middle.dot(chord) * chord;
  return std::abs(rise.dot(normal.normalized()));
}

double mean_edge_length(const GeometricModel& model, const Pair& pair) {
  const Vec3& middle = model.points[pair.middle];
  return 0.5 * ((middle - model.points[pair.a]).norm() + (middle - model.points[pair.b]).norm());
}

// The springs of all pairs at a point. A line of edges that carries the share x of the sheet has
// the stretch stiffness E t x area / h and the bending stiffness (E t^3 / 12) x area / h. Where
// cells are oblong some carry nothing, and get a stiffness of 0.
std::vector<double> stiffnesses(const GeometricModel& model, const std::vector<Pair>& pairs,
                                const Vec3& normal, double area, const BendingSprings& springs) {
  std::vector<Vec3> chords;
  for (const Pair& pair : pairs) chords.push_back(model.points[pair.b] - model.points[pair.a]);
  const Eigen::VectorXd share = isotropic_plane_fit(chords, normal);
  std::vector<double> result;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double h = mean_edge_length(model, pairs[i]);
    const double t = springs.thickness;
    const double stretch =
        springs.youngs_modulus * t * share[static_cast<Eigen::Index>(i)] * area / h;
    const double most = springs.most_added_stretch * stretch / (4.0 * h);
    const double rise = rise_of(model, pairs[i], normal);
    const bool flat = rise == 0.0;
    const double wanted = flat ? most : bending_spring_stiffness(stretch * t * t / 12.0, h, rise);
    result.push_back(std::min(wanted, most));
  }
  return result;
}

// Appended to the model's only subobject.
void add_edge(PhysicalModel& model, const Pair& pair, double stiffness,
              const BendingSprings& springs) {
  const auto [a, b] = std::minmax(pair.a, pair.b);
  EdgeAttributes edge;
  edge.stiffness = stiffness;
  edge.rest_length = (model.geometry.points[b] - model.geometry.points[a]).norm();
  edge.break_threshold = springs.strain_at_break * edge.rest_length;
  edge.crush_threshold = springs.strain_at_crush * edge.rest_length;
  model.geometry.edges.push_back({a, b});
  model.edges.push_back(edge);
  ++model.geometry.subobjects.front().edges.end;
}

void require_usable(const PhysicalModel& sheet, const BendingSprings& springs) {
  require_positive(sheet.name, "Young's modulus", springs.youngs_modulus, "Pa");
  require_positive(sheet.name, "thickness", springs.thickness, "m");
  require_positive(sheet.name, "most added stretch", springs.most_added_stretch, "of the sheet's");
  for (double strain : {springs.strain_at_break, springs.strain_at_crush}) {
    if (strain > 0.0) continue;
    throw InputError({sheet.name, say("the strain at break of its bending springs is ", strain),
                      "give a positive strain or leave it unbreakable"});
  }
  const std::size_t parts = sheet.geometry.subobjects.size();
  if (parts != 1) {
    throw InputError({sheet.name, say("bending springs were asked for in ", parts, " subobjects"),
                      "add them to each part before gluing"});
  }
}

}  // namespace

double bending_spring_stiffness(double bending_stiffness_N_m2, double edge_length_m,
                                double rise_m) {
  return bending_stiffness_N_m2 / (edge_length_m * rise_m * rise_m);
}

int add_bending_springs(PhysicalModel& sheet, const BendingSprings& springs) {
  require_usable(sheet, springs);
  const Surroundings around = surroundings_of(sheet.geometry);
  std::set<std::pair<PointId, PointId>> joined;
  for (const auto& [a, b] : sheet.geometry.edges) joined.insert(std::minmax(a, b));
  int added = 0;
  for (PointId middle : ids_of(sheet.geometry.points)) {
    if (!around.is_sheet_at(middle)) continue;
    const std::vector<Pair> pairs = pairs_at(sheet.geometry, around, middle);
    if (pairs.empty()) continue;
    const std::vector<double> stiffness =
        stiffnesses(sheet.geometry, pairs, around.normal[middle], around.area[middle], springs);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (stiffness[i] <= 0.0) continue;
      if (!joined.insert(std::minmax(pairs[i].a, pairs[i].b)).second) continue;
      add_edge(sheet, pairs[i], stiffness[i], springs);
      ++added;
    }
  }
  return added;
}

}  // namespace limber

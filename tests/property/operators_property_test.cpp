#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <optional>

#include "core/model/validate.h"
#include "core/operators/boundary_operator.h"
#include "core/operators/breaking_operator.h"
#include "core/operators/gluing_operator.h"
#include "core/operators/point_pairs.h"
#include "tests/property/generators.h"
#include "tests/support/blocks.h"
#include "tests/support/measure.h"

// What holds for the operators on any block, any breaks and any glue.

namespace limber {
namespace {

using test::BlockShape;
using test::ids;
using test::random_edges;
using test::random_shape;
using test::random_vector;
using test::try_to_glue;
using test::uniform;

template <class T>
std::vector<T> sorted(std::vector<T> v) {
  std::sort(v.begin(), v.end());
  return v;
}

bool same(const BreakingState& a, const BreakingState& b) {
  return a.edge_broken == b.edge_broken && a.valid_cells == b.valid_cells &&
         a.cell_valid == b.cell_valid && a.face_external == b.face_external;
}

// Deformed at random, so that no symmetry hides a mistake; cells may even be inside out.
RC_GTEST_PROP(BoundaryProperty, IsClosedAndHoldsTheVolumeOfTheValidCells, ()) {
  PhysicalModel m = test::block(random_shape(4));
  for (Vec3& x : m.geometry.points) x += random_vector(0.4);
  break_edges(m, ids(random_edges(m)));
  const SurfaceModel surface = boundary(m);
  RC_ASSERT(test::unmatched_sides(surface) == 0);
  double volume = 0.0;
  for (CellId c : ids_of(m.cells))
    if (m.cells[c].valid) volume += cell_volume(m.geometry, c);
  RC_ASSERT(std::abs(test::enclosed_volume(surface) - volume) < 1e-11);
}

RC_GTEST_PROP(BreakingProperty, KeepsAllInvariants, ()) {
  PhysicalModel m = test::block(random_shape(3));
  break_edges(m, ids(random_edges(m)));
  RC_ASSERT(validate(m).empty());
}

RC_GTEST_PROP(BreakingProperty, DoesNotDependOnTheOrderOfEdges, ()) {
  const PhysicalModel m = test::block(random_shape(4));
  const BreakingTopology topology = breaking_topology(m.geometry);
  BreakingState forward = breaking_state(m, topology), backward = forward;
  std::vector<std::int32_t> edges = random_edges(m);
  const BreakingResult one = break_edges(topology, forward, edges);
  std::reverse(edges.begin(), edges.end());
  const BreakingResult other = break_edges(topology, backward, edges);
  RC_ASSERT(one.broken_edges == other.broken_edges);
  RC_ASSERT(one.invalid_cells == other.invalid_cells);
  RC_ASSERT(one.exposed_faces == other.exposed_faces);
  RC_ASSERT(same(forward, backward));
}

// The incremental third step against the reverse-face rule over the whole model.
RC_GTEST_PROP(BreakingProperty, OneAtATimeEqualsAllAtOnceEqualsFromScratch, ()) {
  PhysicalModel m = test::block(random_shape(4));
  const BreakingTopology topology = breaking_topology(m.geometry);
  BreakingState at_once = breaking_state(m, topology), one_by_one = at_once;
  const std::vector<std::int32_t> edges = random_edges(m);
  std::vector<std::int32_t> broken, invalid;
  for (std::int32_t edge : edges) {
    const BreakingResult r = break_edges(topology, one_by_one, {&edge, 1});
    broken.insert(broken.end(), r.broken_edges.begin(), r.broken_edges.end());
    invalid.insert(invalid.end(), r.invalid_cells.begin(), r.invalid_cells.end());
  }
  const BreakingResult all = break_edges(topology, at_once, edges);
  break_edges(m, ids(edges));
  RC_ASSERT(sorted(broken) == sorted(all.broken_edges));
  RC_ASSERT(sorted(invalid) == sorted(all.invalid_cells));
  RC_ASSERT(same(at_once, one_by_one));
  RC_ASSERT(same(at_once, breaking_state(m, topology)));
}

// What is reported is what changed: each once, nothing else.
RC_GTEST_PROP(BreakingProperty, ReportsExactlyTheChanges, ()) {
  const PhysicalModel m = test::block(random_shape(4));
  const BreakingTopology topology = breaking_topology(m.geometry);
  BreakingState state = breaking_state(m, topology);
  break_edges(topology, state, random_edges(m));
  const BreakingState before = state;
  const BreakingResult r = break_edges(topology, state, random_edges(m));
  std::vector<std::int32_t> edges, cells, faces;
  for (std::size_t i = 0; i < state.edge_broken.size(); ++i)
    if (state.edge_broken[i] && !before.edge_broken[i]) edges.push_back(std::int32_t(i));
  for (std::size_t i = 0; i < state.cell_valid.size(); ++i)
    if (!state.cell_valid[i] && before.cell_valid[i]) cells.push_back(std::int32_t(i));
  for (std::size_t i = 0; i < state.face_external.size(); ++i)
    if (state.face_external[i] && !before.face_external[i]) faces.push_back(std::int32_t(i));
  RC_ASSERT(sorted(r.broken_edges) == edges);
  RC_ASSERT(sorted(r.invalid_cells) == cells);
  RC_ASSERT(sorted(r.exposed_faces) == faces);
}

RC_GTEST_PROP(BreakingProperty, SheetsLoseTheSameFacesStepByStep, ()) {
  PhysicalModel m = test::sheet(*rc::gen::inRange(1, 5), *rc::gen::arbitrary<bool>());
  const BreakingTopology topology = breaking_topology(m.geometry);
  BreakingState state = breaking_state(m, topology);
  const std::vector<std::int32_t> edges = random_edges(m);
  for (std::int32_t edge : edges) break_edges(topology, state, {&edge, 1});
  break_edges(m, ids(edges));
  RC_ASSERT(same(state, breaking_state(m, topology)));
  const auto seen = std::count(state.face_external.begin(), state.face_external.end(), 1);
  RC_ASSERT(static_cast<std::size_t>(seen) == boundary(m).triangles.size());
}

std::size_t pairs_counted_one_by_one(const PhysicalModel& a, const PhysicalModel& b,
                                     double distance) {
  std::size_t n = 0;
  for (const Vec3& x : a.geometry.points)
    for (const Vec3& y : b.geometry.points)
      n += (x - y).norm() <= distance + distance_rounding(x, y);
  return n;
}

RC_GTEST_PROP(GluingProperty, KeepsAllInvariantsAndFindsAllPairs, ()) {
  BlockShape shape = random_shape(3);
  PhysicalModel a = test::block(shape);
  const Vec3 beside(shape.cells[0] + 0.5, 0.0, 0.0);
  shape = random_shape(3);
  shape.spacing = uniform(0.2, 2.0);
  shape.origin = beside + random_vector(1.0);
  const PhysicalModel b = test::block(shape);
  break_edges(a, ids(random_edges(a)));
  const GlueBond bond{.distance = uniform(0.05, 2.0), .stiffness = 5, .break_strain = 0.3};
  const std::size_t expected = pairs_counted_one_by_one(a, b, bond.distance);
  const std::optional<GlueResult> glued = try_to_glue(a, b, bond);
  RC_CLASSIFY(expected > 0, "glued");
  RC_ASSERT(glued.has_value() == (expected > 0));
  if (!glued) return;
  RC_ASSERT(glued->bonds == expected);
  RC_ASSERT(glued->model.edges.size() == a.edges.size() + b.edges.size() + expected);
  RC_ASSERT(validate(glued->model).empty());
  const auto volume = test::enclosed_volume(boundary(glued->model));
  const auto parts = test::enclosed_volume(boundary(a)) + test::enclosed_volume(boundary(b));
  RC_ASSERT(std::abs(volume - parts) < 1e-9);
}

PointPositions random_cloud() {
  PointPositions points;
  const Vec3 centre = random_vector(5.0);
  const double size = uniform(0.0, 4.0);
  const int n = *rc::gen::inRange(1, 30);
  for (int i = 0; i < n; ++i) points.push_back(centre + random_vector(size));
  return points;
}

RC_GTEST_PROP(PointPairsProperty, AgreeWithAllPairs, ()) {
  const PointPositions a = random_cloud(), b = random_cloud();
  const double distance = uniform(0.0, 3.0);
  std::vector<std::pair<PointId, PointId>> expected;
  double nearest = 1e300;
  for (PointId p : ids_of(a))
    for (PointId q : ids_of(b)) {
      nearest = std::min(nearest, (a[p] - b[q]).norm());
      if ((a[p] - b[q]).norm() <= distance + distance_rounding(a[p], b[q]))
        expected.push_back({p, q});
    }
  std::vector<std::pair<PointId, PointId>> found;
  for (const PointPair& pair : pairs_within(a, b, distance)) found.push_back({pair.a, pair.b});
  RC_ASSERT(found == expected);
  RC_ASSERT(nearest_pair(a, b).distance == nearest);
}

}  // namespace
}  // namespace limber

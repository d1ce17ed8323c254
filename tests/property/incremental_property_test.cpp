#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <random>

#include "core/contact/point_contacts.h"
#include "core/dynamics/component_tracker.h"
#include "core/operators/boundary_operator.h"
#include "core/operators/boundary_tracker.h"
#include "tests/support/blocks.h"
#include "tests/support/lattices.h"
#include "tests/support/measure.h"
#include "tests/support/partition.h"

// What is kept up to date while edges break equals what is found from scratch, after every step of
// random sequences.

namespace limber {
namespace {

using Edges = std::vector<std::int32_t>;

// Points joined at random: forests, rings and isolated points, seldom dense.
PhysicalModel random_graph() {
  const int points = *rc::gen::inRange(1, 40);
  GeometricModelBuilder builder;
  builder.begin_subobject("graph");
  for (int i = 0; i < points; ++i) builder.add_point({1.0 * i, 0.5 * i * i, 0.0});
  const int edges = points > 1 ? *rc::gen::inRange(0, 2 * points) : 0;
  for (int i = 0; i < edges; ++i) {
    const int a = *rc::gen::inRange(0, points), b = *rc::gen::inRange(0, points);
    if (a != b) builder.edge(PointId(std::size_t(a)), PointId(std::size_t(b)));
  }
  return test::with_plausible_attributes(builder.finish(), "graph");
}

PhysicalModel random_block(int least_cells = 1) {
  test::BlockShape shape;
  for (int& n : shape.cells) n = *rc::gen::inRange(least_cells, 5);
  shape.edges.both_diagonals = *rc::gen::arbitrary<bool>();
  shape.edges.body_diagonals = *rc::gen::arbitrary<bool>();
  return test::block(shape);
}

PhysicalModel random_model() {
  switch (*rc::gen::inRange(0, 4)) {
    case 0:
      return random_graph();
    case 1:
      return test::chain({.points = *rc::gen::inRange(2, 30)});
    case 2:
      return test::sheet(*rc::gen::inRange(1, 6), *rc::gen::arbitrary<bool>());
    default:
      return random_block();
  }
}

Lattice random_lattice() {
  std::vector<PhysicalModel> models = {random_model()};
  if (*rc::gen::arbitrary<bool>()) models.push_back(random_model());
  return test::lattice_of(std::move(models));
}

Edges random_edges(const Lattice& lattice, int most) {
  Edges edges;
  if (lattice.springs.empty()) return edges;
  const int count = *rc::gen::inRange(1, most + 1);
  for (int i = 0; i < count; ++i) {
    edges.push_back(*rc::gen::inRange(0, static_cast<int>(lattice.springs.size())));
  }
  return edges;
}

BreakingResult break_in(Lattice& lattice, const Edges& edges) {
  return break_edges(lattice.topology, lattice.breaking, edges);
}

RC_GTEST_PROP(ComponentTrackerProperty, EqualsComponentsAfterEveryBreak, ()) {
  Lattice lattice = random_lattice();
  ComponentTracker tracker;
  tracker.reset(lattice);
  for (int n = 0; n < 12; ++n) {
    const std::int32_t before = tracker.components().count;
    const BreakingResult result = break_in(lattice, random_edges(lattice, 6));
    const auto splits = tracker.edges_broken(lattice, result.broken_edges);
    RC_ASSERT(test::smallest_in_piece(tracker.components()) ==
              test::smallest_in_piece(components(lattice)));
    RC_ASSERT(tracker.sizes() == test::sizes_of(tracker.components()));
    RC_ASSERT(tracker.components().count == before + std::ssize(splits));
    for (const auto& split : splits) RC_ASSERT(split.from < split.to);
  }
}

RC_GTEST_PROP(ComponentTrackerProperty, PartitionDoesNotDependOnTheOrder, ()) {
  Lattice lattice = random_lattice();
  ComponentTracker forward, shuffled, one_by_one;
  for (ComponentTracker* tracker : {&forward, &shuffled, &one_by_one}) tracker->reset(lattice);
  Edges broken = break_in(lattice, random_edges(lattice, 40)).broken_edges;
  forward.edges_broken(lattice, broken);
  for (std::size_t i = broken.size(); i > 1; --i) {
    std::swap(broken[i - 1], broken[*rc::gen::inRange(std::size_t{0}, i)]);
  }
  shuffled.edges_broken(lattice, broken);
  RC_ASSERT(test::smallest_in_piece(forward.components()) ==
            test::smallest_in_piece(shuffled.components()));
  RC_ASSERT(test::smallest_in_piece(forward.components()) ==
            test::smallest_in_piece(components(lattice)));
}

// The part that keeps its label has at least as many edges looked at: of a rope, at least as many
// points.
RC_GTEST_PROP(ComponentTrackerProperty, NeverTakesTheLargerPartOfARopeOff, ()) {
  const int points = *rc::gen::inRange(2, 60);
  Lattice lattice = test::lattice_of({test::chain({.points = points})});
  ComponentTracker tracker;
  tracker.reset(lattice);
  const auto edge = static_cast<std::int32_t>(*rc::gen::inRange(0, points - 1));
  const auto splits = tracker.edges_broken(lattice, break_in(lattice, {edge}).broken_edges);
  RC_ASSERT(splits.size() == 1u);
  RC_ASSERT(tracker.sizes()[1] == std::min(edge + 1, points - edge - 1));
}

RC_GTEST_PROP(BoundaryTrackerProperty, EqualsBoundaryAfterEveryBreak, ()) {
  Lattice lattice = random_lattice();
  BoundaryTracker tracker;
  tracker.reset(lattice.breaking);
  for (int n = 0; n < 8; ++n) {
    tracker.update(lattice.topology, break_in(lattice, random_edges(lattice, 4)));
    std::size_t all = 0;
    for (std::size_t o = 0; o < lattice.objects.size(); ++o) {
      std::vector<FaceId> expected;
      const PhysicalModel now = extract_model(lattice, o);
      for (const SurfaceTriangle& t : boundary(now).triangles) expected.push_back(t.source);
      RC_ASSERT(tracker.faces_of(lattice.objects[o].faces) == expected);
      all += expected.size();
    }
    RC_ASSERT(tracker.faces().size() == all);
  }
}

RC_GTEST_PROP(BoundaryTrackerProperty, SurfaceOfABlockStaysClosed, ()) {
  Lattice lattice = test::lattice_of({random_block()});
  BoundaryTracker tracker;
  tracker.reset(lattice.breaking);
  for (int n = 0; n < 6; ++n) {
    tracker.update(lattice.topology, break_in(lattice, random_edges(lattice, 3)));
    const SurfaceModel surface =
        tracker.surface(lattice.objects[0].authored, lattice.topology, lattice.objects[0].faces);
    const PhysicalModel now = extract_model(lattice, 0);
    double volume = 0.0;
    for (CellId c : ids_of(now.cells))
      if (now.cells[c].valid) volume += cell_volume(now.geometry, c);
    RC_ASSERT(test::unmatched_sides(surface) == 0);
    RC_ASSERT(std::abs(test::enclosed_volume(surface) - volume) < 1e-11);
  }
}

bool same(const PointContacts::Pairs& one, const PointContacts::Pairs& other) {
  return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                    [](const PointContacts::Pair& l, const PointContacts::Pair& r) {
                      return l.a == r.a && l.b == r.b && l.reduced_mass == r.reduced_mass &&
                             l.contact_distance == r.contact_distance &&
                             l.law.frequency == r.law.frequency &&
                             l.law.restitution == r.law.restitution;
                    });
}

// A block squashed and a little deformed: at 0.9 of their spacing and below pairs overlap when they
// are found and begin without force. No edge is stretched beyond the list's reach (1.8 m; a body
// diagonal is 1.73 m), where inserting lists what listing anew leaves out.
RC_GTEST_PROP(PointContactsProperty, InsertingEqualsListingAnew, ()) {
  Lattice lattice = test::lattice_of({random_block(3)});  // breaks inside leave it whole
  std::mt19937 random(*rc::gen::arbitrary<unsigned>());
  const double squash = 1e-2 * *rc::gen::inRange(80, 101);
  for (PointMotion& point : lattice.motion) {
    point.position = squash * point.position + test::random_vector(random, 0.015);
  }
  PointContacts inserted;
  ComponentTracker pieces;
  pieces.reset(lattice);
  inserted.refresh(lattice, pieces.components(), true, false);
  PointContacts anew = inserted;
  int compared = 0;
  for (int n = 0; n < 4; ++n) {
    const BreakingResult result = break_in(lattice, random_edges(lattice, 1));
    if (result.broken_edges.empty()) continue;
    if (!pieces.edges_broken(lattice, result.broken_edges).empty()) break;
    const std::size_t before = inserted.size();
    inserted.edges_broken(lattice, result.broken_edges);
    RC_ASSERT(inserted.size() == before + result.broken_edges.size());
    inserted.refresh(lattice, pieces.components(), false, false);
    for (int i = 0; i < 4; ++i) anew.refresh(lattice, pieces.components(), true, false);
    RC_ASSERT(same(inserted.within(), anew.within()));
    ++compared;
  }
  RC_CLASSIFY(compared > 0, "compared");
}

}  // namespace
}  // namespace limber

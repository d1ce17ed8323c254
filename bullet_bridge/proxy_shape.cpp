#include "bullet_bridge/proxy_shape.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <LinearMath/btConvexHullComputer.h>

#include <algorithm>
#include <set>

#include "bullet_bridge/conversions.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

// A hull of more than this many times the material in it is split. Above the 1.6 or so of a curved
// shard, below the 4 of a bowl.
constexpr double kHollow = 2.5;
constexpr int kMostSplits = 3;            // halvings, so at most 8 hulls
constexpr std::size_t kFewestItems = 6;   // a hull of fewer cells is never split
constexpr double kMarginShare = 0.1;      // of the smallest half extent
constexpr double kLargestMargin = 0.04;   // m, Bullet's default
constexpr double kSmallestExtent = 1e-4;  // m, of the box that stands for a flat hull
constexpr double kBoxTolerance = 1e-3;    // of the smallest half extent, to count as a box

// Bullet keeps a contact point from tick to tick while it moves less than 2 % of the shape's size.
// A shard of 3 cm falls farther than that within a tick (g dt^2 = 2.7 mm at 1/60 s against 0.6 mm):
// it would rest on one point at a time and rock itself into the ground.
constexpr double kLeastContactBreaking = 0.005;  // m

template <class Shape>
class Shard : public Shape {
 public:
  using Shape::Shape;
  btScalar getContactBreakingThreshold(btScalar share) const override {
    return std::max(Shape::getContactBreakingThreshold(share),
                    static_cast<btScalar>(kLeastContactBreaking));
  }
};

using Items = std::span<ShapeItem>;

Vec3 centre_of(const ShapeItem& item) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : item.points) sum += p;
  return sum / static_cast<double>(item.points.size());
}

struct Box {
  Vec3 low = Vec3::Constant(1e30), high = Vec3::Constant(-1e30);
  void add(const Vec3& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); }
  Vec3 half() const { return 0.5 * (high - low); }
  Vec3 middle() const { return 0.5 * (high + low); }
};

Box bounds(Items items) {
  Box box;
  for (const ShapeItem& item : items) {
    for (const Vec3& p : item.points) box.add(p);
  }
  return box;
}

// Directions of the 3 x 3 x 3 neighbourhood and the halves between them: 62 of them find the
// corners of a shard to a few per cent of its size; exact hulls of a thousand points cost
// milliseconds.
std::vector<Vec3> support_directions() {
  std::vector<Vec3> directions;
  for (int x = -2; x <= 2; ++x) {
    for (int y = -2; y <= 2; ++y) {
      for (int z = -2; z <= 2; ++z) {
        const int largest = std::max({std::abs(x), std::abs(y), std::abs(z)});
        if (largest == 2) directions.push_back(Vec3(x, y, z).normalized());
      }
    }
  }
  return directions;
}

std::vector<btVector3> outermost_points(Items items) {
  static const std::vector<Vec3> directions = support_directions();
  std::vector<const Vec3*> best(directions.size(), nullptr);
  for (const ShapeItem& item : items) {
    for (const Vec3& p : item.points) {
      for (std::size_t d = 0; d < directions.size(); ++d) {
        if (!best[d] || directions[d].dot(p) > directions[d].dot(*best[d])) best[d] = &p;
      }
    }
  }
  const auto by_coordinates = [](const Vec3* l, const Vec3* r) {
    return std::lexicographical_compare(l->data(), l->data() + 3, r->data(), r->data() + 3);
  };
  const std::set<const Vec3*, decltype(by_coordinates)> unique(best.begin(), best.end(),
                                                               by_coordinates);
  std::vector<btVector3> points;
  for (const Vec3* p : unique) points.push_back(to_bullet(*p));
  return points;
}

double hull_volume(btConvexHullComputer& hull) {
  double six_volumes = 0.0;
  for (int f = 0; f < hull.faces.size(); ++f) {
    const btConvexHullComputer::Edge* first = &hull.edges[hull.faces[f]];
    const Vec3 a = from_bullet(hull.vertices[first->getSourceVertex()]);
    for (const auto* e = first->getNextEdgeOfFace(); e != first; e = e->getNextEdgeOfFace()) {
      const Vec3 b = from_bullet(hull.vertices[e->getSourceVertex()]);
      const Vec3 c = from_bullet(hull.vertices[e->getTargetVertex()]);
      six_volumes += a.dot(b.cross(c));
    }
  }
  return std::abs(six_volumes) / 6.0;
}

double material_volume(Items items) {
  double volume = 0.0;
  for (const ShapeItem& item : items) volume += item.volume;
  return volume;
}

// A hull that has no volume to shrink becomes a thin box.
std::unique_ptr<btCollisionShape> flat_box(Items items, btTransform& pose) {
  const Box box = bounds(items);
  const Vec3 half = box.half().cwiseMax(kSmallestExtent);
  auto shape = std::make_unique<btBoxShape>(to_bullet(half));
  shape->setMargin(static_cast<btScalar>(std::min(kLargestMargin, 0.1 * half.minCoeff())));
  pose.setOrigin(to_bullet(box.middle()));
  return shape;
}

// Do the points fill a box about the body's centre, along its axes? Bullet is faster with boxes,
// and finds all corners of a contact at once. What is turned about those axes, as a cube may be
// that was dented, stays a hull.
bool is_box(std::span<const btVector3> points, const Box& box) {
  const double tolerance = kBoxTolerance * box.half().minCoeff();
  if (tolerance <= kBoxTolerance * kSmallestExtent) return false;  // flat
  if (box.middle().cwiseAbs().maxCoeff() > tolerance) return false;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 sign(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0);
    const Vec3 place = sign.cwiseProduct(box.half());
    const auto is_there = [&](const btVector3& p) {
      return (from_bullet(p) - place).cwiseAbs().maxCoeff() <= tolerance;
    };
    if (std::none_of(points.begin(), points.end(), is_there)) return false;
  }
  return true;
}

std::unique_ptr<btCollisionShape> shrunk_hull(Items items, btTransform& pose) {
  pose.setIdentity();
  const std::vector<btVector3> points = outermost_points(items);
  const Box box = bounds(items);
  if (is_box(points, box)) return std::make_unique<Shard<btBoxShape>>(to_bullet(box.half()));
  const double wanted = std::min(kLargestMargin, kMarginShare * box.half().minCoeff());
  btConvexHullComputer hull;
  const btScalar margin =
      hull.compute(&points[0].m_floats[0], sizeof(btVector3), static_cast<int>(points.size()),
                   static_cast<btScalar>(wanted), btScalar(0.5));
  if (points.size() < 4 || hull.vertices.size() < 4 || margin <= 0) return flat_box(items, pose);
  auto shape = std::make_unique<Shard<btConvexHullShape>>();
  shape->setMargin(margin);
  for (int i = 0; i < hull.vertices.size(); ++i) shape->addPoint(hull.vertices[i], false);
  shape->recalcLocalAabb();
  return shape;
}

bool is_hollow(Items items) {
  const std::vector<btVector3> points = outermost_points(items);
  btConvexHullComputer hull;
  hull.compute(&points[0].m_floats[0], sizeof(btVector3), static_cast<int>(points.size()), 0, 0);
  return hull_volume(hull) > kHollow * material_volume(items);
}

// Sorts the items by their centres along the longest extent.
void sort_along_longest_extent(Items items) {
  int axis = 0;
  bounds(items).half().maxCoeff(&axis);
  std::stable_sort(items.begin(), items.end(), [axis](const ShapeItem& l, const ShapeItem& r) {
    return centre_of(l)[axis] < centre_of(r)[axis];
  });
}

void split_into_hulls(Items items, int splits, std::vector<Items>& groups) {
  const bool split = splits > 0 && items.size() >= 2 * kFewestItems && is_hollow(items);
  if (!split) {
    groups.push_back(items);
    return;
  }
  sort_along_longest_extent(items);
  const std::size_t half = items.size() / 2;
  split_into_hulls(items.first(half), splits - 1, groups);
  split_into_hulls(items.subspan(half), splits - 1, groups);
}

}  // namespace

ProxyShape::ProxyShape() = default;
ProxyShape::~ProxyShape() {
  while (!parts_.empty()) parts_.pop_back();  // the compound before its children
}
ProxyShape::ProxyShape(ProxyShape&&) noexcept = default;
ProxyShape& ProxyShape::operator=(ProxyShape&&) noexcept = default;

ProxyShape fit_proxy_shape(std::vector<ShapeItem> items) {
  std::vector<Items> groups;
  split_into_hulls(items, kMostSplits, groups);
  ProxyShape result;
  auto compound = std::make_unique<btCompoundShape>();
  for (Items group : groups) {
    btTransform pose;
    pose.setIdentity();
    result.parts_.push_back(shrunk_hull(group, pose));
    compound->addChildShape(pose, result.parts_.back().get());
  }
  const bool alone =
      groups.size() == 1 && compound->getChildTransform(0) == btTransform::getIdentity();
  if (!alone) result.parts_.push_back(std::move(compound));
  return result;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet

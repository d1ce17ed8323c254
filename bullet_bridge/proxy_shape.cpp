#include "bullet_bridge/proxy_shape.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "bullet_bridge/conversions.h"
#include "bullet_bridge/convex_hull.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

// A hull of more than this many times the material in it is split. Above the 1.6 or so of a curved
// shard, below the 4 of a bowl.
constexpr double kHollow = 2.5;
constexpr int kMostSplits = 3;                // halvings, so at most 8 hulls
constexpr std::size_t kFewestParts = 6;       // a hull of fewer cells is never split
constexpr double kMarginShare = 0.1;          // of the smallest half extent
constexpr double kMarginShareOfInside = 0.5;  // of the inner radius: what is inset keeps an inside
constexpr double kLargestMargin = 0.04;       // m, Bullet's default
constexpr double kSmallestExtent = 1e-4;      // m, of the box that stands for a flat hull
constexpr double kFlatShare = 1e-6;     // inner radius by largest half extent: Bullet's rounding
constexpr double kBoxTolerance = 1e-3;  // of the smallest half extent, to count as a box

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

struct Box {
  Vec3 low = Vec3::Constant(1e30), high = Vec3::Constant(-1e30);
  void add(const Vec3& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); }
  Vec3 half() const { return 0.5 * (high - low); }
  Vec3 middle() const { return 0.5 * (high + low); }
};

// ---- outlines ----------------------------------------------------------------------------------

// Do the points fill a box about the body's centre, along its axes? Bullet is faster with boxes,
// and finds all corners of a contact at once. What is turned about those axes, as a cube may be
// that was dented, stays a hull.
bool fill_box(const std::vector<Vec3>& points, const Box& box) {
  const double tolerance = kBoxTolerance * box.half().minCoeff();
  if (tolerance <= kBoxTolerance * kSmallestExtent) return false;  // flat
  if (box.middle().cwiseAbs().maxCoeff() > tolerance) return false;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 sign(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0);
    const Vec3 place = sign.cwiseProduct(box.half());
    const auto is_there = [&](const Vec3& p) {
      return (p - place).cwiseAbs().maxCoeff() <= tolerance;
    };
    if (std::none_of(points.begin(), points.end(), is_there)) return false;
  }
  return true;
}

// What a set of points looks like from outside: a box, or else a convex hull.
struct Outline {
  Box box;
  std::optional<ConvexHull> hull;  // none for a box
  double volume = 0.0;             // m^3
};

bool is_flat(const Outline& outline) {
  return outline.hull && outline.hull->inner_radius() <= kFlatShare * outline.box.half().maxCoeff();
}

Outline outline_of(std::span<const Vec3> points) {
  Outline outline;
  for (const Vec3& p : points) outline.box.add(p);
  std::vector<Vec3> farthest;
  for (std::int32_t p : outermost(points)) farthest.push_back(points[p]);
  if (fill_box(farthest, outline.box)) {
    outline.volume = 8.0 * outline.box.half().prod();
  } else {
    outline.hull = convex_hull(farthest);
    // What is low may hide behind its rim in every direction that is looked in.
    if (is_flat(outline)) outline.hull = convex_hull(points);
    outline.volume = outline.hull->volume;
  }
  return outline;
}

bool is_hollow(const Outline& outline, double material_volume) {
  return outline.volume > kHollow * material_volume;
}

// ---- shapes ------------------------------------------------------------------------------------

// A hull that has no volume to shrink becomes a thin box.
std::unique_ptr<btCollisionShape> flat_box(const Box& box, btTransform& pose) {
  const Vec3 half = box.half().cwiseMax(kSmallestExtent);
  auto shape = std::make_unique<btBoxShape>(to_bullet(half));
  shape->setMargin(static_cast<btScalar>(std::min(kLargestMargin, 0.1 * half.minCoeff())));
  pose.setOrigin(to_bullet(box.middle()));
  return shape;
}

std::unique_ptr<btCollisionShape> shape_of(const Outline& outline, btTransform& pose) {
  const Vec3 half = outline.box.half();
  if (!outline.hull) return std::make_unique<Shard<btBoxShape>>(to_bullet(half));
  if (is_flat(outline)) return flat_box(outline.box, pose);
  const double inside = outline.hull->inner_radius();
  const double margin =
      std::min({kLargestMargin, kMarginShare * half.minCoeff(), kMarginShareOfInside * inside});
  auto shape = std::make_unique<Shard<btConvexHullShape>>();
  shape->setMargin(static_cast<btScalar>(margin));
  for (const Vec3& corner : inset_corners(*outline.hull, margin)) {
    shape->addPoint(to_bullet(corner), false);
  }
  shape->recalcLocalAabb();
  return shape;
}

// ---- several hulls -----------------------------------------------------------------------------

class Splitter {
 public:
  Splitter(const ShapeMaterial& material, const ShapeParts& parts)
      : material_(material), parts_(parts), seen_(material.points.size(), 0) {
    for (std::size_t part = 0; part < parts.points.rows(); ++part) {
      centres_.push_back(centre_of(part));
    }
  }

  // Halves the parts, and what is still hollow of them again.
  void split(std::span<std::int32_t> group, int splits) {
    sort_along_longest_extent(group);
    const std::size_t half = group.size() / 2;
    take(group.first(half), splits - 1);
    take(group.subspan(half), splits - 1);
  }

  std::vector<Outline> outlines;

 private:
  void take(std::span<std::int32_t> group, int splits) {
    Outline outline = outline_of(points_of(group));
    if (splits > 0 && group.size() >= 2 * kFewestParts && is_hollow(outline, volume_of(group))) {
      split(group, splits);
    } else {
      outlines.push_back(std::move(outline));
    }
  }

  Vec3 centre_of(std::size_t part) const {
    Vec3 sum = Vec3::Zero();
    for (std::int32_t p : parts_.points[part]) sum += material_.points[p];
    return sum / static_cast<double>(parts_.points[part].size());
  }

  double volume_of(std::span<const std::int32_t> group) const {
    double volume = 0.0;
    for (std::int32_t part : group) volume += parts_.volumes[part];
    return volume;
  }

  std::vector<Vec3> points_of(std::span<const std::int32_t> group) {
    ++round_;
    std::vector<Vec3> points;
    for (std::int32_t part : group) {
      for (std::int32_t p : parts_.points[part]) {
        if (std::exchange(seen_[p], round_) != round_) points.push_back(material_.points[p]);
      }
    }
    return points;
  }

  void sort_along_longest_extent(std::span<std::int32_t> group) {
    Box box;
    for (const Vec3& p : points_of(group)) box.add(p);
    int axis = 0;
    box.half().maxCoeff(&axis);
    std::stable_sort(group.begin(), group.end(), [&](std::int32_t l, std::int32_t r) {
      return centres_[l][axis] < centres_[r][axis];
    });
  }

  const ShapeMaterial& material_;
  const ShapeParts& parts_;
  std::vector<Vec3> centres_;  // shape (parts), m
  std::vector<int> seen_;      // shape (points): in which round last
  int round_ = 0;
};

std::vector<Outline> outlines_of(const ShapeMaterial& material) {
  std::vector<Outline> outlines;
  Outline whole = outline_of(material.points);
  if (material.parts < 2 * kFewestParts || !is_hollow(whole, material.volume)) {
    outlines.push_back(std::move(whole));
    return outlines;
  }
  const ShapeParts parts = material.list_parts();
  std::vector<std::int32_t> all(parts.points.rows());
  std::iota(all.begin(), all.end(), 0);
  Splitter splitter(material, parts);
  splitter.split(all, kMostSplits);
  return std::move(splitter.outlines);
}

}  // namespace

ProxyShape::ProxyShape() = default;
ProxyShape::~ProxyShape() {
  while (!parts_.empty()) parts_.pop_back();  // the compound before its children
}
ProxyShape::ProxyShape(ProxyShape&&) noexcept = default;
ProxyShape& ProxyShape::operator=(ProxyShape&&) noexcept = default;

ProxyShape fit_proxy_shape(const ShapeMaterial& material) {
  ProxyShape result;
  auto compound = std::make_unique<btCompoundShape>();
  for (const Outline& outline : outlines_of(material)) {
    btTransform pose;
    pose.setIdentity();
    result.parts_.push_back(shape_of(outline, pose));
    compound->addChildShape(pose, result.parts_.back().get());
  }
  const bool alone = compound->getNumChildShapes() == 1 &&
                     compound->getChildTransform(0) == btTransform::getIdentity();
  if (!alone) result.parts_.push_back(std::move(compound));
  return result;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet

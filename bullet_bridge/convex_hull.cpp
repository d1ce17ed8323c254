#include "bullet_bridge/convex_hull.h"

#include <LinearMath/btConvexHullComputer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "bullet_bridge/conversions.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

// ---- outermost points --------------------------------------------------------------------------

// Of each pair of opposite directions one.
std::vector<Vec3> support_directions() {
  std::vector<Vec3> directions;
  for (int x = -2; x <= 2; ++x) {
    for (int y = -2; y <= 2; ++y) {
      for (int z = -2; z <= 2; ++z) {
        const bool first_of_pair = x > 0 || (x == 0 && (y > 0 || (y == 0 && z > 0)));
        const int largest = std::max({x, std::abs(y), std::abs(z)});
        if (first_of_pair && largest == 2) directions.push_back(Vec3(x, y, z).normalized());
      }
    }
  }
  return directions;
}

// How far each point reaches along a direction: a component of theirs a column. Single precision
// finds one that sticks out as far as any, to its rounding.
class Columns {
 public:
  explicit Columns(std::span<const Vec3> points) : points_(points.size(), 3) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      points_.row(static_cast<Eigen::Index>(i)) = points[i].cast<float>().transpose();
    }
  }

  // Appends which points lie farthest along the direction and against it.
  void find_farthest(const Vec3& direction, std::vector<std::int32_t>& found) {
    const Eigen::Vector3f d = direction.cast<float>();
    reach_ = d.x() * points_.col(0) + d.y() * points_.col(1) + d.z() * points_.col(2);
    found.push_back(first_at(reach_.maxCoeff()));
    found.push_back(first_at(reach_.minCoeff()));
  }

 private:
  std::int32_t first_at(float reach) const {
    return static_cast<std::int32_t>(std::find(reach_.begin(), reach_.end(), reach) -
                                     reach_.begin());
  }

  Eigen::ArrayX3f points_;
  Eigen::ArrayXf reach_;
};

// ---- sides -------------------------------------------------------------------------------------

using Hull = btConvexHullComputer;

// Twice the area of the side, along its normal; to the volume it adds six times that of the pyramid
// from `apex`.
Vec3 measure_side(const Hull& hull, int side, const std::vector<Vec3>& corners, const Vec3& apex,
                  double& six_volumes) {
  Vec3 area = Vec3::Zero();
  const Hull::Edge* first = &hull.edges[hull.faces[side]];
  const Vec3& a = corners[first->getSourceVertex()];
  for (const auto* e = first->getNextEdgeOfFace(); e != first; e = e->getNextEdgeOfFace()) {
    area += (corners[e->getSourceVertex()] - a).cross(corners[e->getTargetVertex()] - a);
  }
  six_volumes += (a - apex).dot(area);
  return area;
}

Vec3 mean_of(const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

// How far a place reaches along the normals of all sides at once.
class Reach {
 public:
  explicit Reach(std::span<const HalfSpace> sides)
      : normals_(sides.size(), 3), reach_(sides.size()) {
    for (std::size_t i = 0; i < sides.size(); ++i) {
      normals_.row(static_cast<Eigen::Index>(i)) = sides[i].normal.transpose();
    }
  }

  const Eigen::ArrayXd& of(const Vec3& place) {
    reach_ =
        place.x() * normals_.col(0) + place.y() * normals_.col(1) + place.z() * normals_.col(2);
    return reach_;
  }

 private:
  Eigen::ArrayX3d normals_;
  Eigen::ArrayXd reach_;
};

// Moves the planes of the sides to where they touch the hull. Of slivers the normal is anything
// between those of their neighbours: such a plane says nothing that theirs do not say, but nothing
// wrong either.
void touch(std::span<HalfSpace> sides, std::span<const Vec3> corners) {
  Reach reach(sides);
  Eigen::ArrayXd farthest = reach.of(corners[0]);
  for (const Vec3& corner : corners) farthest = farthest.max(reach.of(corner));
  for (std::size_t i = 0; i < sides.size(); ++i) {
    sides[i].distance = farthest[static_cast<Eigen::Index>(i)];
  }
}

}  // namespace

std::vector<std::int32_t> outermost(std::span<const Vec3> points) {
  static const std::vector<Vec3> directions = support_directions();
  Columns columns(points);
  std::vector<std::int32_t> found;
  for (const Vec3& direction : directions) columns.find_farthest(direction, found);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

double ConvexHull::inner_radius() const {
  if (sides.empty()) return 0.0;
  const Vec3 middle = mean_of(corners);
  double least = -sides[0].excess(middle);
  for (const HalfSpace& side : sides) least = std::min(least, -side.excess(middle));
  return std::max(0.0, least);
}

ConvexHull convex_hull(std::span<const Vec3> points) {
  std::vector<btVector3> input;
  for (const Vec3& p : points) input.push_back(to_bullet(p));
  Hull computer;
  computer.compute(&input[0].m_floats[0], sizeof(btVector3), static_cast<int>(input.size()), 0, 0);
  ConvexHull hull;
  // Bullet's own corners lie on a grid of a ten-thousandth of the size.
  for (int i = 0; i < computer.vertices.size(); ++i) {
    hull.corners.push_back(points[computer.original_vertex_index[i]]);
  }
  if (hull.corners.size() < 4) return hull;
  double six_volumes = 0.0;
  for (int f = 0; f < computer.faces.size(); ++f) {
    const Vec3 area = measure_side(computer, f, hull.corners, hull.corners[0], six_volumes);
    const double size = area.norm();
    if (size > 0.0) hull.sides.push_back({area / size});
  }
  touch(hull.sides, hull.corners);
  hull.volume = std::abs(six_volumes) / 6.0;
  return hull;
}

std::vector<Vec3> inset_corners(const ConvexHull& hull, double depth) {
  constexpr double kSlackShare = 1e-6;  // of the depth
  constexpr double kUsualWay = 2.0;     // of a corner, in depths: a cube's is sqrt(3)
  constexpr double kSame = 1e-3;        // of the depth: so near one another corners are one
  const double slack = kSlackShare * depth;
  std::vector<HalfSpace> all = hull.sides, near;
  for (HalfSpace& side : all) side.distance -= depth;
  Reach reach(all);
  Eigen::ArrayXd near_from(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    near_from[static_cast<Eigen::Index>(i)] = all[i].distance - kUsualWay * depth;
  }
  std::vector<std::size_t> picked(all.size());
  std::vector<Vec3> moved;
  for (const Vec3& corner : hull.corners) {
    const Eigen::ArrayXd& reached = reach.of(corner);
    std::size_t count = 0;  // no branch: it could not be foreseen
    for (std::size_t i = 0; i < all.size(); ++i) {
      picked[count] = i;
      count += reached.data()[i] > near_from.data()[i] ? 1 : 0;
    }
    near.clear();
    for (std::size_t i = 0; i < count; ++i) near.push_back(all[picked[i]]);
    Vec3 place = nearest_within(corner, near, slack);
    if ((place - corner).norm() > kUsualWay * depth) place = nearest_within(corner, all, slack);
    const auto meets = [&](const Vec3& other) { return (other - place).norm() <= kSame * depth; };
    if (std::none_of(moved.begin(), moved.end(), meets)) moved.push_back(place);
  }
  return moved;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet

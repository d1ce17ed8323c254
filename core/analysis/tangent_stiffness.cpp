#include "core/analysis/tangent_stiffness.h"

#include <algorithm>

#include "core/dynamics/spring_force.h"

namespace limber {
namespace {

constexpr Eigen::Index kNoRow = -1;

FreePoints where(const IdVector<PointId, char>& may_move) {
  FreePoints free;
  free.row.resize(may_move.size(), kNoRow);
  for (PointId p : ids_of(may_move)) {
    if (!may_move[p]) continue;
    free.row[p] = free.size();
    free.points.push_back(p);
  }
  return free;
}

class LowerTriangle {
 public:
  // Adds to the 3 x 3 block at (row, column); above the diagonal and for fixed points to nothing.
  void add(Eigen::Index row, Eigen::Index column, const Mat3& block) {
    if (row == kNoRow || column == kNoRow || row < column) return;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < (row == column ? i + 1 : 3); ++j) {
        entries_.emplace_back(row + i, column + j, block(i, j));
      }
    }
  }
  void reserve(std::size_t n) { entries_.reserve(n); }
  SparseMatrix matrix(Eigen::Index size) const {
    SparseMatrix sum(size, size);
    sum.setFromTriplets(entries_.begin(), entries_.end());
    return sum;
  }

 private:
  std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace

FreePoints unpinned_points(const PhysicalModel& model) {
  IdVector<PointId, char> may_move(model.points.size(), true);
  for (PointId p : ids_of(model.points)) may_move[p] = !model.points[p].pinned;
  return where(may_move);
}

FreePoints sprung_points(const PhysicalModel& model) {
  IdVector<PointId, char> may_move(model.points.size(), false);
  for (EdgeId e : ids_of(model.edges)) {
    if (model.edges[e].broken) continue;
    for (PointId p : {model.geometry.edges[e].a, model.geometry.edges[e].b}) {
      may_move[p] = !model.points[p].pinned;
    }
  }
  return where(may_move);
}

Mat3 spring_stiffness(double stiffness, double rest_length, const Vec3& d) {
  const double length = d.norm();
  if (length == 0.0) return Mat3::Zero();
  const Vec3 n = d / length;
  const double transverse = stiffness * (1.0 - rest_length / length);
  return transverse * Mat3::Identity() + (stiffness - transverse) * n * n.transpose();
}

// 1 / sqrt(m) of every row.
Eigen::VectorXd mass_scale(const PhysicalModel& model, const FreePoints& free) {
  Eigen::VectorXd scale(free.size());
  for (PointId p : free.points) {
    scale.segment<3>(free.row[p]).setConstant(1.0 / std::sqrt(model.points[p].mass));
  }
  return scale;
}

double sideways_stiffness_bound(double rest_length, double length) {
  return length < 0.5 * rest_length ? 1.0 : std::max(0.0, 1.0 - rest_length / length);
}

Mat3 spring_stiffness_bound(double stiffness, double rest_length, const Vec3& d) {
  const double sideways = sideways_stiffness_bound(rest_length, d.norm());
  const Vec3 n = d.normalized();
  return stiffness * (sideways * Mat3::Identity() + (1.0 - sideways) * n * n.transpose());
}

namespace {

using SpringStiffness = Mat3(double stiffness, double rest_length, const Vec3& d);

SparseMatrix assembled(const PhysicalModel& model, const FreePoints& free,
                       SpringStiffness* stiffness_of) {
  LowerTriangle lower;
  lower.reserve(21 * model.edges.size() + 6 * free.points.size());
  // The whole diagonal is there, for shifts.
  for (PointId p : free.points) lower.add(free.row[p], free.row[p], Mat3::Zero());
  for (EdgeId e : ids_of(model.edges)) {
    if (model.edges[e].broken) continue;
    const auto [a, b] = model.geometry.edges[e];
    const Mat3 k = stiffness_of(model.edges[e].stiffness, model.edges[e].rest_length,
                                model.geometry.points[b] - model.geometry.points[a]);
    lower.add(free.row[a], free.row[a], k);
    lower.add(free.row[b], free.row[b], k);
    lower.add(std::max(free.row[a], free.row[b]), std::min(free.row[a], free.row[b]), -k);
  }
  return lower.matrix(free.size());
}

SparseMatrix scaled(const PhysicalModel& model, SpringStiffness* stiffness_of) {
  const FreePoints free = unpinned_points(model);
  const Eigen::VectorXd scale = mass_scale(model, free);
  return scale.asDiagonal() * assembled(model, free, stiffness_of) * scale.asDiagonal();
}

}  // namespace

SparseMatrix tangent_stiffness(const PhysicalModel& model, const FreePoints& free) {
  return assembled(model, free, spring_stiffness);
}

IdVector<PointId, Vec3> spring_forces(const PhysicalModel& model) {
  IdVector<PointId, Vec3> force(model.points.size(), Vec3::Zero());
  for (EdgeId e : ids_of(model.edges)) {
    if (model.edges[e].broken) continue;
    const auto [a, b] = model.geometry.edges[e];
    const SpringStretch s = spring_stretch(model.geometry.points[b] - model.geometry.points[a],
                                           Vec3::Zero(), model.edges[e].rest_length);
    const Vec3 pull = spring_tension(model.edges[e].stiffness, 0.0, s.stretch, 0.0) * s.direction;
    force[a] += pull;
    force[b] -= pull;
  }
  return force;
}

SparseMatrix scaled_stiffness(const PhysicalModel& model) {
  return scaled(model, spring_stiffness);
}

SparseMatrix scaled_stiffness_bound(const PhysicalModel& model) {
  return scaled(model, spring_stiffness_bound);
}

}  // namespace limber

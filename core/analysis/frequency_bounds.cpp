#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/analysis/vibration.h"

namespace limber {
namespace {

// A spring as one of its points sees it.
struct Arm {
  EdgeId edge;
  Vec3 direction;    // unit
  double stiffness;  // N/m
  double far_mass;   // kg, of the other end
};

IdVector<PointId, std::vector<Arm>> arms_of_points(const PhysicalModel& model) {
  IdVector<PointId, std::vector<Arm>> arms(model.points.size());
  for (EdgeId e : ids_of(model.edges)) {
    if (model.edges[e].broken) continue;
    const auto [a, b] = model.geometry.edges[e];
    const Vec3 n = (model.geometry.points[b] - model.geometry.points[a]).normalized();
    arms[a].push_back({e, n, model.edges[e].stiffness, model.points[b].mass});
    arms[b].push_back({e, n, model.edges[e].stiffness, model.points[a].mass});
  }
  return arms;
}

// Norm of the rows' off-diagonal blocks of M^-1/2 K M^-1/2: sum k / sqrt(m_i m_j).
double coupling(const std::vector<Arm>& arms, double mass) {
  double sum = 0.0;
  for (const Arm& arm : arms) sum += arm.stiffness / std::sqrt(mass * arm.far_mass);
  return sum;
}

double stiffness_sum(const std::vector<Arm>& arms) {
  double sum = 0.0;
  for (const Arm& arm : arms) sum += arm.stiffness;
  return sum;
}

double largest_own_stiffness(const std::vector<Arm>& arms) {
  Mat3 own = Mat3::Zero();
  for (const Arm& arm : arms) own += arm.stiffness * arm.direction * arm.direction.transpose();
  return Eigen::SelfAdjointEigenSolver<Mat3>(own, Eigen::EigenvaluesOnly).eigenvalues()[2];
}

// This point's part of every row of the Gram matrix: sum_e' sqrt(k k') |n . n'| / m.
void add_gram_rows(const std::vector<Arm>& arms, double mass, IdVector<EdgeId, double>& row) {
  for (const Arm& arm : arms) {
    for (const Arm& other : arms) {
      row[arm.edge] += std::sqrt(arm.stiffness * other.stiffness) *
                       std::abs(arm.direction.dot(other.direction)) / mass;
    }
  }
}

}  // namespace

FrequencyBounds frequency_bounds(const PhysicalModel& model) {
  const IdVector<PointId, std::vector<Arm>> arms = arms_of_points(model);
  IdVector<EdgeId, double> gram_row(model.edges.size(), 0.0);
  FrequencyBounds squares;
  for (PointId p : ids_of(model.points)) {
    const double m = model.points[p].mass;
    const double far = coupling(arms[p], m);
    squares.points = std::max(squares.points, stiffness_sum(arms[p]) / m + far);
    squares.point_blocks = std::max(squares.point_blocks, largest_own_stiffness(arms[p]) / m + far);
    add_gram_rows(arms[p], m, gram_row);
  }
  for (double sum : gram_row) squares.edges = std::max(squares.edges, sum);
  return {std::sqrt(squares.points), std::sqrt(squares.point_blocks), std::sqrt(squares.edges)};
}

}  // namespace limber

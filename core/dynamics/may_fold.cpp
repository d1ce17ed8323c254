#include "core/dynamics/may_fold.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "core/dynamics/element_shares.h"
#include "core/model/rounded_cache.h"

namespace limber {
namespace {

// A cell counts as rigid if every way to deform it is at least this stiff, as a share of the
// stiffest. A cube of equal springs along all edges and diagonals has 0.12, one whose face
// diagonals are 1 % as stiff as its edges 0.005; there it takes strains of 2 % to turn its springs
// far.
constexpr double kLeastCellStiffness = 2e-3;
// Likewise for a joint of two clusters: of the mean over its bonds.
constexpr double kLeastJointStiffness = 1e-3;

bool is_rigid(const Eigen::MatrixXd& stiffness) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness, Eigen::EigenvaluesOnly);
  const Eigen::VectorXd& ascending = solver.eigenvalues();
  constexpr Eigen::Index kRigidMotions = 6;
  return ascending.size() > kRigidMotions &&
         ascending[kRigidMotions] > kLeastCellStiffness * ascending[ascending.size() - 1];
}

// Two bodies cannot move against each other along the line of a bond, to first order.
struct Bond {
  Vec3 at;
  Vec3 along;  // unit
};

// Six bonds hold a body if their lines are independent (Pluecker coordinates; Graver, Servatius and
// Servatius, Combinatorial Rigidity, 1993).
bool holds(const std::vector<Bond>& bonds) {
  const auto count = static_cast<double>(bonds.size());
  Vec3 centre = Vec3::Zero();
  for (const Bond& b : bonds) centre += b.at / count;
  double square = 0.0;
  for (const Bond& b : bonds) square += (b.at - centre).squaredNorm() / count;
  if (square == 0.0) return false;
  Eigen::Matrix<double, 6, 6> sum = Eigen::Matrix<double, 6, 6>::Zero();
  for (const Bond& b : bonds) {
    Eigen::Matrix<double, 6, 1> line;
    line << b.along, (b.at - centre).cross(b.along) / std::sqrt(square);
    sum += line * line.transpose() / count;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(sum,
                                                                          Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[0] > kLeastJointStiffness;
}

// Cells of a model, united to clusters that cannot deform.
class Clusters {
 public:
  explicit Clusters(const PhysicalModel& model)
      : model_(model),
        root_(model.geometry.cells.size()),
        cells_of_(model.points.size()),
        row_(model.points.size(), -1) {
    std::iota(root_.begin(), root_.end(), 0);
    for (std::size_t c = 0; c < root_.size(); ++c) take(static_cast<std::int32_t>(c));
  }

  bool one_per_piece() {
    for (std::int32_t c : rigid_) unite_with_neighbours(c);
    while (true) {
      joints_.clear();
      list_shared_points();
      if (!list_bonds()) return false;
      if (joints_.empty()) return true;
      if (!unite_by_joints()) return false;
    }
  }

 private:
  using Joint = std::pair<std::int32_t, std::int32_t>;  // roots, ascending

  std::int32_t find(std::int32_t c) {
    while (root_[c] != c) c = root_[c] = root_[root_[c]];
    return c;
  }
  bool unite(std::int32_t a, std::int32_t b) {
    a = find(a);
    b = find(b);
    root_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

  struct CellSpring {
    int a, b;          // rows in points_
    Vec3 direction;    // unit
    double stiffness;  // share of the cell's stiffest
  };

  void take(std::int32_t cell);
  void read(std::span<const EdgeId> edges);
  void set_key();
  Eigen::MatrixXd stiffness() const;
  void unite_with_neighbours(std::int32_t cell);
  bool shares_a_plane(std::int32_t other) const;
  void list_shared_points();
  bool list_bonds();
  bool unite_by_joints();

  const PhysicalModel& model_;
  std::vector<std::int32_t> root_;                         // shape (cells)
  std::vector<std::int32_t> rigid_;                        // cells
  IdVector<PointId, std::vector<std::int32_t>> cells_of_;  // rigid ones around each point
  std::map<Joint, std::vector<Bond>> joints_;
  // Of the cell that is looked at.
  std::vector<PointId> points_;
  std::vector<CellSpring> springs_;
  IdVector<PointId, int> row_;  // -1: not in it
  RoundedKey key_;
  RoundedCache<bool> known_;
};

// Numbers the cell's points in the order in which its springs name them.
void Clusters::read(std::span<const EdgeId> edges) {
  points_.clear();
  springs_.clear();
  double stiffest = 0.0;
  for (EdgeId e : edges) stiffest = std::max(stiffest, model_.edges[e].stiffness);
  for (EdgeId e : edges) {
    if (!carries(model_.edges[e])) continue;
    const auto [a, b] = model_.geometry.edges[e];
    for (PointId p : {a, b}) {
      if (row_[p] >= 0) continue;
      row_[p] = static_cast<int>(points_.size());
      points_.push_back(p);
    }
    const Vec3 d = model_.geometry.points[b] - model_.geometry.points[a];
    springs_.push_back({row_[a], row_[b], d.normalized(), model_.edges[e].stiffness / stiffest});
  }
  for (PointId p : points_) row_[p] = -1;
}

// A millionth is enough for a verdict.
void Clusters::set_key() {
  constexpr double kQuantum = 0x1p-20;
  key_.clear();
  for (const auto& [a, b, n, k] : springs_) {
    key_.add(a);
    key_.add(b);
    for (double x : {n.x(), n.y(), n.z(), k}) key_.add(x, kQuantum);
  }
}

Eigen::MatrixXd Clusters::stiffness() const {
  const auto size = 3 * static_cast<Eigen::Index>(points_.size());
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(size, size);
  for (const auto& [a, b, n, k] : springs_) {
    const Mat3 block = k * n * n.transpose();
    for (int row : {a, b}) sum.block<3, 3>(3 * row, 3 * row) += block;
    sum.block<3, 3>(3 * a, 3 * b) -= block;
    sum.block<3, 3>(3 * b, 3 * a) -= block;
  }
  return sum;
}

void Clusters::take(std::int32_t cell) {
  read(model_.geometry.cells[CellId(std::size_t(cell))].edges);
  if (points_.size() < 3) return;  // its springs are broken
  set_key();
  if (!known_.get(key_, [this] { return is_rigid(stiffness()); })) return;
  rigid_.push_back(cell);
  for (PointId p : points_) cells_of_[p].push_back(cell);
}

// With later ones: earlier ones have looked for this.
void Clusters::unite_with_neighbours(std::int32_t cell) {
  read(model_.geometry.cells[CellId(std::size_t(cell))].edges);
  for (PointId p : points_) {
    for (std::int32_t other : cells_of_[p]) {
      if (other > cell && find(other) != find(cell) && shares_a_plane(other)) unite(cell, other);
    }
  }
}

// Are three of points_ the other cell's as well, and not in a line?
bool Clusters::shares_a_plane(std::int32_t other) const {
  const Vec3 *first = nullptr, *second = nullptr;
  for (PointId p : points_) {
    if (!std::ranges::binary_search(cells_of_[p], other)) continue;
    const Vec3& x = model_.geometry.points[p];
    if (!first) {
      first = &x;
    } else if (!second) {
      second = &x;
    } else {
      const Vec3 one = *second - *first, two = x - *first;
      if (one.cross(two).norm() > kLeastJointStiffness * one.norm() * two.norm()) return true;
    }
  }
  return false;
}

// A point that clusters share is three bonds.
void Clusters::list_shared_points() {
  for (PointId p : ids_of(model_.points)) {
    for (std::size_t i = 1; i < cells_of_[p].size(); ++i) {
      const std::int32_t a = find(cells_of_[p][0]), b = find(cells_of_[p][i]);
      if (a == b) continue;
      for (int axis = 0; axis < 3; ++axis) {
        joints_[std::minmax(a, b)].push_back({model_.geometry.points[p], Vec3::Unit(axis)});
      }
    }
  }
}

// Springs between clusters. False: one ends where no cluster is.
bool Clusters::list_bonds() {
  for (EdgeId e : ids_of(model_.edges)) {
    if (!carries(model_.edges[e])) continue;
    const auto [a, b] = model_.geometry.edges[e];
    if (cells_of_[a].empty() || cells_of_[b].empty()) return false;
    const std::int32_t from = find(cells_of_[a][0]), to = find(cells_of_[b][0]);
    if (from == to) continue;
    const Vec3 d = model_.geometry.points[b] - model_.geometry.points[a];
    joints_[std::minmax(from, to)].push_back({model_.geometry.points[a], d.normalized()});
  }
  return true;
}

bool Clusters::unite_by_joints() {
  bool any = false;
  for (const auto& [clusters, bonds] : joints_) {
    if (holds(bonds)) any = unite(clusters.first, clusters.second) || any;
  }
  return any;
}

}  // namespace

bool may_fold(const PhysicalModel& model) { return !Clusters(model).one_per_piece(); }

}  // namespace limber

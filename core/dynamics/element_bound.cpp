#include "core/dynamics/element_bound.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/analysis/tangent_stiffness.h"
#include "core/dynamics/element_shares.h"
#include "core/model/rounded_cache.h"

namespace limber {
namespace {

// One element, its points numbered from 0 in ascending order.
struct Element {
  struct Spring {
    int a, b;
    Vec3 direction;    // unit; none for coincident points
    double sideways;   // stiffness across, of a spring under tension or that may turn any way
    double stiffness;  // N/m, this element's share
  };
  std::vector<Spring> springs;
  std::vector<double> mass;  // kg, this element's share of its points
};

// Largest eigenvalue of M_c^-1 K_c by M_c^-1/2 K_c M_c^-1/2.
double largest_eigenvalue(const Element& element) {
  const auto size = 3 * static_cast<Eigen::Index>(element.mass.size());
  Eigen::MatrixXd scaled = Eigen::MatrixXd::Zero(size, size);
  for (const Element::Spring& s : element.springs) {
    const double scale_a = 1.0 / std::sqrt(element.mass[s.a]);
    const double scale_b = 1.0 / std::sqrt(element.mass[s.b]);
    const Mat3 along = s.direction * s.direction.transpose();
    const Mat3 k = s.stiffness * (s.sideways * Mat3::Identity() + (1.0 - s.sideways) * along);
    scaled.block<3, 3>(3 * s.a, 3 * s.a) += scale_a * scale_a * k;
    scaled.block<3, 3>(3 * s.b, 3 * s.b) += scale_b * scale_b * k;
    scaled.block<3, 3>(3 * s.a, 3 * s.b) -= scale_a * scale_b * k;
    scaled.block<3, 3>(3 * s.b, 3 * s.a) -= scale_a * scale_b * k;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().maxCoeff();
}

// Everything that the eigenvalue depends on.
void set_key(const Element& element, RoundedKey& key) {
  const double direction = RoundedKey::quantum(1.0);
  key.clear();
  key.add(static_cast<std::int64_t>(element.mass.size()));
  // Each relative to itself: a light point beside a heavy one sets the frequency.
  for (double m : element.mass) key.add_relative(m);
  for (const auto& [a, b, n, sideways, k] : element.springs) {
    key.add(a);
    key.add(b);
    key.add(sideways, direction);
    for (int axis = 0; axis < 3; ++axis) key.add(n[axis], direction);
    key.add_relative(k);
  }
}

// The elements of one model, one after the other through the same arrays. Congruent ones, of which
// a regular lattice is made, are solved once.
class Elements {
 public:
  explicit Elements(const PhysicalModel& model)
      : model_(model), sharers_(cells_per_edge(model.geometry)), total_(stiffness_around(model)) {}

  double largest() {
    double largest = 0.0;
    for (const Cell& cell : model_.geometry.cells) {
      largest = std::max(largest, eigenvalue(cell.edges));
    }
    for (std::size_t e = 0; e < model_.edges.size(); ++e) {
      const EdgeId alone(e);
      if (sharers_[e] == 0) largest = std::max(largest, eigenvalue({&alone, 1}));
    }
    return largest;
  }

 private:
  double eigenvalue(std::span<const EdgeId> edges) {
    read(edges);
    if (element_.springs.empty()) return 0.0;
    set_key(element_, key_);
    return eigenvalues_.get(key_, [this] { return largest_eigenvalue(element_); });
  }

  void read(std::span<const EdgeId> edges) {
    collect_points(edges);
    element_.springs.clear();
    element_.mass.assign(points_.size(), 0.0);
    for (EdgeId e : edges) {
      if (carries(model_.edges[e])) read_spring(e);
    }
    for (std::size_t i = 0; i < points_.size(); ++i) {  // its springs' sum until here
      element_.mass[i] = model_.points[points_[i]].mass * element_.mass[i] / total_[points_[i]];
    }
  }

  void collect_points(std::span<const EdgeId> edges) {
    points_.clear();
    for (EdgeId e : edges) {
      if (!carries(model_.edges[e])) continue;
      points_.push_back(model_.geometry.edges[e].a);
      points_.push_back(model_.geometry.edges[e].b);
    }
    std::sort(points_.begin(), points_.end());
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
  }

  void read_spring(EdgeId e) {
    const auto [a, b] = model_.geometry.edges[e];
    const auto row = [this](PointId p) {
      return static_cast<int>(std::ranges::lower_bound(points_, p) - points_.begin());
    };
    const int sharers = std::max(1, sharers_[e.index()]);
    const Vec3 along = model_.geometry.points[b] - model_.geometry.points[a];
    element_.springs.push_back({row(a), row(b), along.normalized(),
                                sideways_stiffness_bound(model_.edges[e].rest_length, along.norm()),
                                model_.edges[e].stiffness / sharers});
    element_.mass[element_.springs.back().a] += element_.springs.back().stiffness;
    element_.mass[element_.springs.back().b] += element_.springs.back().stiffness;
  }

  const PhysicalModel& model_;
  std::vector<std::int32_t> sharers_;  // shape (edges), cells
  IdVector<PointId, double> total_;    // N/m around each point
  Element element_;
  std::vector<PointId> points_;  // of the present element, ascending
  RoundedKey key_;
  RoundedCache<double> eigenvalues_;
};

}  // namespace

double element_frequency_bound(const PhysicalModel& model) {
  // A bound must not fall below by rounding, nor by that of the keys.
  constexpr double kRounding = 1.0 + 1e-9;
  return kRounding * std::sqrt(Elements(model).largest());
}

}  // namespace limber

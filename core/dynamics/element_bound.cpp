#include "core/dynamics/element_bound.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace limber {
namespace {

struct SharedSpring {
  PointId a, b;
  Vec3 direction;    // unit
  double stiffness;  // N/m, this element's share
};

using Element = std::vector<SharedSpring>;

bool carries(const EdgeAttributes& edge) { return !edge.broken && edge.stiffness > 0.0; }

SharedSpring share_of(const PhysicalModel& model, EdgeId e) {
  const auto [a, b] = model.geometry.edges[e];
  const Vec3 along = model.geometry.points[b] - model.geometry.points[a];
  const std::size_t sharers = std::max<std::size_t>(1, model.geometry.edge_cells[e].size());
  return {a, b, along.normalized(), model.edges[e].stiffness / static_cast<double>(sharers)};
}

std::vector<Element> elements_of(const PhysicalModel& model) {
  std::vector<Element> elements;
  for (const Cell& cell : model.geometry.cells) {
    Element& element = elements.emplace_back();
    for (EdgeId e : cell.edges)
      if (carries(model.edges[e])) element.push_back(share_of(model, e));
  }
  for (EdgeId e : ids_of(model.edges)) {
    if (!carries(model.edges[e]) || !model.geometry.edge_cells[e].empty()) continue;
    elements.push_back({share_of(model, e)});
  }
  return elements;
}

std::map<PointId, double> stiffness_around(const Element& element) {
  std::map<PointId, double> sum;
  for (const SharedSpring& s : element) {
    sum[s.a] += s.stiffness;
    sum[s.b] += s.stiffness;
  }
  return sum;
}

IdVector<PointId, double> stiffness_around(const PhysicalModel& model) {
  IdVector<PointId, double> sum(model.points.size(), 0.0);
  for (EdgeId e : ids_of(model.edges)) {
    if (!carries(model.edges[e])) continue;
    sum[model.geometry.edges[e].a] += model.edges[e].stiffness;
    sum[model.geometry.edges[e].b] += model.edges[e].stiffness;
  }
  return sum;
}

// Largest eigenvalue of M_c^-1 K_c by M_c^-1/2 K_c M_c^-1/2.
double largest_eigenvalue(const PhysicalModel& model, const Element& element,
                          const IdVector<PointId, double>& total) {
  struct Place {
    Eigen::Index row;
    double scale;  // 1 / sqrt(share of the mass)
  };
  std::map<PointId, Place> places;
  for (const auto& [p, share] : stiffness_around(element)) {
    const auto row = 3 * static_cast<Eigen::Index>(places.size());
    places[p] = {row, 1.0 / std::sqrt(model.points[p].mass * share / total[p])};
  }
  const auto size = 3 * static_cast<Eigen::Index>(places.size());
  Eigen::MatrixXd scaled = Eigen::MatrixXd::Zero(size, size);
  for (const SharedSpring& s : element) {
    const Place a = places[s.a], b = places[s.b];
    const Mat3 k = s.stiffness * s.direction * s.direction.transpose();
    scaled.block<3, 3>(a.row, a.row) += a.scale * a.scale * k;
    scaled.block<3, 3>(b.row, b.row) += b.scale * b.scale * k;
    scaled.block<3, 3>(a.row, b.row) -= a.scale * b.scale * k;
    scaled.block<3, 3>(b.row, a.row) -= a.scale * b.scale * k;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().maxCoeff();
}

}  // namespace

double element_frequency_bound(const PhysicalModel& model) {
  constexpr double kRounding = 1.0 + 1e-9;  // a bound must not fall below by rounding
  const IdVector<PointId, double> total = stiffness_around(model);
  double largest = 0.0;
  for (const Element& element : elements_of(model)) {
    if (!element.empty()) largest = std::max(largest, largest_eigenvalue(model, element, total));
  }
  return kRounding * std::sqrt(largest);
}

}  // namespace limber

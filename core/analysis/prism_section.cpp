#include "core/analysis/prism_section.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/model/errors.h"

namespace limber {
namespace {

constexpr double kSamePlace = 1e-6;  // in spacings

[[noreturn]] void refuse(const PhysicalModel& bar, const std::string& what) {
  throw InputError({bar.name, what, "give a bar of at least three equal layers of points along z"});
}

using Layer = std::vector<Vec3>;  // positions of its points

struct LayerSpring {
  Eigen::Index a, b;  // points of the layer; b stands for its counterpart when the spring goes up
  Vec3 from, to;      // ends, about the layer's mean
  double stiffness;   // N/m
};

// Layers by their number from the lowest, for each point.
IdVector<PointId, long> layer_numbers(const PhysicalModel& bar, double spacing) {
  const auto& points = bar.geometry.points;
  const auto lower = [](const Vec3& p, const Vec3& q) { return p.z() < q.z(); };
  IdVector<PointId, long> number(points.size());
  if (points.empty()) return number;
  const double lowest = std::min_element(points.begin(), points.end(), lower)->z();
  for (PointId p : ids_of(points)) {
    const double height = (points[p].z() - lowest) / spacing;
    number[p] = std::lround(height);
    if (std::abs(height - static_cast<double>(number[p])) > kSamePlace) {
      refuse(bar, "point " + std::to_string(p.value) + " lies between the layers");
    }
  }
  return number;
}

Vec3 mean_of(const Layer& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

Layer layer_of(const PhysicalModel& bar, const IdVector<PointId, long>& number, long layer) {
  Layer result;
  for (PointId p : ids_of(number)) {
    if (number[p] == layer) result.push_back(bar.geometry.points[p]);
  }
  return result;
}

// The point of the layer at the same x and y.
Eigen::Index counterpart(const PhysicalModel& bar, const Layer& layer, const Vec3& at,
                         double spacing) {
  for (std::size_t i = 0; i < layer.size(); ++i) {
    if ((layer[i] - at).head<2>().norm() < kSamePlace * spacing) return i;
  }
  refuse(bar, "a spring leads to a point without a counterpart in the middle layer");
}

std::vector<LayerSpring> springs_of_layer(const PhysicalModel& bar, const Layer& layer,
                                          const IdVector<PointId, long>& number, long middle,
                                          double spacing) {
  const auto& points = bar.geometry.points;
  const Vec3 mean = mean_of(layer);
  std::vector<LayerSpring> springs;
  for (EdgeId e : ids_of(bar.edges)) {
    auto [a, b] = bar.geometry.edges[e];
    if (number[a] > number[b]) std::swap(a, b);
    if (bar.edges[e].broken || number[a] != middle) continue;
    springs.push_back({counterpart(bar, layer, points[a], spacing),
                       counterpart(bar, layer, points[b], spacing), points[a] - mean,
                       points[b] - mean, bar.edges[e].stiffness});
  }
  return springs;
}

// Displacements of unit axial strain, of unit curvature 1/m in the xz plane and of unit twist
// rad/m, without what the layer adds by warping.
Vec3 unit_stretch(const Vec3& x) { return {0.0, 0.0, x.z()}; }
Vec3 unit_curvature(const Vec3& x) { return {-0.5 * x.z() * x.z(), 0.0, x.x() * x.z()}; }
Vec3 unit_twist(const Vec3& x) { return {-x.y() * x.z(), x.x() * x.z(), 0.0}; }

// The springs of one layer: sqrt(k) times their elongations are W w + e, w being the warping.
class WarpingLayer {
 public:
  WarpingLayer(const std::vector<LayerSpring>& springs, std::size_t points) : springs_(springs) {
    elongation_ = Eigen::MatrixXd::Zero(springs.size(), 3 * points);
    for (std::size_t s = 0; s < springs.size(); ++s) {
      const Vec3 row = std::sqrt(springs[s].stiffness) * direction(springs[s]);
      elongation_.row(s).segment<3>(3 * springs[s].b) += row;
      elongation_.row(s).segment<3>(3 * springs[s].a) -= row;
    }
    solver_.compute(elongation_);
  }

  struct State {
    double stiffness;      // twice the energy of a layer per its height, for the unit imposed
    Eigen::VectorXd warp;  // m, three components a point
  };
  State relaxed(Vec3 (*imposed)(const Vec3&), double spacing) const {
    Eigen::VectorXd given(springs_.size());
    for (std::size_t s = 0; s < springs_.size(); ++s) {
      const Vec3 change = imposed(springs_[s].to) - imposed(springs_[s].from);
      given[s] = std::sqrt(springs_[s].stiffness) * direction(springs_[s]).dot(change);
    }
    const Eigen::VectorXd warp = solver_.solve(-given);
    return {(elongation_ * warp + given).squaredNorm() / spacing, warp};
  }

 private:
  static Vec3 direction(const LayerSpring& s) { return (s.to - s.from).normalized(); }

  const std::vector<LayerSpring>& springs_;
  Eigen::MatrixXd elongation_;
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver_;  // mechanisms do not disturb it
};

// Mean x component of the warping over the points of one row, the ones at `x`.
double mean_warp(const Layer& layer, const Eigen::VectorXd& warp, double x, double spacing) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < layer.size(); ++i) {
    if (std::abs(layer[i].x() - x) > kSamePlace * spacing) continue;
    sum += warp[3 * i];
    ++count;
  }
  return sum / count;
}

// 0 for a layer without width.
double contraction(const Layer& layer, const Eigen::VectorXd& warp, double spacing) {
  const auto by_x = [](const Vec3& p, const Vec3& q) { return p.x() < q.x(); };
  const auto [left, right] = std::minmax_element(layer.begin(), layer.end(), by_x);
  const double width = right->x() - left->x();
  if (width == 0.0) return 0.0;
  return (mean_warp(layer, warp, left->x(), spacing) -
          mean_warp(layer, warp, right->x(), spacing)) /
         width;
}

}  // namespace

PrismSection prism_section(const PhysicalModel& bar, double layer_spacing_m) {
  if (!(std::isfinite(layer_spacing_m) && layer_spacing_m > 0.0)) {
    throw InputError({bar.name, "the layers' spacing is " + std::to_string(layer_spacing_m) + " m",
                      "give it a finite one above 0"});
  }
  const IdVector<PointId, long> number = layer_numbers(bar, layer_spacing_m);
  const long highest = number.empty() ? 0 : *std::max_element(number.begin(), number.end());
  if (highest < 2) refuse(bar, "there are fewer than three layers");
  const long middle = highest / 2;
  const Layer layer = layer_of(bar, number, middle);
  if (layer.empty()) refuse(bar, "there are no points in the middle layer");
  const auto springs = springs_of_layer(bar, layer, number, middle, layer_spacing_m);
  const WarpingLayer warping(springs, layer.size());
  const auto stretched = warping.relaxed(unit_stretch, layer_spacing_m);
  return {stretched.stiffness, warping.relaxed(unit_curvature, layer_spacing_m).stiffness,
          warping.relaxed(unit_twist, layer_spacing_m).stiffness,
          contraction(layer, stretched.warp, layer_spacing_m)};
}

}  // namespace limber

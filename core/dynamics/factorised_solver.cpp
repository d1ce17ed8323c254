#include "core/dynamics/factorised_solver.h"

#include <algorithm>
#include <span>
#include <utility>

#include "core/model/index_rows.h"

namespace limber {
namespace {

// Rows that a spring joins to each row.
IndexRows neighbours_of(const ImplicitSystem& system) {
  IndexRows rows;
  rows.start.assign(system.points().size() + 1, 0);
  const auto springs = std::span(system.couplings()).first(system.springs().size());
  for (const Coupling& c : springs) {
    if (c.b >= 0) ++rows.start[c.a + 1], ++rows.start[c.b + 1];
  }
  for (std::size_t r = 1; r < rows.start.size(); ++r) rows.start[r] += rows.start[r - 1];
  rows.items.resize(rows.start.back());
  std::vector<std::int32_t> next(rows.start.begin(), rows.start.end() - 1);
  for (const Coupling& c : springs) {
    if (c.b < 0) continue;
    rows.items[next[c.a]++] = c.b;
    rows.items[next[c.b]++] = c.a;
  }
  return rows;
}

// Rows by their distance from `root`; marks those met with the number of the search.
std::vector<std::vector<std::int32_t>> levels_from(std::int32_t root, const IndexRows& neighbours,
                                                   std::vector<int>& met, int search) {
  std::vector<std::vector<std::int32_t>> levels{{root}};
  met[root] = search;
  while (true) {
    std::vector<std::int32_t> next;
    for (std::int32_t row : levels.back()) {
      for (std::int32_t other : neighbours[row]) {
        if (met[other] == search) continue;
        met[other] = search;
        next.push_back(other);
      }
    }
    if (next.empty()) return levels;
    levels.push_back(std::move(next));
  }
}

}  // namespace

double band_multiplications(const ImplicitSystem& system) {
  const IndexRows neighbours = neighbours_of(system);
  std::vector<int> met(system.points().size(), 0);
  double sum = 0.0;
  for (std::int32_t row = 0; row < static_cast<std::int32_t>(met.size()); ++row) {
    if (met[row] != 0) continue;
    const std::int32_t end = levels_from(row, neighbours, met, 1).back().front();
    double before = 0.0;
    for (const auto& level : levels_from(end, neighbours, met, 2)) {
      const double width = 3.0 * static_cast<double>(level.size());
      sum += width * (width + before) * (width + before);
      before = width;
    }
  }
  return sum;
}

FactorisedSolver::FactorisedSolver(const ImplicitSystem& system) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add_block = [&](Eigen::Index row, Eigen::Index column) {
    for (int j = 0; j < 3; ++j) {
      for (int i = row == column ? j : 0; i < 3; ++i)
        entries.emplace_back(row + i, column + j, 1.0);
    }
  };
  const auto rows = static_cast<std::int32_t>(system.points().size());
  for (std::int32_t row = 0; row < rows; ++row) add_block(3 * row, 3 * row);
  for (std::size_t i = 0; i < system.springs().size(); ++i) {
    const auto [a, b] = std::minmax(system.couplings()[i].a, system.couplings()[i].b);
    if (a >= 0) add_block(3 * b, 3 * a);
  }
  lower_.resize(system.size(), system.size());
  lower_.setFromTriplets(entries.begin(), entries.end());
  for (std::int32_t row = 0; row < rows; ++row) diagonal_.push_back(find_block(row, row));
  for (std::size_t i = 0; i < system.springs().size(); ++i) {
    const auto [a, b] = std::minmax(system.couplings()[i].a, system.couplings()[i].b);
    couplings_.push_back(a >= 0 ? find_block(b, a) : BlockEntry{});
  }
  cholesky_.analyzePattern(lower_);
}

FactorisedSolver::BlockEntry FactorisedSolver::find_block(std::int32_t row,
                                                          std::int32_t column) const {
  BlockEntry entry{};
  for (int j = 0; j < 3; ++j) {
    const int* rows = lower_.innerIndexPtr();
    const int* begin = rows + lower_.outerIndexPtr()[3 * column + j];
    const int* end = rows + lower_.outerIndexPtr()[3 * column + j + 1];
    entry[j] = std::lower_bound(begin, end, 3 * row + (row == column ? j : 0)) - rows;
  }
  return entry;
}

void FactorisedSolver::refill(const ImplicitSystem& system) {
  double* values = lower_.valuePtr();
  std::fill(values, values + lower_.nonZeros(), 0.0);
  for (std::size_t row = 0; row < diagonal_.size(); ++row) {
    const Mat3& block = system.diagonal()[row];
    for (int j = 0; j < 3; ++j) {
      for (int i = j; i < 3; ++i) values[diagonal_[row][j] + i - j] += block(i, j);
    }
  }
  for (std::size_t s = 0; s < couplings_.size(); ++s) {
    if (system.couplings()[s].b < 0) continue;
    const Mat3 block = system.couplings()[s].block();
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) values[couplings_[s][j] + i] -= block(i, j);
    }
  }
}

LinearSolution FactorisedSolver::solve(const ImplicitSystem& system, const Eigen::VectorXd& b) {
  refill(system);
  cholesky_.factorize(lower_);
  LinearSolution solution;
  solution.converged = cholesky_.info() == Eigen::Success;
  if (solution.converged) solution.x = cholesky_.solve(b);
  return solution;
}

}  // namespace limber

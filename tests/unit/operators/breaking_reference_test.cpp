#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "core/model/validate.h"
#include "core/operators/breaking_operator.h"
#include "tests/support/blocks.h"
#include "tests/support/measure.h"

// All rows and all columns of breaking_topology.csv; tests/data/README.md tells what they are.

namespace limber {
namespace {

using Row = std::map<std::string, std::string>;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
  return parts;
}

std::vector<Row> reference_rows() {
  std::ifstream file(LIMBER_TEST_DATA "/breaking_topology.csv");
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> columns = split(line, ',');
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    const std::vector<std::string> cells = split(line, ',');
    Row& row = rows.emplace_back();
    for (std::size_t i = 0; i < columns.size(); ++i) row[columns[i]] = cells.at(i);
  }
  return rows;
}

std::array<int, 3> three_numbers(const std::string& text, char separator) {
  const std::vector<std::string> parts = split(text, separator);
  return {std::stoi(parts.at(0)), std::stoi(parts.at(1)), std::stoi(parts.at(2))};
}

test::BlockShape shape_of(const Row& row) {
  const auto has = [&](char c) { return row.at("edge_set").find(c) != std::string::npos; };
  test::BlockShape shape;
  shape.cells = three_numbers(row.at("cells"), 'x');
  shape.edges = {.one_diagonal = has('D'), .both_diagonals = has('F'), .body_diagonals = has('B')};
  return shape;
}

std::vector<EdgeId> edges_of(const Row& row, const PhysicalModel& model) {
  std::vector<EdgeId> edges;
  for (const std::string& edge : split(row.at("break_edges"), '|')) {
    const std::vector<std::string> ends = split(edge, '-');
    edges.push_back(test::block_edge(model, shape_of(row), three_numbers(ends.at(0), ':'),
                                     three_numbers(ends.at(1), ':')));
  }
  return edges;
}

void expect_counts(const Row& row, const std::string& prefix, const PhysicalModel& model) {
  const std::map<std::string, int> counts = test::topology_counts(model);
  std::size_t compared = 0;
  for (const auto& [column, expected] : row) {
    if (!column.starts_with(prefix)) continue;
    EXPECT_EQ(counts.at(column.substr(prefix.size())), std::stoi(expected)) << column;
    ++compared;
  }
  EXPECT_EQ(compared, counts.size());
}

class BreakingReference : public ::testing::TestWithParam<Row> {};

TEST_P(BreakingReference, EveryColumnAgrees) {
  const Row& row = GetParam();
  PhysicalModel model = test::block(shape_of(row));
  const std::vector<EdgeId> edges = edges_of(row, model);
  expect_counts(row, "initial_", model);
  EXPECT_EQ(static_cast<int>(edge_cells(model.geometry)[edges.front().index()].size()),
            std::stoi(row.at("n_cells_sharing_first_edge")));

  const BreakingResult result = break_edges(model, edges);
  expect_counts(row, "after_", model);
  EXPECT_EQ(static_cast<int>(result.invalid_cells.size()), std::stoi(row.at("cells_invalidated")));
  EXPECT_EQ(std::to_string(result.broken_edges.size()), row.at("after_edges_broken"));
  EXPECT_TRUE(validate(model).empty());
}

std::string name_of(const ::testing::TestParamInfo<Row>& info) {
  std::string name = info.param.at("id");
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Csv, BreakingReference, ::testing::ValuesIn(reference_rows()), name_of);

TEST(BreakingReferenceFile, HasAllCases) { EXPECT_EQ(reference_rows().size(), 41u); }

}  // namespace
}  // namespace limber

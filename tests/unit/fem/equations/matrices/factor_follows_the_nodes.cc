// The factor of blocks of three unknowns: its shape from the nodes alone, its solutions against a dense one.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "fem/base/values/errors.h"
#include "fem/equations/matrices/cholmod_factor.h"

namespace {

/// Each pair of nodes is joined with a chance.
fem::NodeGraph random_graph(std::int32_t n_nodes, double chance, std::mt19937& random) {
  std::bernoulli_distribution is_joined(chance);
  fem::NodeGraph graph;
  graph.begin.push_back(0);
  for (std::int32_t j = 0; j < n_nodes; ++j) {
    for (std::int32_t i = j + 1; i < n_nodes; ++i)
      if (is_joined(random)) graph.neighbour.push_back(i);
    graph.begin.push_back(std::int64_t(graph.neighbour.size()));
  }
  return graph;
}

/// Entries between -1 and 1, and a diagonal above the sum of any row.
fem::SymmetricMatrix positive_definite(const fem::NodeGraph& graph, std::mt19937& random) {
  std::uniform_real_distribution<double> entry(-1, 1);
  auto matrix = fem::make_matrix(graph);
  for (auto& value : matrix.value) value = entry(random);
  for (std::int64_t j = 0; j < matrix.n; ++j)
    matrix.value[std::size_t(matrix.column_begin[j])] = double(matrix.n) + entry(random);
  return matrix;
}

Eigen::MatrixXd dense(const fem::SymmetricMatrix& matrix) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(matrix.n, matrix.n);
  for (std::int64_t j = 0; j < matrix.n; ++j)
    for (auto k = matrix.column_begin[j]; k < matrix.column_begin[j + 1]; ++k)
      all(matrix.row[std::size_t(k)], j) = all(j, matrix.row[std::size_t(k)]) = matrix.value[std::size_t(k)];
  return all;
}

TEST(CholmodFactor, SolvesAsADenseFactor) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 40; ++trial) {
    const auto n_nodes = std::int32_t(1 + random() % 60);
    const auto graph = random_graph(n_nodes, trial % 4 * 0.1, random);  // some fall into pieces
    const auto matrix = positive_definite(graph, random);
    fem::CholmodFactor factor(graph, fem::order_nodes(graph));
    factor.factorise(matrix);
    const Eigen::MatrixXd force = Eigen::MatrixXd::Random(matrix.n, 1 + trial);
    const Eigen::MatrixXd reference = dense(matrix).llt().solve(force);
    // Diagonally dominant: the condition is of order one.
    EXPECT_LT((factor.solve(force) - reference).norm(), 1e-13 * reference.norm()) << trial;
  }
}

// With the matrix handed over in the factor's own order nothing is copied; rows of vectors follow.
TEST(CholmodFactor, InItsOwnOrderIsTheSame) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 20; ++trial) {
    const auto graph = random_graph(std::int32_t(2 + random() % 60), 0.2, random);
    const auto matrix = positive_definite(graph, random);
    fem::CholmodFactor factor(graph, fem::order_nodes(graph)), ordered(graph, fem::order_nodes(graph));
    factor.factorise(matrix);
    const auto& order = ordered.node_order();
    const auto place = fem::places_in(order);
    const auto graph_in_order = fem::permuted(graph, order);
    auto matrix_in_order = fem::permuted(matrix, order);
    const auto pattern = fem::make_matrix(graph_in_order);
    EXPECT_EQ(pattern.column_begin, matrix_in_order.column_begin);
    EXPECT_EQ(pattern.row, matrix_in_order.row);
    ordered.factorise_in_order(matrix_in_order);
    const Eigen::MatrixXd force = Eigen::MatrixXd::Random(matrix.n, 1 + trial);
    Eigen::MatrixXd columns = fem::rows_in_order(force, place);
    ordered.solve_in_order(columns);
    EXPECT_EQ(fem::rows_of_mesh(columns, place), factor.solve(force)) << trial;
    for (std::size_t i = 0; i < place.size(); ++i)
      EXPECT_EQ(fem::rows_in_order(force, place).row(3 * place[i] + 1), force.row(3 * Eigen::Index(i) + 1));
  }
}

// All joined with all: one dense triangle, stored in a square; n columns of n, n - 1, ... entries.
TEST(CholmodFactor, OfADenseMatrixHasItsSize) {
  std::mt19937 random(4);
  for (const std::int32_t n_nodes : {1, 2, 7, 20}) {
    const auto graph = random_graph(n_nodes, 1, random);
    const auto size = fem::CholmodFactor(graph, fem::order_nodes(graph)).size();
    const double n = 3 * n_nodes;
    EXPECT_EQ(size.n_dofs, std::size_t(n));
    EXPECT_EQ(size.entries, n * n);
    EXPECT_EQ(size.flops, n * (n + 1) * (2 * n + 1) / 6);
  }
}

// Both directions of 2^30 pairs are one more than a signed number of 32 bits holds.
TEST(CholmodFactor, RefusesMoreNeighboursThanMetisCounts) {
  EXPECT_NO_THROW(fem::refuse_large_graph((std::size_t(1) << 30) - 1));
  EXPECT_THROW(fem::refuse_large_graph(std::size_t(1) << 30), fem::DoesNotFit);
}

}  // namespace

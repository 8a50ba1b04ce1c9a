#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "fem/mesh/mesh_reader.h"
#include "fem/operators/elastic_operator.h"
#include "tests/unit/fem/examples/shaft_bodies.h"

namespace {

using fem::kernel::Kernels;

/// The variants that this machine can run.
std::vector<const Kernels*> variants() {
  std::vector<const Kernels*> result = {&fem::kernel::generic::kernels};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    result.push_back(&fem::kernel::avx2::kernels);
#endif
  const auto* best = &fem::kernel::kernels_for_this_machine();
  if (result.back() != best) result.push_back(best);
  return result;
}

struct Problem {
  explicit Problem(int degree) {
    auto shaft = fem_tests::eccentric_shaft(2);
    shaft.body.degree = degree;
    grid = fem::read_grid(shaft.body);
    const auto cells = fem::cells_of_nodes(grid);
    const auto colours = fem::colour_cells(grid, cells);
    const auto graph = fem::make_node_graph(grid, cells);
    matrix = fem::make_matrix(graph);
    fem::assemble_stiffness(grid, colours, graph, fem::lame(shaft.body.material), matrix);
    order = fem::order_cells(grid);
    metric = fem::cell_metric(grid, order);
    elastic = fem::lame(shaft.body.material);
  }
  fem::Grid grid;
  fem::SymmetricMatrix matrix;
  fem::CellOrder order;
  std::vector<double> metric;
  fem::Lame elastic;
};

/// Largest difference from the matrix over the largest entry of K x, each load case with its own random x.
template <typename T>
double difference(const Problem& problem, const Kernels& kernels, Eigen::Index n_loads) {
  const Eigen::MatrixXd x = Eigen::MatrixXd::Random(problem.matrix.n, n_loads);
  const auto lanes = fem::spread_over_lanes<T>(n_loads, kernels);
  fem::BlockVector<T> in(problem.grid.n_nodes, lanes), out(problem.grid.n_nodes, lanes);
  fem::to_block(x, 0, problem.order.node_place, lanes, in);
  const fem::ElasticOperator<T> stiffness(problem.grid, problem.order, problem.elastic, problem.metric,
                                          kernels);
  auto copies = stiffness.work_space(lanes);
  Eigen::MatrixXd y(x.rows(), n_loads);
  for (int twice = 0; twice < 2; ++twice) stiffness.apply(lanes, in, out, copies);  // nothing is left over
  fem::from_block(out, lanes, problem.order.node_place, 0, y);
  const Eigen::MatrixXd expected = fem::multiply(problem.matrix, x);
  return (y - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff();
}

// Sums of some hundred products in another order: some units of rounding.
TEST(ElasticOperator, IsTheAssembledMatrix) {
  for (const int degree : {1, 2, 3}) {
    const Problem problem(degree);
    for (const auto* kernels : variants())
      for (const int n_loads : {1, 5, 12}) {
        EXPECT_LT(difference<double>(problem, *kernels, n_loads), 1e-14)
            << degree << " " << kernels->widths_double[0] << " " << n_loads;
        EXPECT_LT(difference<float>(problem, *kernels, n_loads), 1e-5)
            << degree << " " << kernels->widths_float[0] << " " << n_loads;
      }
  }
}

TEST(ElasticOperator, DiagonalBlocksAreThoseOfTheMatrix) {
  const Problem problem(2);
  const auto blocks = fem::diagonal_blocks(problem.grid, problem.order, problem.metric, problem.elastic);
  double largest = 0;
  for (std::size_t i = 0; i < problem.grid.n_nodes; ++i)
    for (int c = 0; c < 3; ++c)
      for (int a = c; a < 3; ++a) {
        const double k = problem.matrix.value[problem.matrix.column_begin[3 * i + c] + a - c];
        const double* block = &blocks[9 * std::size_t(problem.order.node_place[i])];
        const double scale = problem.matrix.value[problem.matrix.column_begin[3 * i]];
        for (const double b : {block[3 * c + a], block[3 * a + c]})
          largest = std::max(largest, std::abs(b - k) / scale);
      }
  EXPECT_LT(largest, 1e-13);
}

}  // namespace

// Of a matrix whose nodes are in another order, the product with vectors in that order is the product, in
// that order: the same sums, added up another way.
TEST(SymmetricMatrix, InAnotherOrderIsTheSame) {
  const Problem problem(2);
  const auto n_nodes = problem.grid.n_nodes;
  std::vector<std::int32_t> order(n_nodes);
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  const auto in_order = [&](const Eigen::MatrixXd& x) {
    Eigen::MatrixXd result(x.rows(), x.cols());
    for (std::size_t p = 0; p < n_nodes; ++p)
      result.middleRows<3>(Eigen::Index(3 * p)) = x.middleRows<3>(3 * Eigen::Index(order[p]));
    return result;
  };
  const Eigen::MatrixXd x = Eigen::MatrixXd::Random(problem.matrix.n, 2);
  const auto matrix = fem::permuted(problem.matrix, order);
  const Eigen::MatrixXd expected = in_order(fem::multiply(problem.matrix, x));
  EXPECT_LT((fem::multiply(matrix, in_order(x)) - expected).cwiseAbs().maxCoeff(),
            1e-13 * expected.cwiseAbs().maxCoeff());
  for (std::int64_t j = 0; j < matrix.n; ++j)  // as CHOLMOD wants it: the diagonal first, rows ascending
    for (auto k = matrix.column_begin[j]; k < matrix.column_begin[j + 1]; ++k)
      ASSERT_EQ(matrix.row[k] > (k == matrix.column_begin[j] ? j - 1 : matrix.row[k - 1]), true) << j;
}

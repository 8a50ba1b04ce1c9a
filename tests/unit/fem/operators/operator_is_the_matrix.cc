#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "fem/multigrid/coarse_space.h"
#include "fem/operators/elastic_operator.h"
#include "fem/triangulation/body_grid.h"
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
  /// @param n_cycles  of refinement: every seventh cell is cut
  explicit Problem(int degree, int n_cycles = 0, fem_tests::ShaftBody shaft = fem_tests::eccentric_shaft(2)) {
    shaft.body.degree = degree;
    grid = fem::make_grid(shaft.body);
    for (int cycle = 0; cycle < n_cycles; ++cycle) {
      auto& cells_cut = shaft.body.refinements.emplace_back().cells;
      for (std::size_t c = 0; c < grid.n_cells(); c += 7) cells_cut.push_back(std::int32_t(c));
      grid = fem::make_grid(shaft.body);
    }
    const auto cells = fem::cells_of_nodes(grid);
    const auto colours = fem::colour_cells(grid, cells);
    const auto graph = fem::make_node_graph(grid, cells);
    matrix = fem::make_matrix(graph);
    fem::assemble_stiffness(grid, colours, graph, fem::lame(shaft.body.material), matrix);
    order = fem::order_cells(grid);
    metric = fem::cell_metric(grid, order);
    elastic = fem::lame(shaft.body.material);
    is_hanging.assign(grid.n_nodes, 0);
    for (const auto node : grid.hanging.node) is_hanging[std::size_t(node)] = 1;
  }
  void clear_hanging(Eigen::MatrixXd& x) const {
    for (const auto node : grid.hanging.node) x.middleRows<3>(3 * Eigen::Index(node)).setZero();
  }
  fem::Grid grid;
  fem::SymmetricMatrix matrix;
  fem::CellOrder order;
  std::vector<double> metric;
  fem::Lame elastic;
  std::vector<char> is_hanging;
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
  Eigen::MatrixXd of_masters = x;  // what hanging nodes have on entry does not count
  problem.clear_hanging(of_masters);
  const Eigen::MatrixXd expected = fem::multiply(problem.matrix, of_masters);
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

// Turns red: values of masters not set before the product, forces left at hanging nodes after it.
TEST(ElasticOperator, IsTheAssembledMatrixOfRefinedMeshes) {
  for (const int degree : {2, 3}) {
    const Problem problem(degree, 1);
    ASSERT_GT(problem.grid.hanging.n(), 100u);
    for (const auto* kernels : variants()) {
      EXPECT_LT(difference<double>(problem, *kernels, 5), 1e-14)
          << degree << " " << kernels->widths_double[0];
      EXPECT_LT(difference<float>(problem, *kernels, 5), 1e-5) << degree << " " << kernels->widths_float[0];
    }
  }
}

void expect_diagonal_blocks_of_matrix(const Problem& problem) {
  const auto blocks = fem::diagonal_blocks(problem.grid, problem.order, problem.metric, problem.elastic);
  double largest = 0;
  for (std::size_t i = 0; i < problem.grid.n_nodes; ++i)
    for (int c = 0; c < 3; ++c)
      for (int a = c; a < 3; ++a) {
        if (problem.is_hanging[i] != 0) {
          ASSERT_EQ(blocks[9 * std::size_t(problem.order.node_place[i]) + std::size_t(3 * c + a)], 0);
          continue;
        }
        const double k = problem.matrix.value[problem.matrix.column_begin[3 * i + c] + a - c];
        const double* block = &blocks[9 * std::size_t(problem.order.node_place[i])];
        const double scale = problem.matrix.value[problem.matrix.column_begin[3 * i]];
        for (const double b : {block[3 * c + a], block[3 * a + c]})
          largest = std::max(largest, std::abs(b - k) / scale);
      }
  EXPECT_LT(largest, 1e-13);
}

TEST(ElasticOperator, DiagonalBlocksAreThoseOfTheMatrix) {
  expect_diagonal_blocks_of_matrix(Problem(2));
  expect_diagonal_blocks_of_matrix(Problem(2, 1));  // what hangs on a node counts, too
}

/// y = M x of block vectors, three components alike.
fem::BlockVector<float> multiplied(const fem::NodeMatrix& matrix, const fem::BlockVector<float>& x,
                                   const fem::Lanes& lanes, std::size_t n_rows) {
  fem::BlockVector<float> y(n_rows, lanes);
  for (const auto& group : lanes.groups) {
    const std::size_t width = std::size_t(group.width);
    for (std::size_t row = 0; row < n_rows; ++row)
      for (auto k = matrix.begin[row]; k < matrix.begin[row + 1]; ++k)
        for (std::size_t l = 0; l < 3 * width; ++l)
          y.data()[3 * n_rows * group.first_lane + 3 * width * row + l] +=
              matrix.block[std::size_t(k)] *
              x.data()[3 * x.n_nodes() * group.first_lane +
                       3 * width * std::size_t(matrix.column[std::size_t(k)]) + l];
  }
  return y;
}

/// Moves all nodes to where the trilinear interpolation of the corners has them: rigid rotations are
/// trilinear then.
void make_straight(Problem& problem, const fem::NodeMatrix& interpolation,
                   const std::vector<std::int32_t>& node_of_corner) {
  const auto before = problem.grid.xyz_m;
  for (std::size_t i = 0; i < problem.grid.n_nodes; ++i) {
    const auto row = std::size_t(problem.order.node_place[i]);
    for (std::size_t d = 0; d < 3; ++d) {
      double sum = 0;
      for (auto k = std::size_t(interpolation.begin[row]); k < std::size_t(interpolation.begin[row + 1]);
           ++k) {
        const auto corner = node_of_corner[std::size_t(interpolation.column[k])];
        sum += double(interpolation.block[k]) * before[3 * std::size_t(corner) + d];
      }
      problem.grid.xyz_m[3 * i + d] = sum;
    }
  }
  problem.metric = fem::cell_metric(problem.grid, problem.order);
}

/// Corners are numbered in the order of their places.
std::vector<std::int32_t> nodes_of_corners(const Problem& problem) {
  std::vector<std::int32_t> node_at(problem.grid.n_nodes, -1), nodes;
  for (std::size_t c = 0; c < problem.grid.n_cells(); ++c)
    for (const int i : fem::corner_nodes(problem.grid.shape())) {
      const auto node = problem.grid.nodes_of(c)[i];
      node_at[std::size_t(problem.order.node_place[std::size_t(node)])] = node;
    }
  for (const auto node : node_at)
    if (node >= 0) nodes.push_back(node);
  return nodes;
}

// The trilinear level answers the forces of one of its own displacements with that displacement, but for a
// rigid motion, which carries no force where cells are straight. Turns red: corners that hang but move by
// themselves, so that the level is no part of the displacements above it.
TEST(CoarseSpace, InvertsTheProductWithItsInterpolation) {
  for (const int n_cycles : {0, 1}) {
    Problem problem(2, n_cycles, fem_tests::rod(8));
    const auto& kernels = fem::kernel::kernels_for_this_machine();
    const fem::Lame unit{problem.elastic.lambda_Pa / 1e11, problem.elastic.mu_Pa / 1e11};
    const auto space = [&] {
      return std::make_unique<fem::CoarseSpace>(problem.grid, problem.order, problem.metric, unit,
                                                fem::CoarseLevel::factorised, kernels);
    };
    make_straight(problem, space()->interpolation(), nodes_of_corners(problem));
    const auto made = space();
    const fem::CoarseSpace& coarse = *made;
    const fem::ElasticOperator<float> stiffness(problem.grid, problem.order, unit, problem.metric, kernels);
    const auto lanes = fem::spread_over_lanes<float>(1, kernels);
    auto copies = stiffness.work_space(lanes);
    const auto force_of = [&](const fem::BlockVector<float>& of_corners) {
      auto fine = multiplied(coarse.interpolation(), of_corners, lanes, problem.grid.n_nodes);
      fem::BlockVector<float> image(problem.grid.n_nodes, lanes);
      stiffness.apply(lanes, fine, image, copies);
      return multiplied(coarse.restriction(), image, lanes, coarse.n_nodes());
    };
    fem::BlockVector<float> x(coarse.n_nodes(), lanes), answer(coarse.n_nodes(), lanes);
    std::mt19937 random(3);
    for (std::size_t i = 0; i < 3 * coarse.n_nodes() * lanes.n_lanes; ++i)
      x.data()[i] = float(random() % 2000) / 1000 - 1;
    auto work = coarse.work_space(lanes);
    const auto force = force_of(x);
    coarse.solve(lanes, force, answer, work);
    const auto again = force_of(answer);
    double largest = 0, difference = 0, sum = 0;  // of the one load
    for (std::size_t i = 0; i < 3 * coarse.n_nodes(); ++i) {
      largest = std::max(largest, std::abs(double(force.data()[i * lanes.n_lanes])));
      sum += double(again.data()[i * lanes.n_lanes]);
      difference = std::max(difference, std::abs(double(force.data()[i * lanes.n_lanes]) -
                                                 double(again.data()[i * lanes.n_lanes])));
    }
    EXPECT_GT(largest, 0);
    ASSERT_TRUE(std::isfinite(sum));
    EXPECT_LT(difference, 1e-4 * largest) << n_cycles << ": single precision leaves 1e-6 and more";
  }
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

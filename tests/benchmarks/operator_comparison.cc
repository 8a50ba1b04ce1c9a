#include "tests/benchmarks/operator_comparison.h"

#include <cstdio>
#include <random>
#include <vector>

#include "fem/mesh/mesh_reader.h"
#include "fem/operators/elastic_operator.h"
#include "fem/operators/stiffness.h"
#include "tests/benchmarks/dealii_operator.h"
#include "tests/benchmarks/process.h"

namespace measure {

namespace {

constexpr int n_loads = 12, n_calls = 9;

/// Rows of the whole matrix, and the product with vectors that lie side by side.
struct Csr {
  explicit Csr(const fem::SymmetricMatrix& lower) : begin(lower.n + 1, 0) {
    for (int pass = 0; pass < 2; ++pass) {
      auto next = begin;
      for (std::int64_t j = 0; j < lower.n; ++j)
        for (auto k = lower.column_begin[j]; k < lower.column_begin[j + 1]; ++k) {
          const auto add = [&](std::int64_t i, std::int64_t c) {
            if (pass == 0) {
              ++begin[i + 1];
            } else {
              column[next[i]] = static_cast<std::int32_t>(c);
              value[next[i]++] = lower.value[k];
            }
          };
          add(lower.row[k], j);
          if (lower.row[k] != j) add(j, lower.row[k]);
        }
      if (pass == 1) return;
      for (std::int64_t i = 0; i < lower.n; ++i) begin[i + 1] += begin[i];
      column.resize(begin.back());
      value.resize(begin.back());
    }
  }
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, n_loads, Eigen::RowMajor>;
  void apply(const Rows& x, Rows& y) const {
    for (std::size_t i = 0; i + 1 < begin.size(); ++i) {
      Eigen::Matrix<double, 1, n_loads> sum = Eigen::Matrix<double, 1, n_loads>::Zero();
      for (auto k = begin[i]; k < begin[i + 1]; ++k) sum += value[k] * x.row(column[k]);
      y.row(i) = sum;
    }
  }
  std::vector<std::int64_t> begin;
  std::vector<std::int32_t> column;
  std::vector<double> value;
};

template <typename T>
double ours_s(const fem::Grid& grid, const fem::Lame& elastic) {
  const auto order = fem::order_cells(grid);
  const fem::ElasticOperator<T> stiffness(grid, order, elastic, fem::cell_metric(grid, order));
  const auto lanes = fem::spread_over_lanes<T>(n_loads, fem::kernel::kernels_for_this_machine());
  fem::BlockVector<T> x(grid.n_nodes, lanes), y(grid.n_nodes, lanes);
  fem::to_block(Eigen::MatrixXd::Random(3 * grid.n_nodes, n_loads).eval(), 0, order.node_place, lanes, x);
  auto copies = stiffness.work_space(lanes);
  return smallest_cpu_s([&] { stiffness.apply(lanes, x, y, copies); }, n_calls);
}

double csr_s(const fem::Grid& grid, const fem::Material& material) {
  const auto cells = fem::cells_of_nodes(grid);
  const auto graph = fem::make_node_graph(grid, cells);
  auto matrix = fem::make_matrix(graph);
  fem::assemble_stiffness(grid, fem::colour_cells(grid, cells), graph, fem::lame(material), matrix);
  const Csr csr(matrix);
  matrix = {};
  Csr::Rows x = Csr::Rows::Random(3 * grid.n_nodes, n_loads), y(3 * grid.n_nodes, n_loads);
  return smallest_cpu_s([&] { csr.apply(x, y); }, 5);
}

}  // namespace

void compare_operators(const char* name, const fem::Body& body, bool distorted) {
  const OneThread alone;
  auto grid = fem::read_grid(body);
  if (distorted) {
    std::mt19937 random(1);
    const double size = grid.position(grid.nodes_of(0)[2])[2] - grid.position(grid.nodes_of(0)[0])[2];
    std::uniform_real_distribution<double> shift(-0.01 * std::abs(size), 0.01 * std::abs(size));
    for (auto& x : grid.xyz_m) x += shift(random);
  }
  const auto elastic = fem::lame(body.material);
  const double ours = ours_s<double>(grid, elastic), in_float = ours_s<float>(grid, elastic);
  int n_lanes = 0;
  double dealii = 0;
  {
    DealiiOperator other(body, distorted);
    n_lanes = other.n_lanes();
    dealii = n_loads * smallest_cpu_s([&] { other.apply(); }, n_calls);
  }
  const double sparse = csr_s(grid, body.material), rate = 3e-6 * double(grid.n_nodes) * n_loads;
  std::printf("K x, %s: %zu unknowns, one thread, million unknowns/s per load case\n", name,
              3 * grid.n_nodes);
  std::printf(
      "  ours, %d load cases %.0f (in float %.0f); MatrixFree, %d lane(s) %.1f; CSR, %d vectors %.1f\n",
      n_loads, rate / ours, rate / in_float, n_lanes, rate / dealii, n_loads, rate / sparse);
  std::printf("  ratio: %.2f of MatrixFree, %.2f of CSR\n", dealii / ours, sparse / ours);
  std::fflush(stdout);
}

}  // namespace measure

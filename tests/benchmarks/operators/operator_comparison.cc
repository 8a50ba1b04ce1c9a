#include "tests/benchmarks/operators/operator_comparison.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "fem/operators/elastic_operator.h"
#include "fem/operators/stiffness.h"
#include "fem/triangulation/body_grid.h"
#include "tests/benchmarks/operators/dealii_operator.h"
#include "tests/benchmarks/solvers/process.h"

namespace measure {

namespace {

/// Twelve as in the solvers' comparison, where half of the second AVX-512 register is empty; sixteen fill
/// two.
constexpr int n_loads = 12, n_full_loads = 16, n_rounds = 40, n_calls = 4;
/// Of the largest entry. Rounding: MatrixFree takes Jacobians for equal within 1024 eps = 2.3e-13 of their
/// size, and batches of other widths find others alike.
constexpr double same_product = 1e-12;

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
struct Ours {
  Ours(const fem::Grid& grid, const fem::Lame& elastic, const Eigen::MatrixXd& columns)
      : order(fem::order_cells(grid)),
        stiffness(grid, order, elastic, fem::cell_metric(grid, order)),
        lanes(
            fem::spread_over_lanes<T>(std::size_t(columns.cols()), fem::kernel::kernels_for_this_machine())),
        x(grid.n_nodes, lanes),
        y(grid.n_nodes, lanes),
        copies(stiffness.work_space(lanes)) {
    fem::to_block(columns, 0, order.node_place, lanes, x);
  }
  void apply() { stiffness.apply(lanes, x, y, copies); }

  fem::CellOrder order;
  fem::ElasticOperator<T> stiffness;
  fem::Lanes lanes;
  fem::BlockVector<T> x, y, copies;
};

/// Smallest CPU seconds of calls that take turns: other work on the machine meets all alike.
std::vector<double> in_turns_s(const std::vector<std::function<void()>>& calls) {
  std::vector<double> smallest(calls.size(), 1e300);
  for (int round = 0; round < n_rounds; ++round)
    for (std::size_t i = 0; i < calls.size(); ++i)
      smallest[i] = std::min(smallest[i], smallest_cpu_s(calls[i], n_calls));
  return smallest;
}

/// MatrixFree's y for the first load.
/// @param unknowns  number in the product of each of ours
Eigen::VectorXd first_load(MatrixFreeProduct& product, const std::vector<std::size_t>& unknowns,
                           const Eigen::MatrixXd& x) {
  for (std::size_t i = 0; i < unknowns.size(); ++i) product.x()[unknowns[i]] = x(Eigen::Index(i), 0);
  product.apply();
  Eigen::VectorXd y(x.rows());
  for (std::size_t i = 0; i < unknowns.size(); ++i) y[Eigen::Index(i)] = product.y()[unknowns[i]];
  return y;
}

/// @throws std::runtime_error if they are too far apart
double difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const std::string& what) {
  const double apart = (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
  if (apart < same_product) return apart;
  char text[160];
  std::snprintf(text, sizeof text, "K x of %s differ by %.1e of the largest entry: at most %.0e is rounding",
                what.c_str(), apart, same_product);
  throw std::runtime_error(text);
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
  auto grid = fem::make_grid(body);
  const DealiiOperator other(body, distorted);
  other.place_nodes(grid);
  const auto unknowns = other.unknowns_of(grid);
  const auto elastic = fem::lame(body.material);
  const Eigen::MatrixXd all = Eigen::MatrixXd::Random(Eigen::Index(unknowns.size()), n_full_loads);
  const Eigen::MatrixXd x = all.leftCols(n_loads);
  Ours<double> ours(grid, elastic, x);
  Ours<float> in_float(grid, elastic, x);
  Ours<double> full(grid, elastic, all);
  Ours<float> full_in_float(grid, elastic, all);
  auto products = other.wide();
  products.insert(products.begin(), other.one_lane());

  ours.apply();
  Eigen::MatrixXd y(x.rows(), x.cols());
  fem::from_block(ours.y, ours.lanes, ours.order.node_place, 0, y);
  const auto with_one_lane = first_load(*products[0], unknowns, x);
  const double from_ours = difference(with_one_lane, y.col(0), "MatrixFree with one lane and ours");
  double from_one_lane = 0;
  for (std::size_t i = 1; i < products.size(); ++i)
    from_one_lane = std::max(
        from_one_lane,
        difference(first_load(*products[i], unknowns, x), with_one_lane,
                   "MatrixFree with one lane and " + std::to_string(products[i]->n_lanes()) + " lanes"));

  std::vector<std::function<void()>> calls{[&] { ours.apply(); }, [&] { in_float.apply(); },
                                           [&] { full.apply(); }, [&] { full_in_float.apply(); }};
  for (const auto& product : products) calls.emplace_back([&p = *product] { p.apply(); });
  auto seconds = in_turns_s(calls);
  for (int i = 0; i < 4; ++i) seconds[i] /= i < 2 ? n_loads : n_full_loads;  // per load, as MatrixFree's
  const auto rate = [&](double per_load_s) { return 1e-6 * double(unknowns.size()) / per_load_s; };
  const auto print_other = [&](const std::string& what, double per_load_s) {
    std::printf("  %-31s %6.1f; ours is %.2f and %.2f times as fast\n", what.c_str(), rate(per_load_s),
                per_load_s / seconds[0], per_load_s / seconds[2]);
  };
  std::printf("K x, %s: %zu unknowns, one thread, million unknowns/s per load case\n", name, unknowns.size());
  std::printf("  ours, %d and %d load cases      %6.1f and %.1f (in float %.1f and %.1f)\n", n_loads,
              n_full_loads, rate(seconds[0]), rate(seconds[2]), rate(seconds[1]), rate(seconds[3]));
  for (std::size_t i = 0; i < products.size(); ++i)
    print_other("deal.II's MatrixFree, " + std::to_string(products[i]->n_lanes()) + " lane(s)",
                seconds[4 + i]);
  if (products.back()->n_lanes() < 8)
    std::printf("  MatrixFree with eight lanes: not here, the machine has no AVX-512\n");
  print_other("CSR, " + std::to_string(n_loads) + " vectors", csr_s(grid, body.material) / n_loads);
  std::printf("  largest differences of K x: one lane from ours %.1e, more lanes from one %.1e\n", from_ours,
              from_one_lane);
  std::fflush(stdout);
}

}  // namespace measure

/// The solvers of unit responses on the shaft of shaft.toml, refined evenly: the operator against deal.II's
/// and a sparse matrix, and twelve load cases directly and iteratively. Ratios of one run.
///   solver_benchmarks <shaft.toml> [largest number of unknowns, default 700000]
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "dealii_operator.h"
#include "fem/direct_solve.h"
#include "fem/elastic_operator.h"
#include "fem/iterative_solve.h"
#include "fem/mesh_reader.h"
#include "fem/model.h"
#include "fem/parallel.h"
#include "fem/rigid_modes.h"
#include "fem/solver_prediction.h"
#include "fem/surface_loads.h"
#include "pipelines/body_mesh.h"
#include "pipelines/scene.h"
#include "tests/benchmarks/benchmark_shaft.h"

namespace {

constexpr int n_threads = 2;
constexpr int n_loads = 12;

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

template <typename Call>
double smallest_s(const Call& call, int n_calls = 9) {
  double smallest = 1e300;
  for (int i = 0; i < n_calls; ++i) {
    const double start = seconds();
    call();
    smallest = std::min(smallest, seconds() - start);
  }
  return smallest;
}

/// Largest resident memory since the last reset [GB].
double peak_gigabytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmHWM:", 0) == 0) return 1024e-9 * std::atof(line.c_str() + 6);
  return 0;
}
void reset_peak() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5;
}

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
    fem::parallel_for(begin.size() - 1, 1000, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        Eigen::Matrix<double, 1, n_loads> sum = Eigen::Matrix<double, 1, n_loads>::Zero();
        for (auto k = begin[i]; k < begin[i + 1]; ++k) sum += value[k] * x.row(column[k]);
        y.row(i) = sum;
      }
    });
  }
  std::vector<std::int64_t> begin;
  std::vector<std::int32_t> column;
  std::vector<double> value;
};

template <typename T>
double our_operator_s(const fem::Grid& grid, const fem::Lame& elastic) {
  const auto order = fem::order_cells(grid);
  const fem::ElasticOperator<T> stiffness(grid, order, elastic, fem::cell_metric(grid, order));
  const auto lanes = fem::spread_over_lanes<T>(n_loads, fem::kernel::kernels_for_this_machine());
  fem::BlockVector<T> x(grid.n_nodes, lanes), y(grid.n_nodes, lanes);
  fem::to_block(Eigen::MatrixXd::Random(3 * grid.n_nodes, n_loads).eval(), 0, order.node_place, lanes, x);
  auto copies = stiffness.work_space(lanes);
  return smallest_s([&] { stiffness.apply(lanes, x, y, copies); });
}

void compare_operators(const fem::Body& body, const fem::Grid& grid) {
  const auto elastic = fem::lame(body.material);
  const double rate = 1e-6 * 3 * double(grid.n_nodes) * n_loads;
  const double ours = our_operator_s<double>(grid, elastic), in_float = our_operator_s<float>(grid, elastic);
  double dealii = 0;
  int lanes = 0;
  {
    measure::DealiiOperator other(body);
    lanes = other.n_lanes();
    dealii = n_loads * smallest_s([&] { other.apply(); });
  }
  double sparse = 0;
  {
    const auto cells = fem::cells_of_nodes(grid);
    const auto graph = fem::make_node_graph(grid, cells);
    auto matrix = fem::make_matrix(graph);
    fem::assemble_stiffness(grid, fem::colour_cells(grid, cells), graph, fem::lame(body.material), matrix);
    const Csr csr(matrix);
    matrix = {};
    Csr::Rows x = Csr::Rows::Random(3 * grid.n_nodes, n_loads), y(3 * grid.n_nodes, n_loads);
    sparse = smallest_s([&] { csr.apply(x, y); }, 5);
  }
  std::printf(
      "  operator, million unknowns/s per load case: ours %.0f (float %.0f), MatrixFree with %d lane(s) "
      "%.0f, "
      "CSR times %d vectors %.0f\n",
      rate / ours, rate / in_float, lanes, rate / dealii, n_loads, rate / sparse);
  std::printf("  ratio: %.2f of MatrixFree, %.2f of CSR\n", dealii / ours, sparse / ours);
}

void compare_solvers(const fem::Body& body, const fem::Grid& grid,
                     const std::vector<fem::UnitLoad>& unit_loads) {
  const auto cells = fem::cells_of_nodes(grid);
  const auto colours = fem::colour_cells(grid, cells);
  const auto integrals = fem::integrate_nodes(grid, colours);
  fem::BalancedLoads loads;
  loads.force = fem::load_vectors(grid, integrals, body.material.density_kg_m3, unit_loads);
  loads.norm = loads.force.colwise().norm();
  loads.largest_entry = loads.force.colwise().lpNorm<Eigen::Infinity>();
  const fem::RigidBalance rigid(grid, integrals);
  rigid.balance(loads.force);
  const auto silent = [](double, const std::string&) {};
  const auto report = fem::choose_solver(grid, body.material, n_loads, {}, fem::physical_memory());

  const auto run = [&](const char* name, const fem::SolverCost& predicted, double& taken_s,
                       const auto& call) {
    reset_peak();
    const double before = peak_gigabytes(), start = seconds();
    fem::Solution solution = call();
    taken_s = seconds() - start;
    const double peak = peak_gigabytes() - before;
    std::printf(
        "  %-9s %7.2f s, peak %5.2f GB (counted %5.2f), residual %.1e, %d iterations; predicted %.2f s, %.2f "
        "GB\n",
        name, taken_s, peak, 1e-9 * solution.bytes, solution.residual, solution.n_iterations,
        predicted.seconds, 1e-9 * predicted.bytes);
    rigid.remove_motion(solution.displacement);
    return std::pair(std::move(solution.displacement), peak);
  };
  double iterative_s = 0, direct_s = 0;
  const auto [iterative, iterative_GB] = run("iterative", report.predicted_iterative, iterative_s, [&] {
    std::string failure;
    auto solution = fem::solve_iteratively(grid, body.material, loads, {}, silent, failure);
    if (!solution) std::printf("  %s\n", failure.c_str());
    return solution ? *solution : fem::Solution{loads.force, 0, 0, 0, 0, 0};
  });
  if (1.2 * report.predicted_direct.bytes > fem::physical_memory()) {
    std::printf("  direct: left out, %.0f GB predicted\n", 1e-9 * report.predicted_direct.bytes);
    return;
  }
  const auto [direct, direct_GB] = run("direct", report.predicted_direct, direct_s, [&] {
    return fem::solve_directly(grid, cells, colours, body.material, loads, silent);
  });
  const double apart =
      ((iterative - direct).colwise().norm().array() / direct.colwise().norm().array()).maxCoeff();
  std::printf("  ratio: %.2f in time, %.3f in memory; answers differ by %.1e; automatic takes the %s one\n",
              direct_s / iterative_s, iterative_GB / direct_GB, apart,
              report.used == fem::Solver::direct ? "direct" : "iterative");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: solver_benchmarks <shaft.toml> [largest number of unknowns]\n");
    return 2;
  }
  const fem::Environment environment(argc, argv, n_threads);
  const double most = argc > 2 ? std::atof(argv[2]) : 7e5;
  const auto scene = pipelines::read_scene(argv[1]);
  const auto directory =
      std::filesystem::temp_directory_path() / ("solver_benchmarks_" + std::to_string(getpid()));
  std::filesystem::create_directory(directory);
  for (const auto& refinement : {measure::Refinement{2, 16}, {4, 24}, {4, 36}, {6, 48}, {8, 68}}) {
    const auto part = measure::refined_shaft(scene, refinement);
    const auto mesh = pipelines::build_mesh(part, directory / "shaft.msh");
    const auto body = pipelines::to_fem_body(mesh, part.material);
    const auto grid = fem::read_grid(body);
    if (3.0 * double(grid.n_nodes) > most) break;
    std::printf("%zu unknowns, %zu cells of degree 2, aspect up to %.1f, %d load cases, %d threads\n",
                3 * grid.n_nodes, grid.n_cells(), fem::largest_aspect(grid), n_loads, n_threads);
    compare_operators(body, grid);
    compare_solvers(body, grid, measure::seat_loads(mesh));
    std::fflush(stdout);
  }
  std::filesystem::remove_all(directory);
}

#include "fem/solvers/iterative_solve.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "fem/common/memory.h"
#include "fem/common/parallel.h"
#include "fem/solvers/block_cg.h"

namespace fem {

namespace {

std::string describe(BlockCgEnd end, int n_iterations, double residual) {
  std::ostringstream text;
  text << "the iteration ";
  if (end == BlockCgEnd::too_many_iterations) text << "did not converge";
  if (end == BlockCgEnd::not_falling) text << "stalled";
  if (end == BlockCgEnd::broke_down) text << "broke down";
  if (end == BlockCgEnd::converged) text << "converged to a residual of " << residual << " only";
  text << " after " << n_iterations << " steps";
  return text.str();
}

/// Solves blocks of load cases, each load scaled to size 1 on the way.
class BlockSolver {
public:
  BlockSolver(const CellOrder& order, const ElasticOperator<double>& stiffness,
              const PolynomialMultigrid& multigrid, const SolverChoice& choice)
      : order_(order), stiffness_(stiffness), multigrid_(multigrid), choice_(choice) {}

  /// Load cases first .. first + n - 1, of a body of modulus `modulus_Pa` times that of the operator.
  /// @param solution  their columns are filled; its bytes, iterations and residual are at least theirs
  BlockCgEnd solve(const BalancedLoads& loads, Eigen::Index first, Eigen::Index n, double modulus_Pa,
                   Solution& solution) const {
    const auto& kernels = kernel::kernels_for_this_machine();
    const Lanes lanes = spread_over_lanes<double>(std::size_t(n), kernels);
    BlockVector<double> u(stiffness_.n_nodes(), lanes), r(stiffness_.n_nodes(), lanes);
    const Eigen::ArrayXd scale = loads.largest_entry.segment(first, n).transpose();
    const Eigen::ArrayXd norm = loads.norm.segment(first, n).transpose().array() / scale, to_unit = 1 / scale,
                         from_unit = scale / modulus_Pa;
    to_block(loads.force, first, order_.node_place, lanes, r, to_unit.data());
    int n_iterations = 0;
    double residual = 0;
    // A second round starts from the residual computed anew, should the updated one have drifted away.
    for (int round = 0; round < 2; ++round) {
      const auto result =
          solve_block(stiffness_, multigrid_, kernels, lanes,
                      {choice_.relative_tolerance * norm, choice_.max_iterations - n_iterations}, u, r);
      n_iterations += result.n_iterations;
      solution.bytes = std::max(solution.bytes, static_cast<double>(result.bytes));
      solution.n_iterations = std::max(solution.n_iterations, n_iterations);
      if (result.end != BlockCgEnd::converged) return result.end;
      to_block(loads.force, first, order_.node_place, lanes, r, to_unit.data());
      residual = (subtract_image(stiffness_, kernels, lanes, u, r).head(n).sqrt() / norm).maxCoeff();
      if (residual <= acceptable_residual) break;
    }
    from_block(u, lanes, order_.node_place, first, solution.displacement, from_unit.data());
    solution.residual = std::max(solution.residual, residual);
    return BlockCgEnd::converged;
  }

private:
  const CellOrder& order_;
  const ElasticOperator<double>& stiffness_;
  const PolynomialMultigrid& multigrid_;
  const SolverChoice& choice_;
};

}  // namespace

std::size_t loads_per_block(std::size_t n_dofs) {
  constexpr std::size_t vectors_bytes = 1'600'000'000, per_unknown = 48;  // four of doubles, four of floats
  return std::clamp<std::size_t>(vectors_bytes / (per_unknown * n_dofs) / 4 * 4, 4, 16);
}

std::optional<Solution> iterate(const Grid& grid, const CellOrder& order, const PerCell<Lame>& elastic,
                                double modulus_Pa, const BalancedLoads& loads, Eigen::Index width,
                                const SolverChoice& choice, const StepReport& progress, std::string& failure,
                                const SharedNodes* shared) {
  const auto& kernels = kernel::kernels_for_this_machine();
  release_free_memory();  // of meshing
  auto metric = cell_metric(grid, order);
  const PolynomialMultigrid multigrid(grid, order, metric, elastic, choice.coarse_level, kernels, shared);
  const ElasticOperator<double> stiffness(grid, order, elastic, std::move(metric), kernels,
                                          multigrid.targets(), shared);
  release_free_memory();

  const SerialBlas serial;  // the coarse level's solves are too small to share
  const BlockSolver solver(order, stiffness, multigrid, choice);
  Solution solution;
  solution.displacement.resize(loads.force.rows(), loads.force.cols());
  const Eigen::Index n_loads = loads.force.cols(), n_blocks = (n_loads + width - 1) / width;
  // Blocks of even size, in fours: what a register holds.
  const Eigen::Index even = std::min(width, ((n_loads + n_blocks - 1) / n_blocks + 3) / 4 * 4);
  for (Eigen::Index first = 0; first < n_loads; first += even) {
    progress(0.2 + 0.65 * double(first) / double(n_loads), "iterate");
    release_free_memory();  // the vectors of the block before
    const auto end = solver.solve(loads, first, std::min(even, n_loads - first), modulus_Pa, solution);
    if (end != BlockCgEnd::converged || !(solution.residual <= acceptable_residual)) {
      failure = describe(end, solution.n_iterations, solution.residual);
      return std::nullopt;
    }
  }
  solution.bytes += static_cast<double>(stiffness.bytes() + multigrid.bytes());
  return solution;
}

std::optional<Solution> solve_iteratively(const Grid& grid, const CellMaterials& materials,
                                          const BalancedLoads& loads, const SolverChoice& choice,
                                          const StepReport& progress, std::string& failure) {
  progress(0.05, "prepare multigrid");
  const double modulus_Pa = materials.largest_modulus_Pa();
  return iterate(grid, order_cells(grid), materials.elastic(modulus_Pa), modulus_Pa, loads,
                 static_cast<Eigen::Index>(loads_per_block(3 * grid.n_nodes)), choice, progress, failure);
}

}  // namespace fem

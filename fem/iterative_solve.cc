#include "fem/iterative_solve.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "fem/block_cg.h"
#include "fem/parallel.h"

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

/// One block of load cases, each scaled to size 1 in `force`; solution in the same scale.
class Block {
public:
  Block(const CellOrder& order, const ElasticOperator<double>& stiffness,
        const PolynomialMultigrid& multigrid, const SolverChoice& choice)
      : order_(order), stiffness_(stiffness), multigrid_(multigrid), choice_(choice) {}

  /// @param norm  of the loads as applied, in the same scale
  /// @param solution  on return its bytes, iterations and residual are at least those of this block
  BlockCgEnd solve(const Eigen::MatrixXd& force, const Eigen::ArrayXd& norm, Eigen::MatrixXd& displacement,
                   Solution& solution) const {
    const auto& kernels = kernel::kernels_for_this_machine();
    const Lanes lanes = spread_over_lanes<double>(force.cols(), kernels);
    BlockVector<double> u(stiffness_.n_nodes(), lanes), r(stiffness_.n_nodes(), lanes);
    to_block(force, 0, order_.node_place, lanes, r);
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
      from_block(u, lanes, order_.node_place, 0, displacement);
      Eigen::MatrixXd image(force.rows(), force.cols());
      auto copies = stiffness_.work_space(lanes);
      stiffness_.apply(lanes, u, r, copies);
      from_block(r, lanes, order_.node_place, 0, image);
      image = force - image;
      residual = (image.colwise().norm().transpose().array() / norm).maxCoeff();
      if (residual <= acceptable_residual) break;
      to_block(image, 0, order_.node_place, lanes, r);
    }
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

std::optional<Solution> solve_iteratively(const Grid& grid, const CellMaterials& materials,
                                          const BalancedLoads& loads, const SolverChoice& choice,
                                          const StepReport& progress, std::string& failure) {
  progress(0.05, "prepare multigrid");
  const CellOrder order = order_cells(grid);
  auto metric = cell_metric(grid, order);
  // The modulus is taken out: displacements of unit loads on a body of modulus 1.
  const double modulus_Pa = materials.largest_modulus_Pa();
  const auto elastic = materials.elastic(modulus_Pa);
  const PolynomialMultigrid multigrid(grid, order, metric, elastic);
  const ElasticOperator<double> stiffness(grid, order, elastic, std::move(metric));

  const SerialBlas serial;  // the coarse level's solves are too small to share
  const Block block(order, stiffness, multigrid, choice);
  Solution solution;
  solution.displacement.resize(loads.force.rows(), loads.force.cols());
  const Eigen::Index n_loads = loads.force.cols(),
                     n_blocks = (n_loads + loads_per_block - 1) / loads_per_block,
                     width = (n_loads + n_blocks - 1) / n_blocks;
  for (Eigen::Index first = 0; first < n_loads; first += width) {
    progress(0.2 + 0.65 * double(first) / double(n_loads), "iterate");
    const auto columns = std::min(width, n_loads - first);
    const Eigen::RowVectorXd scale = loads.largest_entry.segment(first, columns);
    const Eigen::MatrixXd force = loads.force.middleCols(first, columns).array().rowwise() / scale.array();
    const Eigen::ArrayXd norm = (loads.norm.segment(first, columns).array() / scale.array()).transpose();
    Eigen::MatrixXd displacement(force.rows(), columns);
    const auto end = block.solve(force, norm, displacement, solution);
    if (end != BlockCgEnd::converged || !(solution.residual <= acceptable_residual)) {
      failure = describe(end, solution.n_iterations, solution.residual);
      return std::nullopt;
    }
    solution.displacement.middleCols(first, columns) =
        displacement.array().rowwise() * (scale / modulus_Pa).array();
  }
  solution.bytes += static_cast<double>(stiffness.bytes() + multigrid.bytes());
  return solution;
}

}  // namespace fem

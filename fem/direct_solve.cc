#include "fem/direct_solve.h"

#include <functional>
#include <future>
#include <optional>

#include "fem/cholmod_factor.h"
#include "fem/clamps.h"
#include "fem/solver_prediction.h"
#include "fem/stiffness.h"
#include "fem/supports.h"

namespace fem {

Solution solve_directly(const Grid& grid, const CellsOfNodes& cells,
                        const std::vector<std::vector<std::int32_t>>& colours, const Material& material,
                        const BalancedLoads& loads, const StepReport& progress) {
  progress(0.05, "assemble");
  const NodeGraph graph = make_node_graph(grid, cells);
  auto order =
      std::async(std::launch::async, order_nodes, std::cref(graph));  // one thread, while others assemble
  SymmetricMatrix matrix = make_matrix(graph);
  assemble_stiffness(grid, colours, graph, material, matrix);
  std::optional<Supports> supports;
  if (loads.clamped.empty())
    supports.emplace(choose_supports(grid), matrix);
  else
    clamp(loads.clamped, matrix);

  progress(0.1, "order");
  CholmodFactor factor(matrix, order.get());
  refuse_large_factor(1e9 * factor.gigabytes(), static_cast<std::size_t>(matrix.n), physical_memory());
  progress(0.25, "factorise");
  factor.factorise(matrix);
  Solution solution;
  solution.factor_gigabytes = factor.gigabytes();
  solution.bytes = 1e9 * solution.factor_gigabytes + 16.0 * static_cast<double>(matrix.value.size());

  progress(0.75, "solve");
  Eigen::MatrixXd free_force = loads.force;
  if (supports) supports->clear(free_force);
  for (const auto unknown : loads.clamped) free_force.row(unknown).setZero();
  solution.displacement = factor.solve(free_force);
  Eigen::MatrixXd rest = free_force - multiply(matrix, solution.displacement);
  solution.residual = rest.colwise().norm().cwiseQuotient(loads.norm).maxCoeff();
  if (solution.residual > acceptable_residual) {
    solution.displacement += factor.solve(rest);
    rest = free_force - multiply(matrix, solution.displacement);
    solution.residual = rest.colwise().norm().cwiseQuotient(loads.norm).maxCoeff();
  }
  if (supports)
    solution.support_reaction = supports->reactions(solution.displacement, loads.force)
                                    .colwise()
                                    .lpNorm<Eigen::Infinity>()
                                    .cwiseQuotient(loads.largest_entry)
                                    .maxCoeff();
  return solution;
}

}  // namespace fem

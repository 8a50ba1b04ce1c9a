#include "fem/solvers/direct_solve.h"

#include <algorithm>
#include <functional>
#include <future>
#include <optional>
#include <sstream>

#include "fem/common/memory.h"
#include "fem/common/parallel.h"
#include "fem/loads/clamps.h"
#include "fem/loads/supports.h"
#include "fem/operators/stiffness.h"
#include "fem/solvers/cholmod_factor.h"
#include "fem/solvers/solver_prediction.h"
#include "fem/values/errors.h"

namespace fem {

namespace {
/// Of one unknown under one load: four columns of the solver, displacement and stress.
constexpr double bytes_per_response = 56;
/// Beyond it displacements are not worth handing on.
constexpr double most_rounding = 0.01;
}  // namespace

double rounding(const Eigen::MatrixXd& rest, const Eigen::MatrixXd& correction,
                const Eigen::MatrixXd& displacement, const BalancedLoads& loads) {
  double worst = 0;
  for (Eigen::Index k = 0; k < rest.cols(); ++k) {
    if (rest.col(k).norm() <= acceptable_residual * loads.norm[k]) continue;
    const double size = displacement.col(k).lpNorm<Eigen::Infinity>();
    worst = std::max(worst, correction.col(k).lpNorm<Eigen::Infinity>() / std::max(size, 1e-300));
  }
  return worst;
}

void refuse_rounding(const Grid& grid, double share) {
  if (share <= most_rounding) return;
  std::ostringstream message;
  message
      << "rounding reaches " << 100 * share << " % of the displacements, " << 100 * most_rounding
      << " % at most are accepted: the body is too slender for its cells (stretched up to 1 : "
      << largest_aspect(grid)
      << ") or its materials too unlike for a solution in double precision; use cells of a more equal shape, "
         "shorten the body, or check lengths and moduli";
  throw SolveFailed(message.str());
}

FactorSize analyse_factor(const Grid& grid, const CellsOfNodes& cells) {
  const NodeGraph graph = make_node_graph(grid, cells);
  return CholmodFactor(make_matrix(graph), order_nodes(graph)).size();
}

Eigen::MatrixXd FactorisedBody::solve(Eigen::MatrixXd force) const {
  for (const auto unknown : held_) force.row(unknown).setZero();
  return factor_->solve(force);
}

std::optional<Solution> solve_directly(const Grid& grid, const CellsOfNodes& cells,
                                       const std::vector<std::vector<std::int32_t>>& colours,
                                       const CellMaterials& materials, const BalancedLoads& loads,
                                       const StepReport& progress,
                                       const std::function<bool(const FactorSize&)>& is_too_expensive,
                                       std::shared_ptr<const FactorisedBody>* kept) {
  progress(0.05, "assemble");
  const NodeGraph graph = make_node_graph(grid, cells);
  auto order =
      std::async(std::launch::async, order_nodes, std::cref(graph));  // one thread, while others assemble
  SymmetricMatrix matrix = make_matrix(graph);
  assemble_stiffness(grid, colours, graph, materials.elastic(), matrix);
  std::optional<Supports> supports;
  if (loads.clamped.empty())
    supports.emplace(choose_supports(grid), matrix);
  else
    clamp(loads.clamped, matrix);

  progress(0.1, "order");
  auto own_factor = std::make_unique<CholmodFactor>(matrix, order.get());
  CholmodFactor& factor = *own_factor;
  if (is_too_expensive && is_too_expensive(factor.size())) return std::nullopt;
  // CHOLMOD turns the matrix into its own order; displacements, stress and what becomes of them follow.
  const double more = 16.0 * static_cast<double>(matrix.value.size()) +
                      bytes_per_response * static_cast<double>(loads.force.size());
  release_free_memory();  // of meshing, of the mesh before
  refuse_large_factor(1e9 * factor.gigabytes() + more, static_cast<std::size_t>(matrix.n), free_memory());
  progress(0.25, "factorise");
  std::optional<SerialBlas> serial;
  if (factor.size().flops < flops_worth_threads) serial.emplace();
  factor.factorise(matrix);
  Solution solution;
  solution.factor_gigabytes = factor.gigabytes();
  solution.factor = factor.size();
  solution.bytes = solution.factor.bytes;

  progress(0.75, "solve");
  Eigen::MatrixXd free_force = loads.force;
  if (supports) supports->clear(free_force);
  for (const auto unknown : loads.clamped) free_force.row(unknown).setZero();
  solution.displacement = factor.solve(free_force);
  Eigen::MatrixXd rest = free_force - multiply(matrix, solution.displacement);
  solution.residual = rest.colwise().norm().cwiseQuotient(loads.norm).maxCoeff();
  if (solution.residual > acceptable_residual) {
    const Eigen::MatrixXd correction = factor.solve(rest);
    solution.rounding = rounding(rest, correction, solution.displacement, loads);
    refuse_rounding(grid, solution.rounding);
    solution.displacement += correction;
    rest = free_force - multiply(matrix, solution.displacement);
    solution.residual = rest.colwise().norm().cwiseQuotient(loads.norm).maxCoeff();
  }
  if (supports)
    solution.support_reaction = supports->reactions(solution.displacement, loads.force)
                                    .colwise()
                                    .lpNorm<Eigen::Infinity>()
                                    .cwiseQuotient(loads.largest_entry)
                                    .maxCoeff();
  if (kept != nullptr)
    *kept = std::make_shared<const FactorisedBody>(std::move(own_factor),
                                                   supports ? supports->unknowns() : loads.clamped);
  return solution;
}

}  // namespace fem

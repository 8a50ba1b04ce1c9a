#include "fem/solve/solvers/direct_solve.h"

#include <algorithm>
#include <optional>
#include <sstream>

#include "fem/base/common/memory.h"
#include "fem/base/common/parallel.h"
#include "fem/base/values/errors.h"
#include "fem/equations/loads/clamps.h"
#include "fem/equations/loads/supports.h"
#include "fem/equations/matrices/cholmod_factor.h"
#include "fem/equations/operators/stiffness.h"
#include "fem/solve/solvers/solver_prediction.h"

namespace fem {

namespace {
/// Bytes of one unknown under one load: five columns of the solver, displacement and stress.
constexpr double bytes_per_response = 64;
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
  message << "rounding reaches " << 100 * share << " % of the displacements, " << 100 * most_rounding
          << " % at most are accepted: the body is too slender for its cells (stretched up to 1 : "
          << largest_aspect(grid)
          << ") for a solution in double precision; use cells of a more equal shape, shorten the body, or "
             "check its "
             "lengths";
  throw SolveFailed(message.str());
}

PlannedFactor::PlannedFactor(const Grid& grid, const CellsOfNodes& cells) {
  const NodeGraph of_mesh = make_node_graph(grid, cells);
  factor = std::make_unique<CholmodFactor>(of_mesh, order_nodes(of_mesh));
  graph = permuted(of_mesh, factor->node_order());
  place = places_in(factor->node_order());
}

FactorSize analyse_factor(const Grid& grid, const CellsOfNodes& cells) {
  const NodeGraph graph = make_node_graph(grid, cells);
  return CholmodFactor(graph, order_nodes(graph)).size();
}

namespace {

/// Unknowns of the mesh in the order of elimination, ascending there.
std::vector<std::int64_t> in_order(const std::vector<std::int64_t>& unknowns,
                                   const std::vector<std::int32_t>& place) {
  std::vector<std::int64_t> result;
  for (const auto unknown : unknowns)
    result.push_back(3 * std::int64_t(place[std::size_t(unknown / 3)]) + unknown % 3);
  std::sort(result.begin(), result.end());
  return result;
}

/// By one factor of the whole mesh.
class OneFactor : public FactorisedBody {
public:
  /// @param place  of each node in the factor's order
  /// @param held   unknowns of supports and clamps, in that order
  OneFactor(std::unique_ptr<const CholmodFactor> factor, std::vector<std::int32_t> place,
            std::vector<std::int64_t> held)
      : factor_(std::move(factor)), place_(std::move(place)), held_(std::move(held)) {}

  Eigen::MatrixXd solve(const Eigen::MatrixXd& force) const override {
    Eigen::MatrixXd ordered = rows_in_order(force, place_);
    clear_rows(held_, ordered);
    factor_->solve_in_order(ordered);
    return rows_of_mesh(ordered, place_);
  }

private:
  std::unique_ptr<const CholmodFactor> factor_;
  std::vector<std::int32_t> place_;
  std::vector<std::int64_t> held_;
};

/// Holds the body: in its clamps or, without them, in a statically determinate support, which carries
/// nothing.
class Holding {
public:
  Holding(const Grid& grid, const BalancedLoads& loads, const std::vector<std::int32_t>& place,
          SymmetricMatrix& matrix)
      : held_(in_order(loads.clamped, place)) {
    if (!held_.empty()) clamp(held_, matrix);
    std::vector<std::int64_t> chosen = loads.supports;
    if (held_.empty()) {
      const auto of_body = choose_supports(grid);
      chosen.assign(of_body.begin(), of_body.end());
    }
    if (chosen.empty()) return;
    supports_.emplace(in_order(chosen, place), matrix);
    held_.insert(held_.end(), supports_->unknowns().begin(), supports_->unknowns().end());
    std::sort(held_.begin(), held_.end());
  }

  const std::vector<std::int64_t>& unknowns() const noexcept { return held_; }

  /// Rows of the supported unknowns, in whose order reaction() takes their forces.
  Eigen::MatrixXd supported_rows(const Eigen::MatrixXd& vectors) const {
    const auto n = supports_ ? Eigen::Index(supports_->unknowns().size()) : 0;
    Eigen::MatrixXd rows(n, vectors.cols());
    for (Eigen::Index i = 0; i < n; ++i)
      rows.row(i) = vectors.row(Eigen::Index(supports_->unknowns()[std::size_t(i)]));
    return rows;
  }

  /// What the supports carry, relative to the largest entries of the loads.
  double reaction(const Eigen::MatrixXd& supported_force, const Eigen::MatrixXd& displacement,
                  const BalancedLoads& loads) const {
    if (!supports_) return 0;
    const Eigen::MatrixXd carried = supports_->images(displacement) - supported_force;
    return carried.colwise().lpNorm<Eigen::Infinity>().cwiseQuotient(loads.largest_entry).maxCoeff();
  }

private:
  std::vector<std::int64_t> held_;
  std::optional<Supports> supports_;
};

}  // namespace

Solution solve_directly(const Grid& grid, const CellsOfNodes& cells,
                        const std::vector<std::vector<std::int32_t>>& colours, const PerCell<Lame>& elastic,
                        const BalancedLoads& loads, const StepReport& progress, DirectSolveOptions options) {
  progress(0.05, "order");
  PlannedFactor plan = options.plan.valid() ? options.plan.get() : PlannedFactor(grid, cells);
  CholmodFactor& factor = *plan.factor;
  const double beside = bytes_per_response * static_cast<double>(loads.force.size()),
               needed = factor.size().bytes + beside;
  make_room(needed);
  refuse_large_factor(needed, grid.n_unknowns(), free_memory());

  // From here on all rows are in the order of elimination.
  progress(0.15, "assemble");
  factor.take_memory();
  SymmetricMatrix matrix = make_matrix(plan.graph);
  assemble_stiffness(grid, colours, plan.graph, elastic, matrix, plan.place);
  const Holding holding(grid, loads, plan.place, matrix);

  progress(0.25, "factorise");
  std::optional<SerialBlas> serial;
  if (factor.size().flops < flops_worth_threads) serial.emplace();
  factor.factorise_in_order(matrix);
  Solution solution;
  solution.factor_gigabytes = factor.gigabytes();
  solution.factor = factor.size();
  solution.bytes = solution.factor.bytes;

  progress(0.75, "solve");
  Eigen::MatrixXd free_force = rows_in_order(loads.force, plan.place);
  const Eigen::MatrixXd supported_force = holding.supported_rows(free_force);
  clear_rows(holding.unknowns(), free_force);
  Eigen::MatrixXd displacement = free_force;
  factor.solve_in_order(displacement);
  Eigen::MatrixXd rest = free_force - multiply(matrix, displacement);
  solution.residual = rest.colwise().norm().cwiseQuotient(loads.norm).maxCoeff();
  if (solution.residual > acceptable_residual) {
    Eigen::MatrixXd correction = rest;
    factor.solve_in_order(correction);
    solution.rounding = rounding(rest, correction, displacement, loads);
    refuse_rounding(grid, solution.rounding);
    displacement += correction;
    rest = free_force - multiply(matrix, displacement);
    solution.residual = rest.colwise().norm().cwiseQuotient(loads.norm).maxCoeff();
  }
  solution.support_reaction = holding.reaction(supported_force, displacement, loads);
  solution.displacement = rows_of_mesh(displacement, plan.place);
  if (options.kept != nullptr)
    *options.kept =
        std::make_shared<OneFactor>(std::move(plan.factor), std::move(plan.place), holding.unknowns());
  return solution;
}

}  // namespace fem

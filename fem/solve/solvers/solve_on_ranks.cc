#include "fem/solve/solvers/solve_on_ranks.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "fem/base/common/memory.h"
#include "fem/base/values/errors.h"
#include "fem/mesh/ranks/ranks.h"
#include "fem/mesh/ranks/row_exchange.h"
#include "fem/solve/solvers/solver_prediction.h"

namespace fem {

namespace {

/// What rank 0 tells of its solution by halves, beside displacements.
struct Told {
  bool is_solved = false;
  SolutionFigures figures{};
};

/// Places of some nodes among others, both ascending.
std::vector<Eigen::Index> places_among(const std::vector<std::int32_t>& nodes,
                                       const std::vector<std::int32_t>& all) {
  std::vector<Eigen::Index> places;
  auto at = all.begin();
  for (const auto node : nodes) {
    at = std::lower_bound(at, all.end(), node);
    places.push_back(at - all.begin());
  }
  return places;
}

/// Nodal forces of the whole body on rank 0, from those that each rank counts; empty on the others.
Eigen::MatrixXd on_first(const Grid& grid, const RankPart& part, const Eigen::MatrixXd& own,
                         MPI_Comm communicator) {
  const bool is_first = part.rank == 0;
  const auto& node = part.share.part.node;
  const auto n_unknowns = 3 * Eigen::Index(grid.n_nodes);
  Eigen::MatrixXd whole(is_first ? n_unknowns : 0, is_first ? own.cols() : 0);
  Eigen::VectorXd column;
  for (Eigen::Index k = 0; k < own.cols(); ++k) {
    column.setZero(n_unknowns);
    for (std::size_t i = 0; i < node.size(); ++i)
      if (part.counted[i] != 0)
        column.segment<3>(3 * Eigen::Index(node[i])) = own.col(k).segment<3>(3 * Eigen::Index(i));
    add_on_first(communicator, column.data(), std::size_t(column.size()));
    if (is_first) whole.col(k) = column;
  }
  return whole;
}

/// Displacements at the nodes of the part, from those of the whole body on rank 0.
Eigen::MatrixXd from_first(const Grid& grid, const RankPart& part, const Eigen::MatrixXd& whole,
                           Eigen::Index n_columns, MPI_Comm communicator) {
  Eigen::MatrixXd own(3 * Eigen::Index(part.share.part.node.size()), n_columns);
  Eigen::MatrixXd column(3 * Eigen::Index(grid.n_nodes), 1);
  for (Eigen::Index k = 0; k < n_columns; ++k) {
    if (part.rank == 0) column = whole.col(k);
    take_from_first(communicator, column.data(), sizeof(double) * std::size_t(column.size()));
    own.col(k) = part.rows_of(column, 3);
  }
  return own;
}

/// On rank 0. Nothing if the factor does not fit.
std::optional<Solution> factorise_halves(const BodyOnRanks& body, const MirroredHalf& half,
                                         const RankPart& part, const BalancedLoads& loads,
                                         const StepReport& progress,
                                         std::shared_ptr<const FactorisedBody>* kept) {
  auto of_whole = loads;
  of_whole.force = on_first(body.grid, part, loads.force, body.communicator);
  Told told;
  Solution solution;
  on_first_rank(body.communicator, [&] {
    DirectSolveOptions options;
    options.kept = kept;
    try {
      solution = solve_by_halves(half, body.elastic, of_whole, progress, std::move(options));
    } catch (const DoesNotFit&) {
      return;
    }
    told = {true, solution};
  });
  take_from_first(body.communicator, &told, sizeof told);
  if (!told.is_solved) return std::nullopt;
  solution.displacement =
      from_first(body.grid, part, solution.displacement, loads.force.cols(), body.communicator);
  static_cast<SolutionFigures&>(solution) = told.figures;
  return solution;
}

/// On all ranks.
Solution solve_together(const BodyOnRanks& body, const RankPart& part, const BalancedLoads& loads,
                        const SolverChoice& choice, const StepReport& progress,
                        std::shared_ptr<const FactorisedBody>* kept) {
  progress(0.05, "assemble");
  const auto solver = std::make_shared<PetscSolver>(body, part.rank_of_node, loads.clamped, choice);
  const auto& node = part.share.part.node;
  const auto own = places_among(solver->nodes(), node);
  BalancedLoads of_rows;
  of_rows.norm = loads.norm;
  of_rows.largest_entry = loads.largest_entry;
  of_rows.force.resize(3 * Eigen::Index(own.size()), loads.force.cols());
  for (std::size_t i = 0; i < own.size(); ++i)
    of_rows.force.middleRows<3>(3 * Eigen::Index(i)) = loads.force.middleRows<3>(3 * own[i]);
  Solution solution = solver->solve_rows(of_rows, progress);

  const auto shared = share_rows(body.communicator, body.grid, part.rank_of_cell);
  const auto n_columns = loads.force.cols();
  RowExchange::Rows rows = RowExchange::Rows::Zero(Eigen::Index(shared->node.size()), 3 * n_columns);
  const auto counted = places_among(solver->nodes(), shared->node);
  for (std::size_t i = 0; i < counted.size(); ++i)
    for (Eigen::Index k = 0; k < n_columns; ++k)
      for (Eigen::Index d = 0; d < 3; ++d)
        rows(counted[i], 3 * k + d) = solution.displacement(3 * Eigen::Index(i) + d, k);
  const RowExchange::Rows at_part = RowExchange(*shared, node)(rows);
  solution.displacement.resize(3 * Eigen::Index(node.size()), n_columns);
  for (Eigen::Index i = 0; i < at_part.rows(); ++i)
    for (Eigen::Index k = 0; k < n_columns; ++k)
      for (Eigen::Index d = 0; d < 3; ++d) solution.displacement(3 * i + d, k) = at_part(i, 3 * k + d);
  solution.ranks =
      gather_work(body.communicator, {part.share.n_own_cells(), part.n_unknowns, solution.bytes});
  solution.bytes = 0;
  for (const auto& work : solution.ranks) solution.bytes += work.bytes;
  if (kept != nullptr) *kept = solver;
  return solution;
}

}  // namespace

PartSolution solve_on_ranks(const BodyOnRanks& body, const HalfOfBody& half,
                            const std::function<BalancedLoads(const RankPart&)>& loads, SolverChoice choice,
                            const StepReport& progress, SolverReport& report,
                            std::shared_ptr<const FactorisedBody>* kept) {
  const int n = n_ranks(body.communicator);
  const auto part = [&] {
    const double cells_of_first =
        report.used == Solver::iterative ? cells_of_first_rank(body.grid.n_unknowns(), n) : 1;
    return RankPart(body.grid, body.cells, body.elastic, this_rank(body.communicator), n, cells_of_first);
  };
  PartSolution found{part(), {}};
  auto of_part = loads(found.part);
  const auto deal_anew = [&] {
    found.part = part();
    of_part = loads(found.part);
  };
  const auto solve = [&] {
    choice.solver = report.used;
    found.solution = solve_together(body, found.part, of_part, choice, progress, kept);
  };
  if (report.used == Solver::iterative) try {
      solve();
      return found;
    } catch (const FailedTogether& error) {
      turn_to_factor(error.what(), report);
      deal_anew();
    }
  if (half() != nullptr)
    if (auto solution = factorise_halves(body, *half(), found.part, of_part, progress, kept)) {
      found.solution = std::move(*solution);
      return found;
    }
  const bool may_turn = may_turn_to_iteration(choice, report);
  try {
    solve();
  } catch (const DoesNotFit&) {
    if (!may_turn) throw;
    turn_to_iteration(body.grid.n_unknowns(), memory_of_all_machines(body.communicator), report);
    deal_anew();
    solve();
  }
  return found;
}

}  // namespace fem

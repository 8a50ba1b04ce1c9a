#include "fem/solvers/direct_on_ranks.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "fem/loads/clamps.h"
#include "fem/loads/supports.h"
#include "fem/matrices/cholmod_factor.h"
#include "fem/matrices/mumps_factor.h"
#include "fem/operators/stiffness.h"
#include "fem/ranks/array_sums.h"
#include "fem/solvers/direct_solve.h"

namespace fem {

namespace {

/// Those of some of the body's unknowns that a part has, in its numbers, ascending.
std::vector<std::int64_t> in_part(const Subdomain& part, const std::vector<std::int64_t>& unknowns) {
  std::vector<std::int64_t> result;
  for (const auto unknown : unknowns) {
    const auto found = std::lower_bound(part.node.begin(), part.node.end(), unknown / 3);
    if (found != part.node.end() && *found == unknown / 3)
      result.push_back(3 * (found - part.node.begin()) + unknown % 3);
  }
  return result;
}

std::vector<std::int64_t> six_supports(const Grid& grid) {
  const auto six = choose_supports(grid);
  return {six.begin(), six.end()};
}

/// Sums on rank 0 of what the ranks have at the nodes of their parts, column by column.
/// @param counted  that alone; null: all
Eigen::MatrixXd sum_on_first(const Grid& grid, const RankPart& part, const std::vector<char>* counted,
                             const Eigen::MatrixXd& own, MPI_Comm communicator) {
  const bool is_first = part.rank == 0;
  const auto& node = part.share.part.node;
  const auto n_unknowns = 3 * Eigen::Index(grid.n_nodes);
  Eigen::MatrixXd whole(is_first ? n_unknowns : 0, is_first ? own.cols() : 0);
  Eigen::VectorXd column;
  for (Eigen::Index k = 0; k < own.cols(); ++k) {
    column.setZero(n_unknowns);
    for (std::size_t i = 0; i < node.size(); ++i)
      if (counted == nullptr || (*counted)[i] != 0)
        column.segment<3>(3 * Eigen::Index(node[i])) = own.col(k).segment<3>(3 * Eigen::Index(i));
    add_on_first(communicator, column.data(), std::size_t(column.size()));
    if (is_first) whole.col(k) = column;
  }
  return whole;
}

/// The stiffness of one rank's cells and its part of the factor.
class Share {
public:
  Share(MPI_Comm communicator, const Grid& grid, const RankPart& part)
      : communicator_(communicator), grid_(grid), part_(part) {}

  /// @param held  unknowns of the body
  void assemble(const std::vector<std::int64_t>& held, bool clamped) {
    const auto& grid = part_.share.part.grid;
    const auto cells = cells_of_nodes(grid);
    const NodeGraph graph = make_node_graph(grid, cells);
    matrix_ = make_matrix(graph);
    assemble_stiffness(grid, colour_cells(grid, cells), graph, cell_after_cell(part_.share.elastic), matrix_);
    if (clamped)
      clamp(in_part(part_.share.part, held), matrix_);
    else
      supports_.emplace(in_part(part_.share.part, held), matrix_);
  }

  /// @param node_order  on rank 0
  void factorise(const std::vector<std::int32_t>& node_order) {
    factor_ = std::make_unique<MumpsFactor>(communicator_, 3 * std::int64_t(grid_.n_nodes), matrix_,
                                            part_.share.part.node, node_order);
  }

  /// @param columns  replaced on rank 0
  void solve(Eigen::MatrixXd& columns) const { factor_->solve(columns); }

  /// K u on rank 0, in the supported rows too.
  /// @param own  at the nodes of the part
  Eigen::MatrixXd multiply(const Eigen::MatrixXd& own) const {
    Eigen::MatrixXd result = fem::multiply(matrix_, own);
    if (supports_) {
      const Eigen::MatrixXd at_supports = supports_->images(own);
      for (std::size_t s = 0; s < supports_->unknowns().size(); ++s)
        result.row(supports_->unknowns()[s]) = at_supports.row(Eigen::Index(s));
    }
    return sum_on_first(grid_, part_, nullptr, result, communicator_);
  }

  /// Of all ranks, and the factor's bytes.
  std::vector<RankWork> work(double& factor_bytes) const {
    factor_bytes = sum_over_ranks(communicator_, Eigen::ArrayXd::Constant(1, factor_->bytes()))[0];
    return gather_work(communicator_, {part_.share.n_own_cells(), part_.n_unknowns,
                                       factor_->bytes() + 16.0 * double(matrix_.value.size())});
  }

private:
  MPI_Comm communicator_;
  const Grid& grid_;
  const RankPart& part_;
  SymmetricMatrix matrix_;
  std::optional<Supports> supports_;
  std::unique_ptr<MumpsFactor> factor_;
};

/// What rank 0 has found, on all.
struct Found {
  double residual = 0, rounding = 0, support_reaction = 0;
};

}  // namespace

Eigen::MatrixXd on_first(const Grid& grid, const RankPart& part, const Eigen::MatrixXd& own,
                         MPI_Comm communicator) {
  return sum_on_first(grid, part, &part.counted, own, communicator);
}

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

Solution solve_directly_on_ranks(const Grid& grid, const CellsOfNodes& cells, const RankPart& part,
                                 const BalancedLoads& loads, const StepReport& progress,
                                 MPI_Comm communicator) {
  progress(0.05, "assemble");
  const bool is_first = part.rank == 0;
  const auto n_loads = loads.force.cols();
  const auto supported = loads.clamped.empty() ? six_supports(grid) : std::vector<std::int64_t>{};
  Share share(communicator, grid, part);
  std::vector<std::int32_t> order;
  agree(communicator, [&] {
    share.assemble(loads.clamped.empty() ? supported : loads.clamped, !loads.clamped.empty());
    if (is_first) order = order_nodes(make_node_graph(grid, cells));
  });
  progress(0.25, "factorise");
  share.factorise(order);

  progress(0.75, "solve");
  const Eigen::MatrixXd force = on_first(grid, part, loads.force, communicator);
  Eigen::MatrixXd free_force = force, image, rest, u;  // on rank 0
  if (is_first) {
    clear_rows(supported, free_force);
    clear_rows(loads.clamped, free_force);
  }
  Solution solution;
  Found found;
  /// Of the displacement on rank 0, and what it leaves of the forces.
  const auto take = [&] {
    solution.displacement = from_first(grid, part, u, n_loads, communicator);
    image = share.multiply(solution.displacement);
    if (is_first) {
      rest = free_force - image;
      clear_rows(supported, rest);
      found.residual = rest.colwise().norm().cwiseQuotient(loads.norm).maxCoeff();
    }
    take_from_first(communicator, &found, sizeof found);
  };
  u = free_force;
  share.solve(u);
  take();
  if (found.residual > acceptable_residual) {
    Eigen::MatrixXd correction = rest;
    share.solve(correction);
    agree(communicator, [&] {
      if (!is_first) return;
      found.rounding = rounding(rest, correction, u, loads);
      refuse_rounding(grid, found.rounding);
      u += correction;
    });
    take();
  }
  if (is_first)
    for (const auto unknown : supported)
      found.support_reaction = std::max(
          found.support_reaction,
          (image.row(unknown) - force.row(unknown)).cwiseAbs().cwiseQuotient(loads.largest_entry).maxCoeff());
  take_from_first(communicator, &found, sizeof found);
  solution.residual = found.residual;
  solution.rounding = found.rounding;
  solution.support_reaction = found.support_reaction;
  double factor_bytes = 0;
  solution.ranks = share.work(factor_bytes);
  for (const auto& work : solution.ranks) solution.bytes += work.bytes;
  solution.factor_gigabytes = 1e-9 * factor_bytes;
  return solution;
}

}  // namespace fem

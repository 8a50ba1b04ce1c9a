#include "fem/solvers/direct_on_ranks.h"
#include "fem/mesh/cell_order.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "fem/loads/clamps.h"
#include "fem/loads/supports.h"
#include "fem/matrices/cholmod_factor.h"
#include "fem/matrices/mumps_factor.h"
#include "fem/operators/stiffness.h"
#include "fem/operators/subdomain.h"
#include "fem/ranks/node_exchange.h"
#include "fem/ranks/ranks.h"
#include "fem/solvers/direct_solve.h"

namespace fem {

namespace {

/// What a rank is given.
struct DirectJob {
  StiffnessShare share;
  std::int64_t n_unknowns = 0;     // of the body
  bool clamped = false;            // else supported
  std::vector<std::int64_t> held;  // unknowns of the part, ascending

  template <typename Self>
  static auto members(Self& self) {
    return std::tie(self.share, self.n_unknowns, self.clamped, self.held);
  }
};

DirectJob make_job(const Grid& grid, const CellsOfNodes& cells, const std::vector<int>& rank_of_cell,
                   int rank, const PerCell<Lame>& elastic, const BalancedLoads& loads) {
  DirectJob job;
  job.share = share_of_rank(grid, cells, rank_of_cell, rank, elastic);
  const auto& own = job.share.part.node;
  job.n_unknowns = static_cast<std::int64_t>(3 * grid.n_nodes);
  job.clamped = !loads.clamped.empty();
  const auto supports = choose_supports(grid);
  const auto held = job.clamped ? loads.clamped : std::vector<std::int64_t>(supports.begin(), supports.end());
  for (const auto unknown : held) {
    const auto found = std::lower_bound(own.begin(), own.end(), unknown / 3);
    if (found != own.end() && *found == unknown / 3)
      job.held.push_back(3 * (found - own.begin()) + unknown % 3);
  }
  return job;
}

/// The stiffness of one rank's cells and its part of the factor. Called on all ranks.
class Share {
public:
  Share(MPI_Comm communicator, DirectJob job, NodeExchange exchange)
      : communicator_(communicator), job_(std::move(job)), exchange_(std::move(exchange)) {}

  void assemble() {
    const auto& grid = job_.share.part.grid;
    const auto cells = cells_of_nodes(grid);
    const NodeGraph graph = make_node_graph(grid, cells);
    matrix_ = make_matrix(graph);
    assemble_stiffness(grid, colour_cells(grid, cells), graph, cell_after_cell(job_.share.elastic), matrix_);
    if (job_.clamped)
      clamp(job_.held, matrix_);
    else
      supports_.emplace(job_.held, matrix_);
  }

  void factorise(const std::vector<std::int32_t>& node_order) {
    factor_ = std::make_unique<MumpsFactor>(communicator_, job_.n_unknowns, matrix_, job_.share.part.node,
                                            node_order);
  }

  /// @param columns  replaced on rank 0
  void solve(Eigen::MatrixXd& columns) const { factor_->solve(columns); }

  /// K u, in the supported rows too.
  /// @param u      on rank 0
  /// @param image  on rank 0: zero on entry
  void multiply(const Eigen::MatrixXd& u, Eigen::MatrixXd& image) const {
    const Eigen::MatrixXd own = exchange_.from_first(u, 3);
    Eigen::MatrixXd result;
    agree(communicator_, [&] {
      result = fem::multiply(matrix_, own);
      if (!supports_) return;
      const Eigen::MatrixXd at_supports = supports_->images(own);
      for (std::size_t s = 0; s < supports_->unknowns().size(); ++s)
        result.row(supports_->unknowns()[s]) = at_supports.row(s);
    });
    exchange_.add_on_first(result, 3, image);
  }

  /// Rank 0 gets that of all ranks, and the factor's bytes.
  std::vector<RankWork> work(std::size_t n_unknowns, double& factor_bytes) const {
    factor_bytes = sum_over_ranks(communicator_, Eigen::ArrayXd::Constant(1, factor_->bytes()))[0];
    return gather_work(communicator_, {job_.share.n_own_cells(), n_unknowns,
                                       factor_->bytes() + 16.0 * double(matrix_.value.size())});
  }

private:
  MPI_Comm communicator_;
  DirectJob job_;
  NodeExchange exchange_;
  SymmetricMatrix matrix_;
  std::optional<Supports> supports_;
  std::unique_ptr<MumpsFactor> factor_;
};

/// What all ranks do after rank 0 has solved: once more with the residual, or no more.
bool once_more(MPI_Comm communicator, bool wanted) {
  int more = wanted ? 1 : 0;
  MPI_Bcast(&more, 1, MPI_INT, 0, communicator);
  return more != 0;
}

}  // namespace

Solution solve_directly_on_ranks(const Grid& grid, const CellsOfNodes& cells, const CellMaterials& materials,
                                 const BalancedLoads& loads, const StepReport& progress,
                                 MPI_Comm communicator) {
  progress(0.05, "assemble");
  const int n = n_ranks(communicator);
  const auto rank_of_cell = deal_out_cells(grid, even_weights(n));
  const auto rank_of_node = ranks_of_nodes(grid, rank_of_cell);
  const auto elastic = materials.elastic();
  std::vector<std::vector<std::int32_t>> nodes(n);
  DirectJob own;
  for (int r = n - 1; r >= 0; --r) {
    DirectJob job = make_job(grid, cells, rank_of_cell, r, elastic, loads);
    nodes[r] = job.share.part.node;
    if (r > 0) {
      Message message;
      message << job << n_unknowns_of_rank(grid, rank_of_node, r);
      message.send(r, communicator);
    } else {
      own = std::move(job);
    }
  }
  Share share(communicator, std::move(own), {communicator, nodes});
  std::vector<std::int32_t> order;
  agree(communicator, [&] {
    share.assemble();
    order = order_nodes(make_node_graph(grid, cells));
  });
  progress(0.25, "factorise");
  share.factorise(order);

  progress(0.75, "solve");
  const auto six = choose_supports(grid);
  const std::vector<std::int64_t> supported =
      loads.clamped.empty() ? std::vector<std::int64_t>(six.begin(), six.end()) : std::vector<std::int64_t>{};
  Eigen::MatrixXd free_force = loads.force;
  clear_rows(supported, free_force);
  clear_rows(loads.clamped, free_force);
  Eigen::MatrixXd image;
  /// free_force - K u
  const auto rest_of = [&](const Eigen::MatrixXd& u) {
    image = Eigen::MatrixXd::Zero(u.rows(), u.cols());
    share.multiply(u, image);
    Eigen::MatrixXd rest = free_force - image;
    clear_rows(supported, rest);
    return rest;
  };
  Solution solution;
  solution.displacement = free_force;
  share.solve(solution.displacement);
  Eigen::MatrixXd rest = rest_of(solution.displacement);
  const auto residual = [&] { return rest.colwise().norm().cwiseQuotient(loads.norm).maxCoeff(); };
  solution.residual = residual();
  if (once_more(communicator, solution.residual > acceptable_residual)) {
    Eigen::MatrixXd correction = rest;
    share.solve(correction);
    solution.rounding = rounding(rest, correction, solution.displacement, loads);
    agree(communicator, [&] { refuse_rounding(grid, solution.rounding); });
    solution.displacement += correction;
    rest = rest_of(solution.displacement);
    solution.residual = residual();
  }
  for (const auto unknown : supported)
    solution.support_reaction =
        std::max(solution.support_reaction, (image.row(unknown) - loads.force.row(unknown))
                                                .cwiseAbs()
                                                .cwiseQuotient(loads.largest_entry)
                                                .maxCoeff());
  double factor_bytes = 0;
  solution.ranks = share.work(n_unknowns_of_rank(grid, rank_of_node, 0), factor_bytes);
  for (const auto& work : solution.ranks) solution.bytes += work.bytes;
  solution.factor_gigabytes = 1e-9 * factor_bytes;
  return solution;
}

void help_to_solve_directly(MPI_Comm communicator) {
  Message message = Message::receive(0, communicator);
  DirectJob job;
  std::size_t n_unknowns = 0;
  message >> job >> n_unknowns;
  message = {};
  Share share(communicator, std::move(job), {communicator, {}});
  agree(communicator, [&] { share.assemble(); });
  share.factorise({});
  Eigen::MatrixXd none;
  share.solve(none);
  share.multiply(none, none);
  if (once_more(communicator, false)) {
    share.solve(none);
    agree(communicator, [] {});
    share.multiply(none, none);
  }
  double factor_bytes = 0;
  share.work(n_unknowns, factor_bytes);
}

}  // namespace fem

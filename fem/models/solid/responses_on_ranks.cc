#include "fem/models/solid/responses_on_ranks.h"

#include <algorithm>
#include <utility>

#include "fem/base/common/memory.h"
#include "fem/equations/loads/surface_loads.h"
#include "fem/equations/operators/nodes_export.h"
#include "fem/mesh/grid/hanging_nodes.h"
#include "fem/mesh/ranks/ranks.h"
#include "fem/mesh/ranks/row_exchange.h"
#include "fem/solve/solvers/solver_prediction.h"
#include "fem/stress/cells/energy_error.h"
#include "fem/stress/recovery/recovery_on_ranks.h"

namespace fem {

namespace {

/// Columns of forces on the whole body at once: each is as long as the body has unknowns.
constexpr std::size_t loads_at_once = 4;

/// Hanging nodes, rigid motion, units and springs: displacements of the unit loads at the nodes of a part.
Eigen::MatrixXd finished(const BodyOnRanks& body, const SharedLoads& loads, const Eigen::RowVectorXd& scale,
                         PartSolution& found) {
  const auto& part = found.part.share.part;
  const auto complete = [&](Eigen::MatrixXd& sums) {
    sum_over_ranks(body.communicator, sums.data(), std::size_t(sums.size()));
  };
  auto& displacement = found.solution.displacement;
  set_hanging_unknowns(part.grid.hanging, displacement);
  if (loads.clamped.empty())
    RigidBalance(body.grid, loads.integrals)
        .remove_motion(part.node, found.part.counted, complete, displacement);
  displacement.array().rowwise() *= scale.array().inverse();
  Eigen::MatrixXd spring_forces = found.part.rows_of(loads.springs.unit_forces(), 3);
  for (std::size_t i = 0; i < part.node.size(); ++i)
    if (found.part.counted[i] == 0) spring_forces.middleRows<3>(3 * Eigen::Index(i)).setZero();
  return loads.springs.apply(std::move(displacement), spring_forces, complete);
}

/// Rows of the nodes that this rank has of the mesh with the nodes that stress has.
std::vector<double> own_rows(const Subdomain& part, const SeenMesh& seen, const SharedRows& shared,
                             const Eigen::MatrixXd& displacement) {
  std::vector<double> rows;
  rows.reserve(shared.node.size() * 3 * std::size_t(displacement.cols()));
  const std::size_t n_of_body = seen.grid.n_nodes - seen.copy.size();
  for (const auto own : shared.node) {
    const auto node = std::size_t(own);
    const auto of_body = node < n_of_body ? own : seen.copy[node - n_of_body];
    const auto at = std::lower_bound(part.node.begin(), part.node.end(), of_body) - part.node.begin();
    for (Eigen::Index k = 0; k < displacement.cols(); ++k)
      for (Eigen::Index d = 0; d < 3; ++d) rows.push_back(displacement(3 * at + d, k));
  }
  return rows;
}

/// Below the plane stress is the mirrored one from above, to the last bit.
void mirror(const MirroredHalf& half, const SharedRows& shared, RowMajor& stress) {
  std::vector<char> is_above(shared.row.size(), 0);
  for (const auto node : half.nodes()) is_above[std::size_t(node)] = 1;
  std::vector<std::int32_t> below, above;
  for (const auto node : shared.node)
    if (is_above[std::size_t(node)] == 0) {
      below.push_back(node);
      above.push_back(half.plane().node[std::size_t(node)]);
    }
  const RowMajor rows = RowExchange(shared, std::move(above))(stress);
  const auto sign = half.signs_of_tensors();
  for (std::size_t i = 0; i < below.size(); ++i)
    for (Eigen::Index c = 0; c < stress.cols(); ++c)
      stress(shared.row[std::size_t(below[i])], c) =
          sign[std::size_t(c) % sign.size()] * rows(Eigen::Index(i), c);
}

}  // namespace

void take_report(const Solution& solution, std::size_t n_columns, UnitResponses& responses) {
  responses.solver.n_iterations = solution.n_iterations;
  if (solution.factor.n_dofs > 0) {
    responses.solver.factor = solution.factor;
    responses.solver.predicted_direct = predict_direct(solution.factor, n_columns);
  }
  responses.residual = responses.solver.relative_residual = solution.residual;
  responses.support_reaction = solution.support_reaction;
  responses.solver.rounding = solution.rounding;
  responses.factor_gigabytes = solution.factor_gigabytes;
  responses.solver.used_bytes = solution.bytes;
  responses.solver.ranks = solution.ranks;
}

BalancedLoads loads_of_part(const BodyOnRanks& body, const SharedLoads& loads, const RankPart& part,
                            Eigen::RowVectorXd& scale, std::vector<std::array<double, 6>>* resultants) {
  const auto& grid = body.grid;
  const auto n_loads = loads.unit_loads.size();
  const auto n_springs = std::size_t(loads.springs.unit_forces().cols());
  const RigidBalance rigid(grid, loads.integrals);
  BalancedLoads own;
  own.clamped = loads.clamped;
  const auto n_columns = Eigen::Index(n_loads + n_springs);
  own.force.resize(3 * Eigen::Index(part.share.part.node.size()), n_columns);
  own.norm.resize(n_columns);
  own.largest_entry.resize(n_columns);
  scale.resize(n_columns);
  Eigen::Index next = 0;
  const auto add = [&](Eigen::MatrixXd force) {
    const Eigen::RowVectorXd to_unit = to_unit_size(force);
    force.array().rowwise() *= to_unit.array();
    BalancedLoads whole = balance(rigid, loads.clamped, std::move(force));
    move_to_masters(grid.hanging, whole.force);
    const auto n = whole.force.cols();
    own.force.middleCols(next, n) = part.rows_of(whole.force, 3);
    own.norm.segment(next, n) = whole.norm;
    own.largest_entry.segment(next, n) = whole.largest_entry;
    scale.segment(next, n) = to_unit;
    next += n;
  };
  for (std::size_t first = 0; first < n_loads; first += loads_at_once) {
    const auto begin = loads.unit_loads.begin() + std::ptrdiff_t(first);
    Eigen::MatrixXd force =
        load_vectors(grid, loads.integrals, loads.body.material.density_kg_m3,
                     {begin, begin + std::ptrdiff_t(std::min(loads_at_once, n_loads - first))});
    if (resultants != nullptr) {
      const Eigen::MatrixXd applied = fem::resultants(grid, force, Eigen::Vector3d::Zero());
      for (Eigen::Index k = 0; k < applied.cols(); ++k)
        for (Eigen::Index c = 0; c < 6; ++c)
          (*resultants)[first + std::size_t(k)][std::size_t(c)] = applied(c, k);
    }
    add(std::move(force));
  }
  if (n_springs > 0) add(loads.springs.unit_forces());
  return own;
}

void respond_on_ranks(const BodyOnRanks& body, const HalfOfBody& half_of_body, const SeenMesh& seen,
                      const SharedLoads& loads, bool by_patches, const StepReport& progress,
                      const SolverChoice& choice, std::shared_ptr<const FactorisedBody>* kept,
                      UnitResponses& responses) {
  release_free_memory();  // of meshing
  check_channels(loads.unit_loads);
  responses.resultants.resize(loads.unit_loads.size());
  Eigen::RowVectorXd scale;
  std::vector<int> rank_of_cell;
  const MirroredHalf* half = nullptr;  // which tells of all
  {
    PartSolution found = solve_on_ranks(
        body, half_of_body,
        [&](const RankPart& part) { return loads_of_part(body, loads, part, scale, &responses.resultants); },
        choice, progress, responses.solver, kept);
    const auto& solution = found.solution;
    take_report(solution, std::size_t(scale.size()), responses);
    if (solution.factor.n_dofs > 0) {
      responses.solver.reason += solution.is_even ? "; one half, of which the other is the mirror image"
                                                  : "; half by half, the body being its own mirror image";
      if (solution.is_even) half = half_of_body();
    }
    rank_of_cell = found.part.rank_of_cell;
    responses.shared = share_rows(body.communicator, seen.grid, rank_of_cell);
    const Eigen::MatrixXd own = finished(body, loads, scale, found);
    responses.displacement_m = own_rows(found.part.share.part, seen, *responses.shared, own);
  }
  const auto& shared = *responses.shared;
  const Eigen::Map<const RowMajor> displacement(responses.displacement_m.data(),
                                                Eigen::Index(responses.n_rows()),
                                                3 * Eigen::Index(loads.unit_loads.size()));

  progress(0.85, "recover");
  release_free_memory();
  const auto elastic = body.elastic;
  {
    const auto patches = recovery_case(seen.grid, elastic, loaded_groups(loads.unit_loads, loads.body));
    RowMajor stress = recover_stress_on_ranks(seen.grid, seen.cells, elastic, loads.body.cylinders,
                                              by_patches ? &patches : nullptr, shared, displacement);
    if (half != nullptr) {
      mirror(*half, shared, stress);
      responses.images = {half->plane().node, half->plane().cell};
    }
    const auto share =
        share_of_rank(seen.grid, seen.cells, rank_of_cell, this_rank(body.communicator), elastic);
    const RowExchange exchange(shared, share.part.node);
    responses.energy_error = energy_error_on_ranks(body.communicator, share, seen.grid.n_cells(),
                                                   exchange(displacement), exchange(stress));
    responses.stress_Pa.assign(stress.data(), stress.data() + stress.size());
  }
  responses.nodes = export_nodes(seen.grid, seen.volumes);
}

}  // namespace fem

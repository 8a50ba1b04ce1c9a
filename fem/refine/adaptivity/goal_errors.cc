#include "fem/refine/adaptivity/goal_errors.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "fem/equations/operators/nodes_export.h"
#include "fem/mesh/grid/cell_geometry.h"
#include "fem/mesh/grid/hanging_nodes.h"
#include "fem/mesh/ranks/ranks.h"
#include "fem/mesh/ranks/row_exchange.h"
#include "fem/stress/cells/energy_error.h"
#include "fem/stress/recovery/recovery_on_ranks.h"
#include "fem/stress/recovery/stress_recovery.h"

namespace fem {

namespace {

Eigen::Matrix3d symmetric(const std::array<double, 6>& t) {
  Eigen::Matrix3d m;
  m << t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2];
  return m;
}

/// Displacement and recovered stress of load cases, column groups of 3 and 6.
struct Fields {
  RowMajor displacement, stress;
};

Fields load_cases(const UnitResponses& responses, const std::vector<StressGoal>& goals) {
  const auto n_channels = Eigen::Index(responses.channels.size()), n_goals = Eigen::Index(goals.size());
  Eigen::MatrixXd factors(n_channels, n_goals);
  for (Eigen::Index g = 0; g < n_goals; ++g) {
    if (Eigen::Index(goals[std::size_t(g)].factors.size()) != n_channels)
      throw std::invalid_argument("a stress goal needs one factor for every channel");
    factors.col(g) = Eigen::Map<const Eigen::VectorXd>(goals[std::size_t(g)].factors.data(), n_channels);
  }
  return {sum_of_own_channels(responses, NodalField::displacement, factors),
          sum_of_own_channels(responses, NodalField::stress, factors)};
}

/// Nodes with a load of the goals, or its image.
std::vector<char> nodes_of_goals(const Grid& grid, const std::vector<StressGoal>& goals,
                                 const MirroredHalf* half) {
  std::vector<char> counts(grid.n_nodes, 0);
  for (const auto& goal : goals)
    for (const auto& part : goal.parts) {
      counts[part.node] = 1;
      if (half != nullptr) counts[std::size_t(half->plane().node[part.node])] = 1;
    }
  return counts;
}

/// Faces where the dual stress has no traction: those without a load of the goals. A dual load at a surface
/// acts on it.
/// @param counts  by node: whether it has such a load
std::vector<BoundaryFace> faces_without_goal(const Grid& grid, const std::vector<char>& counts) {
  std::vector<BoundaryFace> faces;
  for (const auto& face : grid.boundary) {
    const auto nodes = nodes_of_face(grid, std::size_t(face.cell), face.face);
    if (std::none_of(nodes.begin(), nodes.end(), [&](auto i) { return counts[std::size_t(i)] != 0; }))
      faces.push_back(face);
  }
  return faces;
}

/// Energy norms of the recovery's error, cells x load cases [J^(1/2)].
Eigen::MatrixXd norms_of(const EnergyError& energies) {
  const auto n_loads = Eigen::Index(energies.norm_sqrtJ.size());
  Eigen::MatrixXd norms(Eigen::Index(energies.of_cells.size()) / n_loads, n_loads);
  for (Eigen::Index c = 0; c < norms.rows(); ++c)
    for (Eigen::Index k = 0; k < n_loads; ++k)
      norms(c, k) = energies.norm_sqrtJ[std::size_t(k)] *
                    std::sqrt(std::max(0.0, energies.of_cells[std::size_t(c * n_loads + k)]));
  return norms;
}

/// Each rank does its cells, with the dual stress at its nodes.
Eigen::MatrixXd goal_errors_on_ranks(const Grid& grid, const CellsOfNodes& cells,
                                     const std::vector<CylinderChart>& charts, const PerCell<Lame>& elastic,
                                     const UnitResponses& responses, const std::vector<StressGoal>& goals,
                                     const Eigen::MatrixXd& dual, const std::vector<char>& has_goal) {
  const auto& shared = *responses.shared;
  Fields of_dual{RowMajor(Eigen::Index(shared.node.size()), 3 * dual.cols()), {}};
  for (std::size_t row = 0; row < shared.node.size(); ++row)
    for (Eigen::Index g = 0; g < dual.cols(); ++g)
      for (Eigen::Index d = 0; d < 3; ++d)
        of_dual.displacement(Eigen::Index(row), 3 * g + d) = dual(3 * Eigen::Index(shared.node[row]) + d, g);
  const RecoveryCase patches{[&](const Subdomain& part) {
                               std::vector<char> of_part;
                               for (const auto node : part.node)
                                 of_part.push_back(has_goal[std::size_t(node)]);
                               return faces_without_goal(part.grid, of_part);
                             },
                             false};
  of_dual.stress =
      recover_stress_on_ranks(grid, cells, elastic, charts, &patches, shared, of_dual.displacement);
  const auto share = share_of_rank(grid, cells, shared.rank_of_cell, this_rank(shared.communicator), elastic);
  const RowExchange exchange(shared, share.part.node);
  const auto norms = [&](const Fields& fields) {
    return norms_of(energy_error_on_ranks(shared.communicator, share, grid.n_cells(),
                                          exchange(fields.displacement), exchange(fields.stress)));
  };
  return norms(load_cases(responses, goals)).cwiseProduct(norms(of_dual));
}

}  // namespace

Eigen::VectorXd dual_load(const Grid& grid, const StressGoal& goal, const std::vector<double>& volume_m3,
                          const PerCell<Lame>& elastic) {
  std::map<std::int32_t, Eigen::Matrix3d> weight;  // by node, per volume
  for (const auto& part : goal.parts) {
    if (part.node >= grid.n_nodes)
      throw std::invalid_argument("stress goal: there is no node " + std::to_string(part.node));
    const auto known = weight.try_emplace(std::int32_t(part.node), Eigen::Matrix3d::Zero()).first;
    known->second += symmetric(part.tensor) / volume_m3[part.node];
  }
  Eigen::VectorXd load = Eigen::VectorXd::Zero(3 * Eigen::Index(grid.n_nodes));
  const Tabulation at = moment_points_in_cell(grid.shape());  // as the nodes' volumes
  CellGradients gradients;
  for (std::size_t c = 0; c < grid.n_cells(); ++c) {
    const auto* nodes = grid.nodes_of(c);
    std::vector<std::pair<int, Eigen::Matrix3d>> here;
    for (int i = 0; i < at.n_shapes; ++i)
      if (const auto found = weight.find(nodes[i]); found != weight.end())
        here.emplace_back(i, found->second);
    if (here.empty()) continue;
    compute_gradients(grid, c, at, gradients);
    const Lame lame = elastic[c];
    for (int q = 0; q < at.n_points; ++q) {
      Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
      for (const auto& [i, t] : here)
        tensor += at.value[std::size_t(q) * std::size_t(at.n_shapes) + std::size_t(i)] * t;
      Eigen::Matrix3d stress = 2 * lame.mu_Pa * tensor;
      stress.diagonal().array() += lame.lambda_Pa * tensor.trace();
      stress *= gradients.jxw[std::size_t(q)];
      for (int a = 0; a < at.n_shapes; ++a)
        load.segment<3>(3 * Eigen::Index(nodes[a])) += stress * gradients.gradient.block<3, 1>(3 * q, a);
    }
  }
  return load;
}

Eigen::MatrixXd goal_errors(const Grid& grid, const CellsOfNodes& cells,
                            const std::vector<CylinderChart>& charts, const PerCell<Lame>& elastic,
                            const UnitResponses& responses, const std::vector<StressGoal>& goals,
                            const Eigen::MatrixXd& dual, const MirroredHalf* half) {
  const auto has_goal = nodes_of_goals(grid, goals, half);
  if (responses.shared)
    return goal_errors_on_ranks(grid, cells, charts, elastic, responses, goals, dual, has_goal);
  const auto n_goals = Eigen::Index(goals.size()), n_nodes = Eigen::Index(grid.n_nodes);
  Fields of_dual{RowMajor(n_nodes, 3 * n_goals), RowMajor(n_nodes, 6 * n_goals)};
  for (Eigen::Index i = 0; i < n_nodes; ++i)
    for (Eigen::Index g = 0; g < n_goals; ++g)
      for (Eigen::Index d = 0; d < 3; ++d) of_dual.displacement(i, 3 * g + d) = dual(3 * i + d, g);
  recover_stress(grid, cells, charts, faces_without_goal(grid, has_goal), elastic, false,
                 of_dual.displacement, of_dual.stress,
                 half != nullptr ? NodeSelection(half->nodes()) : std::nullopt);
  set_hanging_rows(grid.hanging, of_dual.stress);
  if (half != nullptr) half->mirror_rows(half->signs_of_tensors(), of_dual.stress);
  const auto* plane = half != nullptr ? &half->plane() : nullptr;
  const auto norms = [&](const Fields& fields) {
    return norms_of(energy_error(grid, elastic, fields.displacement, fields.stress, plane));
  };
  return norms(load_cases(responses, goals)).cwiseProduct(norms(of_dual));
}

}  // namespace fem

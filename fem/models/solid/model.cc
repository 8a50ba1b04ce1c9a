#include "fem/models/solid/model.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <optional>
#include <stdexcept>
#include <utility>

#include "fem/base/common/memory.h"
#include "fem/base/values/errors.h"
#include "fem/equations/loads/balanced_loads.h"
#include "fem/equations/loads/clamps.h"
#include "fem/equations/loads/elastic_supports.h"
#include "fem/equations/loads/surface_loads.h"
#include "fem/equations/operators/nodes_export.h"
#include "fem/equations/operators/sharp_edges.h"
#include "fem/equations/operators/stiffness.h"
#include "fem/mesh/grid/geometry_distance.h"
#include "fem/mesh/grid/grid.h"
#include "fem/mesh/grid/hanging_nodes.h"
#include "fem/mesh/grid/rigid_modes.h"
#include "fem/mesh/ranks/ranks.h"
#include "fem/mesh/triangulation/body_grid.h"
#include "fem/models/solid/responses_on_ranks.h"
#include "fem/refine/adaptivity/goal_errors.h"
#include "fem/solve/modes/natural_frequencies.h"
#include "fem/solve/solvers/direct_solve.h"
#include "fem/solve/solvers/mirrored_halves.h"
#include "fem/solve/solvers/petsc_solver.h"
#include "fem/solve/solvers/solver_prediction.h"
#include "fem/stress/cells/energy_error.h"
#include "fem/stress/cells/sections.h"
#include "fem/stress/recovery/recovery_on_ranks.h"

namespace fem {

/// By which the energy that recovered stress finds missing in a mode is multiplied.
constexpr double safety_of_modes = 3;

struct Model::Impl {
  void estimate_errors(std::vector<NaturalMode>& modes, const std::vector<AttachedMass>& attached) const;
  std::vector<NaturalMode> natural_frequencies(int n_modes, const std::vector<AttachedMass>& attached) const;
  Eigen::MatrixXd dual_solutions(const BalancedLoads& loads, const MirroredHalf* half,
                                 SolverReport report) const;

  /// The mesh of stress where tetrahedra have sharp edges.
  struct Seen {
    SplitGrid split;
    CellsOfNodes cells;
    NodeIntegrals volumes;
  };

  MPI_Comm communicator = MPI_COMM_WORLD;
  Body body;
  Grid grid;
  CellsOfNodes cells;
  std::vector<std::vector<std::int32_t>> colours;
  NodeIntegrals integrals;  // of the volume
  std::optional<Seen> seen;
  mutable std::shared_ptr<const FactorisedBody> factor{};

  Lame elastic() const { return lame(body.material); }

  BodyOnRanks on_ranks() const { return {communicator, grid, cells, elastic()}; }

  /// The half of a free body that is its own mirror image; null for others. Looked for once.
  const MirroredHalf* half() const {
    if (!half_) {
      half_.emplace();
      if (!seen && body.clamps.empty())
        if (auto plane = find_mirror_plane(grid, cells))
          *half_ = std::make_unique<MirroredHalf>(grid, std::move(*plane));
    }
    return half_->get();
  }

private:
  mutable std::optional<std::unique_ptr<const MirroredHalf>> half_{};
};

Model::Model(const Body& body, MPI_Comm communicator, const Progress& progress)
    : impl_(std::make_unique<Impl>()) {
  refuse_impossible(body.material);
  if (progress) progress(0, "read mesh");
  impl_->communicator = communicator;
  impl_->body = body;
  impl_->grid = make_grid(body);
  impl_->cells = cells_of_nodes(impl_->grid);
  impl_->colours = colour_cells(impl_->grid, impl_->cells);
  impl_->integrals = integrate_nodes(impl_->grid, impl_->colours);
  auto split = split_at_sharp_edges(impl_->grid, impl_->cells);
  if (split.copy.empty()) return;
  auto& seen = impl_->seen.emplace();
  seen.split = std::move(split);
  seen.cells = cells_of_nodes(seen.split.grid);
  seen.volumes = integrate_nodes(seen.split.grid, impl_->colours);
}

Model::~Model() = default;
Model::Model(Model&&) noexcept = default;

std::size_t Model::n_dofs() const {
  return impl_->grid.n_unknowns();
}

MassProperties Model::mass_properties() const {
  auto masses = fem::mass_properties(impl_->grid, impl_->integrals, impl_->body.material.density_kg_m3);
  if (impl_->seen) masses.volume_m3 = impl_->seen->volumes.col(0).sum();
  return masses;
}

MassProperties Model::mass_properties(const std::vector<int>& volume_ids) const {
  return fem::mass_properties(impl_->grid, integrate_nodes(impl_->grid, volume_ids),
                              impl_->body.material.density_kg_m3);
}

GeometryError Model::geometry_error(const std::vector<LoadSurface>& seats) const {
  return fem::geometry_error(impl_->grid, impl_->body, seats);
}

SolverReport Model::predict_solver(std::size_t n_loads, const SolverChoice& choice) const {
  return fem::predict_solver(impl_->grid, impl_->cells, choice.by_halves ? impl_->half() : nullptr, n_loads,
                             choice);
}

std::vector<NaturalMode> Model::natural_frequencies(int n_modes,
                                                    const std::vector<AttachedMass>& attached) const {
  std::vector<NaturalMode> modes;
  on_first_rank(impl_->communicator, [&] { modes = impl_->natural_frequencies(n_modes, attached); });
  if (n_ranks(impl_->communicator) == 1) return modes;
  std::size_t n = modes.size();
  take_from_first(impl_->communicator, &n, sizeof n);
  modes.resize(n);
  const std::size_t n_nodes = (impl_->seen ? impl_->seen->split.grid : impl_->grid).n_nodes;
  for (auto& mode : modes) {
    mode.shape.resize(3 * n_nodes);
    for (double* value : {&mode.frequency_Hz, &mode.residual, &mode.error})
      take_from_first(impl_->communicator, value, sizeof *value);
    take_from_first(impl_->communicator, mode.shape.data(), sizeof(double) * mode.shape.size());
  }
  return modes;
}

std::vector<NaturalMode> Model::Impl::natural_frequencies(int n_modes,
                                                          const std::vector<AttachedMass>& attached) const {
  auto modes = fem::natural_frequencies(VibratingBody(grid, cells, colours, body, attached), n_modes);
  for (auto& mode : modes)
    set_hanging_rows(grid.hanging, Eigen::Map<NodeRows>(mode.shape.data(), Eigen::Index(grid.n_nodes), 3));
  if (seen)
    for (auto& mode : modes)
      for (const auto node : seen->split.copy)
        for (int d = 0; d < 3; ++d) mode.shape.push_back(mode.shape[3 * std::size_t(node) + d]);
  estimate_errors(modes, attached);
  return modes;
}

/// A mode's square of the frequency is its energy, and too large by the energy of its error.
void Model::Impl::estimate_errors(std::vector<NaturalMode>& modes,
                                  const std::vector<AttachedMass>& attached) const {
  const auto& on = seen ? seen->split.grid : grid;
  const auto n_modes = Eigen::Index(modes.size()), n_nodes = Eigen::Index(on.n_nodes);
  RowMajor displacement(n_nodes, 3 * n_modes), stress(n_nodes, 6 * n_modes);
  for (Eigen::Index k = 0; k < n_modes; ++k)
    displacement.middleCols(3 * k, 3) =
        Eigen::Map<const RowMajor>(modes[std::size_t(k)].shape.data(), n_nodes, 3);
  std::vector<int> loaded;
  for (const auto& clamp : body.clamps) loaded.push_back(clamp.boundary_id);
  for (const auto& support : body.elastic_supports) loaded.push_back(support.surface.boundary_id);
  for (const auto& mass : attached) loaded.push_back(mass.surface.boundary_id);
  const Lame elastic = this->elastic();
  recover_stress(on, seen ? seen->cells : cells, elastic, body.cylinders, loaded, true, displacement, stress);
  set_hanging_rows(grid.hanging, stress);
  const auto energies = energy_error(on, elastic, displacement, stress);
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const double norm_sqrtJ = energies.norm_sqrtJ[k], w_rad_s = 2 * EIGEN_PI * modes[k].frequency_Hz;
    const double missing = safety_of_modes * energies.error[k * modes.size() + k] * norm_sqrtJ * norm_sqrtJ;
    modes[k].error = 1 - std::sqrt(std::max(0.0, 1 - missing / (w_rad_s * w_rad_s)));
  }
}

namespace {

/// On one rank, by the solver that the report names; by the other one if the factor does not fit into memory,
/// or if the iteration does not end; the report then tells.
/// @param half_of_body  that of a body that is solved by halves, or null; not looked for before it is needed
Solution solve(const Grid& grid, const CellsOfNodes& cells,
               const std::vector<std::vector<std::int32_t>>& colours, const PerCell<Lame>& elastic,
               const HalfOfBody& half_of_body, const BalancedLoads& loads, SolverChoice choice,
               const Progress& progress, SolverReport& report, DirectSolveOptions direct) {
  auto* const kept = direct.kept;
  const auto factorise = [&](DirectSolveOptions options) {
    const auto* half = half_of_body();
    return half != nullptr
               ? solve_by_halves(*half, elastic, loads, progress, std::move(options))
               : solve_directly(grid, cells, colours, elastic, loads, progress, std::move(options));
  };
  const bool is_asked_for = report.used == Solver::iterative;
  if (!is_asked_for) try {
      return factorise(std::move(direct));
    } catch (const DoesNotFit&) {
      if (!may_turn_to_iteration(choice, report)) throw;
      turn_to_iteration(grid.n_unknowns(), free_memory(), report);
    }
  progress(0.05, "prepare levels");
  release_free_memory();
  choice.solver = Solver::iterative;
  try {
    const auto levels =
        std::make_shared<PetscSolver>(BodyOnRanks{MPI_COMM_SELF, grid, cells, elastic},
                                      std::vector<int>(grid.n_nodes, 0), loads.clamped, choice);
    auto solution = levels->solve_whole(loads, progress);
    if (kept != nullptr) *kept = levels;
    return solution;
  } catch (const DoesNotFit&) {
    throw;
  } catch (const SolveFailed& error) {
    if (!is_asked_for) throw;
    turn_to_factor(error.what(), report);
  }
  return factorise(std::move(direct));
}

}  // namespace

UnitResponses Model::unit_responses(const std::vector<UnitLoad>& loads,
                                    const std::vector<SectionPlane>& planes, Recovery recovery,
                                    const Progress& progress, const SolverChoice& choice) const {
  const Progress report = progress ? progress : [](double, const std::string&) {};
  const auto& grid = impl_->grid;
  const auto& seen = impl_->seen ? impl_->seen->split.grid : grid;
  const auto& seen_cells = impl_->seen ? impl_->seen->cells : impl_->cells;
  const auto n_loads = static_cast<Eigen::Index>(loads.size());
  const auto clamped = clamped_unknowns(grid, impl_->body.clamps);
  if (!clamped.empty() && !impl_->body.elastic_supports.empty())
    throw std::invalid_argument(
        "a body with clamps cannot have elastic supports, which act on a free body: leave one of them out");
  UnitResponses responses;
  responses.n_dofs = n_dofs();
  for (const auto& load : loads) responses.channels.push_back(load.channel);

  report(0, "loads");
  const ElasticSupports springs(grid, impl_->body.elastic_supports);
  responses.solver = choose_solver(grid, loads.size() + std::size_t(springs.unit_forces().cols()), choice,
                                   memory_of_all_machines(impl_->communicator));
  const auto half_of_body = [&] { return choice.by_halves ? impl_->half() : nullptr; };
  if (n_ranks(impl_->communicator) > 1) {
    const SeenMesh mesh{seen, seen_cells, impl_->seen ? impl_->seen->split.copy : std::vector<std::int32_t>(),
                        impl_->seen ? impl_->seen->volumes : impl_->integrals};
    respond_on_ranks(impl_->on_ranks(), half_of_body, mesh,
                     {loads, springs, clamped, impl_->body, impl_->integrals}, recovery == Recovery::patch,
                     report, choice, choice.keep_factor ? &impl_->factor : nullptr, responses);
    respond_on_sections(seen, planes, responses);
    respond_on_rings(seen, impl_->body, responses);
    return responses;
  }
  DirectSolveOptions direct;
  direct.kept = choice.keep_factor ? &impl_->factor : nullptr;
  if (responses.solver.used == Solver::direct) {
    const auto* planned = half_of_body();
    direct.plan = std::async(std::launch::async, [&, planned] {  // beside the loads
      return planned != nullptr ? PlannedFactor(planned->grid(), planned->cells())
                                : PlannedFactor(grid, impl_->cells);
    });
  }
  Eigen::MatrixXd force = load_vectors(grid, impl_->integrals, impl_->body.material.density_kg_m3, loads);
  const Eigen::MatrixXd applied = resultants(grid, force, Eigen::Vector3d::Zero());
  responses.resultants.resize(loads.size());
  for (Eigen::Index k = 0; k < n_loads; ++k)
    for (int c = 0; c < 6; ++c) responses.resultants[k][c] = applied(c, k);

  const MirroredHalf* half = nullptr;  // which tells of all
  {
    force.conservativeResize(Eigen::NoChange, n_loads + springs.unit_forces().cols());
    force.rightCols(springs.unit_forces().cols()) = springs.unit_forces();
    const Eigen::RowVectorXd scale = to_unit_size(force);
    force.array().rowwise() *= scale.array();
    const RigidBalance rigid(grid, impl_->integrals);
    BalancedLoads balanced = balance(rigid, clamped, std::move(force));
    move_to_masters(grid.hanging, balanced.force);
    Solution solution = solve(grid, impl_->cells, impl_->colours, impl_->elastic(), half_of_body, balanced,
                              choice, report, responses.solver, std::move(direct));
    take_report(solution, std::size_t(balanced.force.cols()), responses);
    balanced = {};
    if (responses.solver.used == Solver::direct && half_of_body() != nullptr) {
      responses.solver.reason += solution.is_even ? "; one half, of which the other is the mirror image"
                                                  : "; half by half, the body being its own mirror image";
      if (solution.is_even) half = half_of_body();
    }
    set_hanging_unknowns(grid.hanging, solution.displacement);
    if (clamped.empty()) rigid.remove_motion(solution.displacement);
    solution.displacement.array().rowwise() *= scale.array().inverse();
    const Eigen::MatrixXd displacement = springs.apply(std::move(solution.displacement));
    responses.displacement_m.resize(3 * seen.n_nodes * loads.size());
    for (std::size_t i = 0; i < seen.n_nodes; ++i) {
      const std::size_t node = i < grid.n_nodes ? i : std::size_t(impl_->seen->split.copy[i - grid.n_nodes]);
      for (Eigen::Index k = 0; k < n_loads; ++k)
        for (int d = 0; d < 3; ++d)
          responses.displacement_m[(i * n_loads + k) * 3 + d] = displacement(3 * node + d, k);
    }
  }

  report(0.85, "recover");
  const auto elastic = impl_->elastic();
  const Eigen::Map<const RowMajor> displacement(responses.displacement_m.data(), seen.n_nodes, 3 * n_loads);
  responses.stress_Pa.resize(seen.n_nodes * std::size_t(n_loads) * 6);
  Eigen::Map<RowMajor> stress(responses.stress_Pa.data(), seen.n_nodes, 6 * n_loads);
  recover_stress(seen, seen_cells, elastic, impl_->body.cylinders, loaded_groups(loads, impl_->body),
                 recovery == Recovery::patch, displacement, stress,
                 half != nullptr ? NodeSelection(half->nodes()) : std::nullopt);
  set_hanging_rows(grid.hanging, stress);
  if (half != nullptr) half->mirror_rows(half->signs_of_tensors(), stress);
  responses.energy_error =
      energy_error(seen, elastic, displacement, stress, half != nullptr ? &half->plane() : nullptr);
  if (half != nullptr) responses.images = {half->plane().node, half->plane().cell};
  responses.nodes = export_nodes(seen, impl_->seen ? impl_->seen->volumes : impl_->integrals);
  respond_on_sections(seen, planes, responses);
  respond_on_rings(seen, impl_->body, responses);
  return responses;
}

/// By the factor or the levels that are kept, or by the solver that the responses have.
Eigen::MatrixXd Model::Impl::dual_solutions(const BalancedLoads& loads, const MirroredHalf* half,
                                            SolverReport report) const {
  const auto n_columns = loads.force.cols();
  const int n = n_ranks(communicator);
  if (factor && factor->is_on_all_ranks()) return factor->solve(loads.force);
  char is_kept = factor && (half != nullptr || !factor->takes_even_loads_only()) ? 1 : 0;  // on rank 0
  take_from_first(communicator, &is_kept, 1);
  if (is_kept != 0) {
    Eigen::MatrixXd dual(loads.force.rows(), n_columns);
    on_first_rank(communicator, [&] { dual = factor->solve(loads.force); });
    take_from_first(communicator, dual.data(), sizeof(double) * std::size_t(dual.size()));
    return dual;
  }
  SolverChoice choice;
  const auto no_progress = [](double, const std::string&) {};
  const auto half_of_body = [&] { return half; };
  if (n == 1) {
    DirectSolveOptions direct;
    direct.kept = &factor;
    return solve(grid, cells, colours, elastic(), half_of_body, loads, choice, no_progress, report,
                 std::move(direct))
        .displacement;
  }
  const auto of_part = [&](const RankPart& part) {
    BalancedLoads own;
    own.clamped = loads.clamped;
    own.norm = loads.norm;
    own.largest_entry = loads.largest_entry;
    own.force = part.rows_of(loads.force, 3);
    return own;
  };
  const auto found = solve_on_ranks(on_ranks(), half_of_body, of_part, choice, no_progress, report, &factor);
  Eigen::MatrixXd dual = Eigen::MatrixXd::Zero(loads.force.rows(), n_columns);
  const auto& node = found.part.share.part.node;
  for (std::size_t i = 0; i < node.size(); ++i)
    if (found.part.counted[i] != 0)
      dual.middleRows<3>(3 * Eigen::Index(node[i])) =
          found.solution.displacement.middleRows<3>(3 * Eigen::Index(i));
  complete(communicator, dual.data(), std::size_t(dual.size()));
  return dual;
}

void Model::release_factor() const {
  impl_->factor.reset();
}

std::vector<std::vector<double>> Model::goal_errors_Pa(const UnitResponses& responses,
                                                       const std::vector<StressGoal>& goals) const {
  const auto& grid = impl_->grid;
  if (grid.shape().is_tetrahedron()) throw std::invalid_argument("goal_errors_Pa: for hexahedra");
  if (responses.nodes.n != grid.n_nodes || responses.nodes.n_cells() != grid.n_cells())
    throw std::invalid_argument("goal_errors_Pa: the responses are of another model");
  const auto elastic = impl_->elastic();
  const ElasticSupports springs(grid, impl_->body.elastic_supports);
  const auto n_goals = Eigen::Index(goals.size()), n_springs = springs.unit_forces().cols();
  Eigen::MatrixXd force(3 * Eigen::Index(grid.n_nodes), n_goals + n_springs);
  for (Eigen::Index g = 0; g < n_goals; ++g)
    force.col(g) = dual_load(grid, goals[std::size_t(g)], responses.nodes.volume_m3, elastic);
  force.rightCols(n_springs) = springs.unit_forces();
  const RigidBalance rigid(grid, impl_->integrals);
  BalancedLoads loads = balance(rigid, clamped_unknowns(grid, impl_->body.clamps), std::move(force));
  move_to_masters(grid.hanging, loads.force);
  // Errors that are mirrored meet the mirrored part of a dual solution alone.
  const MirroredHalf* half = responses.images.node.empty() ? nullptr : impl_->half();
  if (half != nullptr) half->make_even(loads.force);
  Eigen::MatrixXd dual = impl_->dual_solutions(loads, half, responses.solver);
  set_hanging_unknowns(grid.hanging, dual);
  if (loads.clamped.empty()) rigid.remove_motion(dual);
  const Eigen::MatrixXd errors = goal_errors(grid, impl_->cells, impl_->body.cylinders, elastic, responses,
                                             goals, springs.apply(dual), half);
  std::vector<std::vector<double>> result;
  for (Eigen::Index g = 0; g < n_goals; ++g) result.emplace_back(errors.col(g).begin(), errors.col(g).end());
  return result;
}

}  // namespace fem

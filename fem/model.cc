#include "fem/model.h"

#include <stdexcept>
#include <utility>

#include "fem/balanced_loads.h"
#include "fem/clamps.h"
#include "fem/direct_solve.h"
#include "fem/elastic_supports.h"
#include "fem/geometry_error.h"
#include "fem/grid.h"
#include "fem/iterative_solve.h"
#include "fem/mesh_reader.h"
#include "fem/natural_frequencies.h"
#include "fem/nodes_export.h"
#include "fem/ranks.h"
#include "fem/rigid_modes.h"
#include "fem/sections.h"
#include "fem/solver_prediction.h"
#include "fem/stiffness.h"
#include "fem/stress_recovery.h"
#include "fem/surface_loads.h"

namespace fem {

struct Model::Impl {
  Body body;
  Grid grid;
  CellsOfNodes cells;
  std::vector<std::vector<std::int32_t>> colours;
  NodeIntegrals integrals;
};

Model::Model(const Body& body, MPI_Comm communicator, const Progress& progress)
    : impl_(std::make_unique<Impl>()) {
  refuse_several_ranks(n_ranks(communicator));
  refuse_impossible(body.material);
  if (progress) progress(0, "read mesh");
  impl_->body = body;
  impl_->grid = read_grid(body);
  impl_->cells = cells_of_nodes(impl_->grid);
  impl_->colours = colour_cells(impl_->grid, impl_->cells);
  impl_->integrals = integrate_nodes(impl_->grid, impl_->colours);
}

Model::~Model() = default;
Model::Model(Model&&) noexcept = default;

std::size_t Model::n_dofs() const {
  return 3 * impl_->grid.n_nodes;
}

MassProperties Model::mass_properties() const {
  return fem::mass_properties(impl_->grid, impl_->integrals, impl_->body.material.density_kg_m3);
}

MassProperties Model::mass_properties(const std::vector<int>& volume_ids) const {
  return fem::mass_properties(impl_->grid, integrate_nodes(impl_->grid, volume_ids),
                              impl_->body.material.density_kg_m3);
}

GeometryError Model::geometry_error(const std::vector<LoadSurface>& seats) const {
  return fem::geometry_error(impl_->grid, impl_->body, seats);
}

std::vector<NaturalMode> Model::natural_frequencies(int n_modes) const {
  return fem::natural_frequencies(VibratingBody(impl_->grid, impl_->cells, impl_->colours, impl_->body),
                                  n_modes);
}

namespace {

BalancedLoads balance(const RigidBalance& rigid, const std::vector<std::int64_t>& clamped,
                      Eigen::MatrixXd force) {
  BalancedLoads loads;
  loads.clamped = clamped;
  loads.norm = force.colwise().norm().cwiseMax(1e-300);
  loads.largest_entry = force.colwise().lpNorm<Eigen::Infinity>().cwiseMax(1e-300);
  if (clamped.empty()) rigid.balance(force);
  loads.force = std::move(force);
  return loads;
}

/// By the solver that the report names; by the direct one if the iterative one gives up, which the report
/// then tells.
Solution solve(const Grid& grid, const CellsOfNodes& cells,
               const std::vector<std::vector<std::int32_t>>& colours, const Material& material,
               const BalancedLoads& loads, SolverChoice choice, const Progress& progress,
               SolverReport& report) {
  choice.coarse_level = report.coarse_level;
  if (report.used == Solver::iterative) {
    std::string failure;
    try {
      if (auto solution = solve_iteratively(grid, material, loads, choice, progress, failure))
        return std::move(*solution);
    } catch (const std::runtime_error& error) {
      failure = error.what();
    }
    report.used = Solver::direct;
    report.gave_up = true;
    report.reason = failure + "; solved directly";
  }
  return solve_directly(grid, cells, colours, material, loads, progress);
}

/// Boundary groups that any of the loads, springs or clamps acts on.
std::vector<int> loaded_groups(const std::vector<UnitLoad>& loads, const Body& body) {
  std::vector<int> groups;
  for (const auto& spring : body.elastic_supports) groups.push_back(spring.surface.boundary_id);
  for (const auto& clamp : body.clamps) groups.push_back(clamp.boundary_id);
  for (const auto& load : loads) {
    if (const auto* resultant = std::get_if<SurfaceResultant>(&load.shape))
      groups.push_back(resultant->surface.boundary_id);
    if (const auto* pressure = std::get_if<SeatPressure>(&load.shape))
      groups.push_back(pressure->surface.boundary_id);
  }
  return groups;
}

}  // namespace

UnitResponses Model::unit_responses(const std::vector<UnitLoad>& loads,
                                    const std::vector<SectionPlane>& planes, Recovery recovery,
                                    const Progress& progress, const SolverChoice& choice) const {
  const Progress report = progress ? progress : [](double, const std::string&) {};
  const auto& grid = impl_->grid;
  const auto n_loads = static_cast<Eigen::Index>(loads.size());
  const auto clamped = clamped_unknowns(grid, impl_->body.clamps);
  if (!clamped.empty() && !impl_->body.elastic_supports.empty())
    throw std::invalid_argument(
        "a body with clamps cannot have elastic supports, which act on a free body: leave one of them out");
  UnitResponses responses;
  responses.n_dofs = n_dofs();
  for (const auto& load : loads) responses.channels.push_back(load.channel);

  report(0, "loads");
  Eigen::MatrixXd force = load_vectors(grid, impl_->integrals, impl_->body.material.density_kg_m3, loads);
  const Eigen::MatrixXd applied = resultants(grid, force, Eigen::Vector3d::Zero());
  responses.resultants.resize(loads.size());
  for (Eigen::Index k = 0; k < n_loads; ++k)
    for (int c = 0; c < 6; ++c) responses.resultants[k][c] = applied(c, k);

  {
    const ElasticSupports springs(grid, impl_->body.elastic_supports);
    force.conservativeResize(Eigen::NoChange, n_loads + springs.unit_forces().cols());
    force.rightCols(springs.unit_forces().cols()) = springs.unit_forces();
    const RigidBalance rigid(grid, impl_->integrals);
    const BalancedLoads balanced = balance(rigid, clamped, std::move(force));
    responses.solver =
        choose_solver(grid, impl_->body.material, static_cast<std::size_t>(balanced.force.cols()), choice,
                      physical_memory());
    if (!clamped.empty()) {
      responses.solver.used = Solver::direct;
      responses.solver.reason = "the body is clamped";
    }
    Solution solution = solve(grid, impl_->cells, impl_->colours, impl_->body.material, balanced, choice,
                              report, responses.solver);
    responses.residual = responses.solver.relative_residual = solution.residual;
    responses.support_reaction = solution.support_reaction;
    responses.factor_gigabytes = solution.factor_gigabytes;
    responses.solver.used_bytes = solution.bytes;
    responses.solver.n_iterations = solution.n_iterations;
    if (clamped.empty()) rigid.remove_motion(solution.displacement);
    const Eigen::MatrixXd displacement = springs.apply(solution.displacement);
    responses.displacement_m.resize(displacement.size());
    for (std::size_t i = 0; i < grid.n_nodes; ++i)
      for (Eigen::Index k = 0; k < n_loads; ++k)
        for (int d = 0; d < 3; ++d)
          responses.displacement_m[(i * n_loads + k) * 3 + d] = displacement(3 * i + d, k);
  }

  report(0.85, "recover");
  const Lame elastic = lame(impl_->body.material);
  responses.stress_Pa.resize(grid.n_nodes * n_loads * 6);
  const Eigen::Map<const RowMajor> displacement(responses.displacement_m.data(), grid.n_nodes, 3 * n_loads);
  Eigen::Map<RowMajor> stress(responses.stress_Pa.data(), grid.n_nodes, 6 * n_loads);
  if (recovery == Recovery::average) {
    average_stress(grid, impl_->cells, elastic, displacement, stress);
  } else {
    const auto free = free_faces(grid, loaded_groups(loads, impl_->body));
    recover_by_patches(grid, impl_->cells, impl_->body.cylinders, make_samples(grid, free),
                       stress_at_samples(grid, free, elastic, displacement), stress);
  }
  responses.nodes = export_nodes(grid, impl_->integrals);
  respond_on_sections(grid, planes, responses);
  respond_on_rings(grid, impl_->body, responses);
  return responses;
}

}  // namespace fem

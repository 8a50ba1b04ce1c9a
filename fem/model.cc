#include "fem/model.h"

#include <functional>
#include <future>
#include <optional>
#include <stdexcept>

#include "fem/cholmod_factor.h"
#include "fem/clamps.h"
#include "fem/elastic_supports.h"
#include "fem/geometry_error.h"
#include "fem/grid.h"
#include "fem/mesh_reader.h"
#include "fem/natural_frequencies.h"
#include "fem/nodes_export.h"
#include "fem/ranks.h"
#include "fem/rigid_modes.h"
#include "fem/sections.h"
#include "fem/stiffness.h"
#include "fem/stress_recovery.h"
#include "fem/supports.h"
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

// Rounding alone leaves eps |K| |u| / |f|, up to 1e-9 in slender bodies: refinement cannot go below that.
constexpr double acceptable_residual = 1e-8;

/// Sizes of the load vectors as applied. A balanced one may vanish (a uniform acceleration), and is no scale.
struct Scales {
  Eigen::RowVectorXd norm, largest_entry;
};

Scales scales_of(const Eigen::MatrixXd& force) {
  return {force.colwise().norm().cwiseMax(1e-300),
          force.colwise().lpNorm<Eigen::Infinity>().cwiseMax(1e-300)};
}

/// K u = f on the body held at the clamped unknowns or, without any, on statically determinate supports;
/// fills the solver's figures of `responses`.
Eigen::MatrixXd solve_held(const Grid& grid, const CellsOfNodes& cells,
                           const std::vector<std::vector<std::int32_t>>& colours, const Material& material,
                           const std::vector<std::int64_t>& clamped, const Eigen::MatrixXd& force,
                           const Scales& scales, UnitResponses& responses, const Progress& progress) {
  progress(0.05, "assemble");
  const NodeGraph graph = make_node_graph(grid, cells);
  auto order =
      std::async(std::launch::async, order_nodes, std::cref(graph));  // one thread, while others assemble
  SymmetricMatrix matrix = make_matrix(graph);
  assemble_stiffness(grid, colours, graph, material, matrix);
  std::optional<Supports> supports;
  if (clamped.empty())
    supports.emplace(choose_supports(grid), matrix);
  else
    clamp(clamped, matrix);

  progress(0.1, "order");
  CholmodFactor factor(matrix, order.get());
  progress(0.25, "factorise");
  factor.factorise(matrix);
  responses.factor_gigabytes = factor.gigabytes();

  progress(0.75, "solve");
  Eigen::MatrixXd free_force = force;
  if (supports) supports->clear(free_force);
  for (const auto unknown : clamped) free_force.row(unknown).setZero();
  Eigen::MatrixXd displacement = factor.solve(free_force);
  Eigen::MatrixXd rest = free_force - multiply(matrix, displacement);
  responses.residual = rest.colwise().norm().cwiseQuotient(scales.norm).maxCoeff();
  if (responses.residual > acceptable_residual) {
    displacement += factor.solve(rest);
    rest = free_force - multiply(matrix, displacement);
    responses.residual = rest.colwise().norm().cwiseQuotient(scales.norm).maxCoeff();
  }
  if (supports)
    responses.support_reaction = supports->reactions(displacement, force)
                                     .colwise()
                                     .lpNorm<Eigen::Infinity>()
                                     .cwiseQuotient(scales.largest_entry)
                                     .maxCoeff();
  return displacement;
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
                                    const Progress& progress) const {
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
    const Scales scales = scales_of(force);
    const RigidBalance rigid(grid, impl_->integrals);
    if (clamped.empty()) rigid.balance(force);
    Eigen::MatrixXd displacement = solve_held(grid, impl_->cells, impl_->colours, impl_->body.material,
                                              clamped, force, scales, responses, report);
    if (clamped.empty()) rigid.remove_motion(displacement);
    displacement = springs.apply(displacement);
    responses.displacement_m.resize(displacement.size());
    for (std::size_t i = 0; i < grid.n_nodes; ++i)
      for (Eigen::Index k = 0; k < n_loads; ++k)
        for (int d = 0; d < 3; ++d)
          responses.displacement_m[(i * n_loads + k) * 3 + d] = displacement(3 * i + d, k);
  }
  force.resize(0, 0);

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

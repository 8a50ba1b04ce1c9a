#include "tests/benchmarks/operators/triangulations.h"

#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>

#include <cstdio>
#include <optional>
#include <random>
#include <stdexcept>

#include "fem/triangulation/manifolds.h"
#include "fem/triangulation/triangulation.h"
#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/scene/whole/scene.h"
#include "tests/benchmarks/solvers/benchmark_shaft.h"
#include "tests/benchmarks/solvers/process.h"

namespace measure {

namespace {

constexpr int n_cycles = 3;
constexpr unsigned one_of = 50;  // cells that are cut in a cycle

struct Mesh {
  std::size_t n_cells = 0, n_nodes = 0;
};

/// @param n_components  of the element, one number per node for each
Mesh measure_one(const char* name, const fem::Body& body, dealii::Triangulation<3>& mesh,
                 unsigned n_components) {
  const double start_s = wall_s();
  fem::triangulate(*body.mesh, mesh);
  fem::attach_charts(mesh, body.cylinders, body.tori);
  std::mt19937 random(1);
  for (int cycle = 0; cycle < n_cycles; ++cycle) {
    for (const auto& cell : mesh.active_cell_iterators())
      if (random() % one_of == 0) cell->set_refine_flag();
    mesh.execute_coarsening_and_refinement();
  }
  const double refined_s = wall_s();
  dealii::DoFHandler<3> unknowns(mesh);
  const dealii::FE_Q<3> scalar(2);
  if (n_components == 1)
    unknowns.distribute_dofs(scalar);
  else
    unknowns.distribute_dofs(dealii::FESystem<3>(scalar, n_components));
  dealii::AffineConstraints<double> hanging;
  dealii::DoFTools::make_hanging_node_constraints(unknowns, hanging);
  hanging.close();
  const double numbered_s = wall_s();
  std::printf("| %s | %u | %.2f | %.2f | %.0f | %.0f |\n", name, n_components, refined_s - start_s,
              numbered_s - refined_s, 1e-6 * double(mesh.memory_consumption()),
              1e-6 * double(unknowns.memory_consumption() + hanging.memory_consumption()));
  return {mesh.n_active_cells(), unknowns.n_dofs() / n_components};
}

}  // namespace

void compare_triangulations(const std::filesystem::path& shaft_toml) {
  const auto scene = pipelines::read_scene(shaft_toml);
  const auto part = refined_shaft(scene, {4, 32});
  const auto body = pipelines::to_fem_body(pipelines::build_mesh(part), part.material);
  const auto within_one_halving = dealii::Triangulation<3>::limit_level_difference_at_vertices;
  std::printf(
      "| triangulation | components | s, cells | s, numbers and constraints | MB, cells | MB, numbers |\n"
      "|---|---|---|---|---|---|\n");
  std::optional<Mesh> first;
  const auto check = [&](const Mesh& mesh) {
    if (!first) first = mesh;
    if (mesh.n_cells != first->n_cells || mesh.n_nodes != first->n_nodes)
      throw std::runtime_error("the triangulations differ");
  };
  for (const unsigned n_components : {1u, 3u}) {
    dealii::Triangulation<3> serial(within_one_halving);
    check(measure_one("serial", body, serial, n_components));
    dealii::parallel::distributed::Triangulation<3> distributed(MPI_COMM_SELF, within_one_halving);
    check(measure_one("p4est, one rank", body, distributed, n_components));
  }
  std::printf("%zu cells, %zu nodes\n", first->n_cells, first->n_nodes);
}

}  // namespace measure

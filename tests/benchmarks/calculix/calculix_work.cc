#include "tests/benchmarks/calculix/calculix_work.h"

#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "fem/equations/loads/supports.h"
#include "fem/equations/loads/surface_loads.h"
#include "fem/equations/matrices/cholmod_factor.h"
#include "fem/equations/operators/stiffness.h"
#include "fem/mesh/grid/rigid_modes.h"
#include "fem/mesh/triangulation/body_grid.h"
#include "fem/models/solid/model.h"
#include "fem/solve/solvers/direct_solve.h"
#include "pipelines/command/calculix/calculix_model.h"
#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/respond/responses/response_files.h"
#include "tests/benchmarks/calculix/bare_cholmod.h"
#include "tests/benchmarks/solvers/benchmark_shaft.h"
#include "tests/verification/calculix/calculix_comparison.h"

namespace measure {
namespace {

double wall_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
double cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

struct Meshed {
  explicit Meshed(const Work& work)
      : mesh(pipelines::build_mesh(work.body)),
        body(pipelines::to_fem_body(mesh, work.body.material)),
        loads(seat_loads(mesh)) {}
  meshes::BodyMesh mesh;
  fem::Body body;
  std::vector<fem::UnitLoad> loads;
};

/// Smallest wall time, and smallest CPU time, of some calls.
struct Smallest {
  double wall = 1e300, cpu = 1e300;
  template <typename Call>
  void time(const Call& call) {
    const double wall_start = wall_s(), cpu_start = cpu_s();
    call();
    cpu = std::min(cpu, cpu_s() - cpu_start);
    wall = std::min(wall, wall_s() - wall_start);
  }
};

}  // namespace

void write_model(const Work& work) {
  const Meshed meshed(work);
  const auto loads = fem::nodal_loads(meshed.body, meshed.loads);
  std::vector<std::string> channels;
  for (const auto& load : meshed.loads) channels.push_back(load.channel);
  pipelines::write_calculix_model(work.directory / "shaft.inp", "benchmark", channels, work.body.material,
                                  loads);
  const pipelines::Serendipity kept(loads.nodes);
  std::printf("unknowns %zu\ncalculix_unknowns %zu\n", 3 * loads.nodes.n, 3 * kept.n_kept());
}

void solve(const Work& work, fem::Solver solver) {
  const Meshed meshed(work);
  double solve_wall_s = 0, solve_cpu_s = 0;
  const double wall = wall_s(), cpu = cpu_s();
  fem::SolverChoice choice;
  choice.solver = solver;
  const auto progress = [&](double, const std::string& step) {
    if (step == "loads") {
      solve_wall_s = wall_s();
      solve_cpu_s = cpu_s();
    } else if (step == "recover") {
      solve_wall_s = wall_s() - solve_wall_s;
      solve_cpu_s = cpu_s() - solve_cpu_s;
    }
  };
  const auto responses =
      fem::Model(meshed.body).unit_responses(meshed.loads, {}, fem::Recovery::patch, progress, choice);
  pipelines::write_unit_responses(work.directory / "unit_responses.h5", "benchmark", responses);
  std::printf("wall_s %.4f\ncpu_s %.4f\nsolve_wall_s %.4f\nsolve_cpu_s %.4f\nresidual %.3e\n",
              wall_s() - wall, cpu_s() - cpu, solve_wall_s, solve_cpu_s, responses.residual);
  if (responses.solver.used != solver) std::printf("another_solver 1\n");
}

void factorise(const Work& work) {
  const Meshed meshed(work);
  const auto grid = fem::make_grid(meshed.body);
  const auto cells = fem::cells_of_nodes(grid);
  const auto colours = fem::colour_cells(grid, cells);
  const auto integrals = fem::integrate_nodes(grid, colours);
  const auto& material = meshed.body.material;
  fem::BalancedLoads loads;
  loads.force = fem::load_vectors(grid, integrals, material.density_kg_m3, meshed.loads);
  loads.norm = loads.force.colwise().norm();
  loads.largest_entry = loads.force.colwise().lpNorm<Eigen::Infinity>();
  fem::RigidBalance(grid, integrals).balance(loads.force);
  const auto graph = fem::make_node_graph(grid, cells);
  auto matrix = fem::make_matrix(graph);
  fem::assemble_stiffness(grid, colours, graph, fem::lame(material), matrix);
  const fem::Supports supports(fem::choose_supports(grid), matrix);
  Eigen::MatrixXd force = loads.force;
  for (const auto row : supports.unknowns()) force.row(row).setZero();

  Smallest whole, solution, bare;
  Eigen::MatrixXd ours, theirs;
  for (int turn = 0; turn < 3; ++turn) {
    bare.time([&] { theirs = solve_with_bare_cholmod(matrix, force); });
    solution.time([&] {
      fem::CholmodFactor factor(graph, fem::order_nodes(graph));
      factor.factorise(matrix);
      ours = factor.solve(force);
    });
    whole.time([&] {
      fem::solve_directly(grid, cells, colours, fem::lame(material), loads,
                          [](double, const std::string&) {});
    });
  }
  std::printf(
      "with_assembly %.4f\nwithout_assembly %.4f\nwith_assembly_cpu %.4f\nwithout_assembly_cpu %.4f\nbare_s "
      "%.4f\napart %.1e\n",
      whole.wall / bare.wall, solution.wall / bare.wall, whole.cpu / bare.cpu, solution.cpu / bare.cpu,
      bare.wall, (ours - theirs).norm() / theirs.norm());
}

void compare(const Work& work) {
  const Meshed meshed(work);
  const auto ours = fem::Model(meshed.body).unit_responses(meshed.loads, {});
  std::vector<int> fillets;
  for (const auto& feature : meshed.mesh.features)
    if (feature.kind == meshes::Feature::Kind::fillet) fillets.push_back(feature.boundary_id);
  const auto agreements = pipelines::compare_with_calculix(
      ours, fem::nodal_loads(meshed.body, meshed.loads),
      pipelines::read_calculix_results(work.directory / "shaft.frd", ours.nodes.n), work.body.material,
      fillets);
  std::printf("  %-22s %12s %14s %27s %27s\n", "unit load", "displacement", "energy norm",
              "fillet, ours [Pa]", "CalculiX [Pa]");
  for (const auto& at : agreements)
    std::printf(
        "  %-22s %10.4f %% %12.3f %% %14.5g +- %9.3g %14.5g +- %9.3g%s\n", at.channel.c_str(),
        100 * at.displacement_difference,
        100 * std::sqrt(std::max(0.0, 1 - at.calculix_compliance_J / at.compliance_J)), at.ours.von_mises_Pa,
        at.ours.error_Pa, at.calculix.von_mises_Pa, at.calculix.error_Pa,
        std::abs(at.ours.von_mises_Pa - at.calculix.von_mises_Pa) <= at.ours.error_Pa + at.calculix.error_Pa
            ? ""
            : "  APART");
}

}  // namespace measure

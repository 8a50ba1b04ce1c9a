/// The solvers of unit responses on the shaft of shaft.toml, refined evenly: twelve load cases directly and
/// iteratively, and the operator against deal.II's and a sparse matrix. Ratios of one run.
///   solver_benchmarks <shaft.toml> [largest number of unknowns, default 700000] [picture.svg]
///       [largest number for the direct solver, default: what fits into memory]
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>

#include "fem/model.h"
#include "operator_comparison.h"
#include "pipelines/body_mesh.h"
#include "pipelines/scene.h"
#include "solver_comparison.h"
#include "solver_plot.h"

namespace {

constexpr int n_threads = 2;
constexpr int n_repeats_small = 3;
constexpr std::size_t small = 300000;  // unknowns: solved several times
constexpr std::size_t few = 100000;    // unknowns of the operators' bodies, at least

std::vector<fem::UnitLoad> twelve_loads(const meshes::BodyMesh& mesh) {
  using Component = fem::SurfaceResultant::Component;
  const std::pair<const char*, Component> components[] = {
      {"fx", Component::fx}, {"fy", Component::fy}, {"fz", Component::fz}, {"torque", Component::torque}};
  std::vector<fem::UnitLoad> loads;
  for (const auto& port : mesh.ports)
    if (port.kind == meshes::Port::Kind::seat)
      for (const auto& [name, component] : components)
        loads.push_back({port.name + "." + name, fem::SurfaceResultant{{fem::LoadSurface::Kind::seat,
                                                                        port.boundary_id,
                                                                        {port.axis_x_m, port.axis_y_m,
                                                                         (port.begin_m + port.end_m) / 2},
                                                                        port.radius_m,
                                                                        port.end_m - port.begin_m},
                                                                       component}});
  return loads;
}

struct Refinement {
  std::size_t n_dofs;  // about
  int fillet_cells, sectors;
};
constexpr Refinement refinements[] = {
    {65000, 2, 16}, {230000, 4, 28}, {670000, 4, 40}, {1460000, 6, 52}, {4010000, 8, 72}};

/// The shaft with cells of the same shape and other size.
pipelines::BodyScene refine(pipelines::BodyScene part, const Refinement& to) {
  auto& control = std::get<pipelines::ShaftShape>(part.shape).mesh;
  control.largest_cell_m *= control.n_sectors / double(to.sectors);
  control.cells_per_fillet_quarter = to.fillet_cells;
  control.n_sectors = to.sectors;
  return part;
}

/// Its middle segment alone, extruded, without ports.
pipelines::BodyScene extruded(pipelines::BodyScene part) {
  auto& shaft = std::get<pipelines::ShaftShape>(part.shape).geometry;
  shaft.segments = {shaft.segments.at(1)};
  shaft.fillets_m.clear();
  return part;
}

void run(const char* scene_file, std::size_t most, std::size_t most_direct,
         const std::filesystem::path& picture, const std::filesystem::path& directory) {
  const auto part = pipelines::read_scene(scene_file).bodies.at(0);
  const auto body_of = [&](const pipelines::BodyScene& scene) {
    const auto mesh = pipelines::build_mesh(scene, directory / "shaft.msh");
    return std::pair(pipelines::to_fem_body(mesh, scene.material), twelve_loads(mesh));
  };
  const auto middle = body_of(extruded(refine(part, {few, 4, 28}))).first;
  measure::compare_operators("extruded", middle, false);
  measure::compare_operators("distorted", middle, true);
  const auto whole = body_of(refine(part, refinements[1])).first;
  measure::compare_operators("stepped shaft with fillets", whole, false);

  measure::print_heading();
  std::vector<measure::SolverRow> rows;
  for (const auto& size : refinements) {
    if (size.n_dofs > most) break;
    const auto [body, loads] = body_of(refine(part, size));
    rows.push_back(measure::compare_solvers(body, loads, size.n_dofs < small ? n_repeats_small : 1,
                                            size.n_dofs <= most_direct));
    measure::print_row(rows.back(), loads.size());
  }
  measure::write_solver_plot(picture, rows);
  std::printf("%s\n", picture.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr,
                 "usage: solver_benchmarks <shaft.toml> [largest number of unknowns] [picture.svg] [largest "
                 "for the direct solver]\n");
    return 2;
  }
  const fem::Environment environment(argc, argv, n_threads);
  const auto directory =
      std::filesystem::temp_directory_path() / ("solver_benchmarks_" + std::to_string(getpid()));
  std::filesystem::create_directory(directory);
  int code = 0;
  try {
    run(argv[1], argc > 2 ? std::size_t(std::atof(argv[2])) : 700000,
        argc > 4 ? std::size_t(std::atof(argv[4])) : 100000000,
        argc > 3 ? argv[3] : "results/benchmarks/solvers.svg", directory);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    code = 1;
  }
  std::filesystem::remove_all(directory);
  return code;
}

#include "tests/benchmarks/solvers/halves.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "fem/base/common/memory.h"
#include "fem/models/solid/model.h"
#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/scene/whole/scene.h"
#include "tests/benchmarks/solvers/process.h"

namespace measure {

namespace {

using Component = fem::SurfaceResultant::Component;

/// fx and fy of the bores.
std::vector<fem::UnitLoad> mirrored_loads(const meshes::BodyMesh& mesh) {
  std::vector<fem::UnitLoad> loads;
  for (const auto& port : mesh.ports) {
    if (port.kind != meshes::Port::Kind::bore) continue;
    const fem::LoadSurface bore{fem::LoadSurface::Kind::seat,
                                port.boundary_id,
                                {port.axis_x_m, port.axis_y_m, (port.begin_m + port.end_m) / 2},
                                port.radius_m,
                                port.end_m - port.begin_m};
    for (const auto& [name, component] : {std::pair{".fx", Component::fx}, std::pair{".fy", Component::fy}})
      loads.push_back({port.name + name, fem::SurfaceResultant{bore, component}});
  }
  return loads;
}

struct Figures {
  double wall_s = 0, cpu_s = 0, flops = 0, factor_bytes = 0;
  std::vector<double> stress_Pa;
  std::size_t n_dofs = 0;
};

Figures solve(const fem::Body& body, const std::vector<fem::UnitLoad>& loads, bool by_halves) {
  fem::SolverChoice choice;
  choice.solver = fem::Solver::direct;
  choice.by_halves = by_halves;
  const fem::Model model(body);
  fem::release_free_memory();  // of the solve before
  const double wall = wall_s(), cpu = cpu_s();
  const auto responses = model.unit_responses(loads, {}, fem::Recovery::patch, {}, choice);
  return {wall_s() - wall,     cpu_s() - cpu,   responses.solver.factor.flops, responses.solver.factor.bytes,
          responses.stress_Pa, responses.n_dofs};
}

double difference(const Figures& a, const Figures& b) {
  double largest = 0, scale = 0;
  for (std::size_t i = 0; i < a.stress_Pa.size(); ++i) {
    largest = std::max(largest, std::abs(a.stress_Pa[i] - b.stress_Pa[i]));
    scale = std::max(scale, std::abs(a.stress_Pa[i]));
  }
  return largest / scale;
}

void print(const char* loads, const char* way, const Figures& figures) {
  std::printf("%9zu  %-28s %-9s %7.2f %7.2f %9.3g %7.2f\n", figures.n_dofs, loads, way, figures.wall_s,
              figures.cpu_s, 1e-9 * figures.flops, 1e-9 * figures.factor_bytes);
}

void compare(const fem::Body& body, const std::vector<fem::UnitLoad>& loads, const char* name) {
  const auto whole = solve(body, loads, false), halves = solve(body, loads, true);
  print(name, "whole", whole);
  print(name, "halves", halves);
  std::printf("%9s  seconds 1 : %.2f, operations 1 : %.2f, stresses differ by %.0e of the largest\n", "",
              whole.wall_s / halves.wall_s, whole.flops / halves.flops, difference(whole, halves));
}

}  // namespace

void compare_halves(const std::filesystem::path& scene_file) {
  const auto scene = pipelines::read_scene(scene_file);
  const auto found = std::find_if(scene.bodies.begin(), scene.bodies.end(), [](const auto& body) {
    return std::holds_alternative<pipelines::ChamberShape>(body.shape);
  });
  if (found == scene.bodies.end()) throw std::runtime_error(scene_file.string() + " has no chamber");
  std::printf("%9s  %-28s %-9s %7s %7s %9s %7s\n", "unknowns", "loads", "solved", "s", "CPU s", "1e9 flops",
              "GB");
  for (const int cells_through_wall : {1, 2}) {
    auto part = *found;
    std::get<pipelines::ChamberShape>(part.shape).mesh.cells_through_wall = cells_through_wall;
    const auto mesh = pipelines::build_mesh(part);
    const auto body = pipelines::to_fem_body(mesh, part.material);
    auto loads = mirrored_loads(mesh);
    compare(body, loads, "mirrored");
    auto along = std::get<fem::SurfaceResultant>(loads.front().shape);
    along.component = Component::fz;
    loads.push_back({"housing_bore.fz", along});
    compare(body, loads, "one along the axis besides");
  }
}

}  // namespace measure

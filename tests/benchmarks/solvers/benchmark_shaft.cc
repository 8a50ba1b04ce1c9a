#include "tests/benchmarks/solvers/benchmark_shaft.h"

#include <utility>

namespace measure {

pipelines::BodyScene refined_shaft(const pipelines::Scene& scene, const Refinement& refinement) {
  auto body = scene.bodies.at(0);
  auto& control = std::get<pipelines::ShaftShape>(body.shape).mesh;
  control.largest_cell_m *= refinement.stretch * control.n_sectors / double(refinement.sectors);
  control.cells_per_fillet_quarter = refinement.fillet_cells;
  control.n_sectors = refinement.sectors;
  return body;
}

std::vector<fem::UnitLoad> seat_loads(const meshes::BodyMesh& mesh) {
  using Component = fem::SurfaceResultant::Component;
  const std::pair<const char*, Component> components[] = {
      {"fx", Component::fx}, {"fy", Component::fy}, {"fz", Component::fz}, {"torque", Component::torque}};
  std::vector<fem::UnitLoad> loads;
  for (const auto& port : mesh.ports) {
    if (port.kind != meshes::Port::Kind::seat) continue;
    fem::LoadSurface seat;
    seat.boundary_id = port.boundary_id;
    seat.centre_m = {port.axis_x_m, port.axis_y_m, (port.begin_m + port.end_m) / 2};
    seat.radius_m = port.radius_m;
    seat.length_m = port.end_m - port.begin_m;
    for (const auto& [name, component] : components)
      loads.push_back({port.name + "." + name, fem::SurfaceResultant{seat, component}});
  }
  return loads;
}

}  // namespace measure

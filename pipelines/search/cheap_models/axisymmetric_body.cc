#include "pipelines/search/cheap_models/axisymmetric_body.h"

#include <fmt/core.h>

#include <cmath>
#include <stdexcept>

#include "fem/models/axisymmetric/axisymmetric_responses.h"
#include "meshes/shaft/half_section.h"
#include "meshes/shaft/shaft_description.h"
#include "meshes/values/refused.h"

namespace pipelines {
BodyScene with_coarse_blocks(const BodyScene& body) {
  BodyScene result = body;
  auto& mesh = std::get<ShaftShape>(result.shape).mesh;
  mesh.cells_per_fillet_quarter = 2;
  mesh.fillet_cells.clear();
  mesh.n_sectors = 8;
  mesh.growth = 1;
  mesh.largest_cell_m = 0;
  mesh.subdivisions = 1;
  return result;
}

fem::MeridianBody meridian_body(const BodyScene& body, const meshes::BodyMesh& mesh) {
  const ShaftShape& shape = *body.shaft();
  const auto half = meshes::build_half_section(shape.geometry, shape.mesh);
  fem::MeridianBody result;
  result.material = body.material;
  for (const auto& p : half.points) result.points_m.push_back({p.z_m, p.r_m});
  for (const auto& q : half.quads) result.cells.push_back({q.corners});
  for (const auto& e : half.edges) result.edges.push_back({e.ends, e.boundary_id});
  for (const auto& t : mesh.tori)
    result.tori.push_back({t.boundary_id, t.centre_z_m, t.centre_radius_m, t.radius_m});
  for (const auto& s : shape.geometry.segments)
    if (s.eccentricity_m != 0)
      result.eccentric.push_back({s.begin_m, s.end_m, s.diameter_m / 2,
                                  s.eccentricity_m * std::cos(s.eccentricity_angle_rad),
                                  s.eccentricity_m * std::sin(s.eccentricity_angle_rad)});
  return result;
}

MeshedBody describe_revolved(const BodyScene& body) {
  const BodyScene coarse = with_coarse_blocks(body);
  MeshedBody result;
  try {
    result.mesh = meshes::describe_shaft(coarse.shaft()->geometry, coarse.shaft()->mesh);
  } catch (const meshes::GeometryRefused& error) {
    throw meshes::GeometryRefused(body.origin + ": " + error.what());
  }
  auto& edges = result.mesh.sharp_edges;
  edges.insert(edges.end(), body.singular.begin(), body.singular.end());
  result.body = to_fem_body(result.mesh, body.material);
  auto section = meridian_body(coarse, result.mesh);
  section.n_cuts = 1;  // arcs of cubic cells: volumes to 1e-8
  result.masses = fem::axisymmetric_masses(section);
  result.regions.push_back({"", {}, result.masses});
  return result;
}

}  // namespace pipelines

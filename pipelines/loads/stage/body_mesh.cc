#include "pipelines/loads/stage/body_mesh.h"

#include "meshes/chamber/chamber.h"
#include "meshes/imported/imported.h"
#include "meshes/keyed_shaft/solid_shaft.h"
#include "meshes/shaft/shaft.h"
#include "meshes/values/refused.h"
#include "pipelines/base/common/several_ranks.h"
#include "pipelines/loads/stage/load_maker.h"
#include "pipelines/scene/whole/body_reader.h"

namespace pipelines {
namespace {

struct Build {
  meshes::BodyMesh operator()(const ShaftShape& shape) const {
    return shape.keyways.empty() ? meshes::build_shaft(shape.geometry, shape.mesh)
                                 : meshes::build_solid_shaft(shape.geometry, shape.keyways, shape.solid);
  }
  meshes::BodyMesh operator()(const ChamberShape& shape) const {
    return meshes::build_chamber(shape.geometry, shape.mesh);
  }
  meshes::BodyMesh operator()(const meshes::Import& shape) const { return meshes::build_imported(shape); }
};

/// The cells as fem takes them: it numbers and orders like the mesher.
std::shared_ptr<const fem::CoarseMesh> to_fem_mesh(const meshes::CellMesh& cells) {
  const bool tetrahedra = cells.kind == meshes::CellKind::tetrahedra;
  return std::make_shared<const fem::CoarseMesh>(
      fem::CoarseMesh{tetrahedra ? fem::CellKind::tetrahedra : fem::CellKind::hexahedra, cells.points,
                      cells.cells, cells.volume_id, cells.faces, cells.face_id});
}

/// The springs' own stiffness at their feet; along the axis as across (the planar papers give none).
std::vector<fem::ElasticSupport> elastic_feet(const meshes::BodyMesh& mesh,
                                              const std::vector<kinetics::Spring>& springs) {
  std::vector<fem::ElasticSupport> supports;
  for (std::size_t i = 0; i < springs.size(); ++i)
    for (const auto& port : mesh.ports) {
      if (port.name != "spring_foot_" + std::to_string(i + 1)) continue;
      fem::LoadSurface surface;
      surface.kind = fem::LoadSurface::Kind::face;
      surface.boundary_id = port.boundary_id;
      surface.centre_m = {port.axis_x_m, port.axis_y_m, 0.5 * (port.begin_m + port.end_m)};
      const auto& k = springs[i].stiffness_N_m;
      supports.push_back({surface, {k[0], k[1], k[0]}});
    }
  return supports;
}

/// Place where the scene has the key of a mesh control; the body's place if it leaves the key out.
std::string place_of(const std::string& control, const BodyScene& body) {
  const auto found = body.mesh_keys.find(mesh_key(control));
  return found == body.mesh_keys.end() ? body.origin : found->second;
}

std::vector<fem::LoadSurface> round_ports(const meshes::BodyMesh& mesh) {
  std::vector<fem::LoadSurface> seats;
  for (const auto& port : mesh.ports) {
    if (port.kind == meshes::Port::Kind::face) continue;
    fem::LoadSurface seat;
    seat.boundary_id = port.boundary_id;
    seat.centre_m = {port.axis_x_m, port.axis_y_m, 0.5 * (port.begin_m + port.end_m)};
    seat.radius_m = port.radius_m;
    seats.push_back(seat);
  }
  return seats;
}

}  // namespace

meshes::BodyMesh build_mesh(const BodyScene& body) {
  try {
    return std::visit(Build{}, body.shape);
  } catch (const meshes::TooManyCells& error) {
    throw meshes::GeometryRefused(place_of(error.control(), body) + ": " + error.what());
  } catch (const meshes::GeometryRefused& error) {
    throw meshes::GeometryRefused(body.origin + ": " + error.what());
  } catch (const meshes::MeshRefused& error) {
    throw meshes::MeshRefused(body.origin + ": " + error.what());
  }
}

fem::Body to_fem_body(const meshes::BodyMesh& mesh, const fem::Material& material) {
  fem::Body body;
  if (mesh.cells) body.mesh = to_fem_mesh(*mesh.cells);
  body.material = material;
  for (const auto& c : mesh.cylinders)
    body.cylinders.push_back(
        {c.volume_id, c.shift_x_m, c.shift_y_m, c.inner_radius_m, c.outer_radius_m, c.axis_x_m, c.axis_y_m});
  for (const auto& t : mesh.tori)
    body.tori.push_back({t.boundary_id, t.centre_z_m, t.centre_radius_m, t.radius_m});
  return body;
}

MeshedBody mesh_body(const BodyScene& body, const std::vector<kinetics::Spring>& springs,
                     const MeshedBody* coarse) {
  MeshedBody result;
  if (coarse != nullptr) {
    result.mesh = coarse->mesh;
  } else {
    result.mesh = build_mesh(body);
    auto& edges = result.mesh.sharp_edges;
    edges.insert(edges.end(), body.singular.begin(), body.singular.end());
  }
  result.body = to_fem_body(result.mesh, body.material);
  result.body.degree = body.degree;
  result.body.refinements = body.refinements;
  if (reader_of(body).has_elastic_feet(body))
    result.body.elastic_supports = elastic_feet(result.mesh, springs);
  result.model = std::make_shared<const fem::Model>(result.body, ranks_of_a_body());
  result.masses = result.model->mass_properties();
  result.geometry_error = result.model->geometry_error(round_ports(result.mesh));
  result.regions = load_maker_of(body).regions(result);
  return result;
}

}  // namespace pipelines

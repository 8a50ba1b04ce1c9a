#include "pipelines/loads/body_mesh.h"

#include "meshes/chamber/chamber.h"
#include "meshes/imported/imported.h"
#include "meshes/keyed_shaft/solid_shaft.h"
#include "meshes/shaft/shaft.h"
#include "meshes/values/refused.h"
#include "pipelines/common/several_ranks.h"
#include "pipelines/files/content_hash.h"
#include "pipelines/scene/body_kind.h"

namespace pipelines {
namespace {

struct Build {
  const std::filesystem::path& file;
  meshes::BodyMesh operator()(const ShaftShape& shape) const {
    return shape.keyways.empty()
               ? meshes::build_shaft(shape.geometry, shape.mesh, file)
               : meshes::build_solid_shaft(shape.geometry, shape.keyways, shape.solid, file);
  }
  meshes::BodyMesh operator()(const ChamberShape& shape) const {
    return meshes::build_chamber(shape.geometry, shape.mesh, file);
  }
  meshes::BodyMesh operator()(const meshes::Import& shape) const {
    return meshes::build_imported(shape, file);
  }
};

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

/// Where the scene has the key of a mesh control; the body's place if it leaves the key out.
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

MeshedBody::MeshedBody() = default;
MeshedBody::MeshedBody(const MeshedBody&) = default;
MeshedBody::MeshedBody(MeshedBody&&) noexcept = default;
MeshedBody& MeshedBody::operator=(const MeshedBody&) = default;
MeshedBody& MeshedBody::operator=(MeshedBody&&) noexcept = default;
MeshedBody::~MeshedBody() = default;

meshes::BodyMesh build_mesh(const BodyScene& body, const std::filesystem::path& file) {
  try {
    return std::visit(Build{file}, body.shape);
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
  body.mesh = mesh.file;
  body.material = material;
  for (const auto& c : mesh.cylinders)
    body.cylinders.push_back(
        {c.volume_id, c.shift_x_m, c.shift_y_m, c.inner_radius_m, c.outer_radius_m, c.axis_x_m, c.axis_y_m});
  for (const auto& t : mesh.tori)
    body.tori.push_back({t.boundary_id, t.centre_z_m, t.centre_radius_m, t.radius_m});
  return body;
}

MeshedBody mesh_body(const BodyScene& body, const std::filesystem::path& file,
                     const std::vector<kinetics::Spring>& springs, const MeshedBody* coarse) {
  const BodyKind& kind = kind_of(body);
  MeshedBody result;
  if (coarse != nullptr) {
    result.mesh = coarse->mesh;
  } else {
    result.mesh = build_mesh(body, file);
    auto& edges = result.mesh.sharp_edges;
    edges.insert(edges.end(), body.singular.begin(), body.singular.end());
  }
  result.body = to_fem_body(result.mesh, body.material);
  result.body.degree = body.degree;
  result.body.refinements = body.refinements;
  if (kind.has_elastic_feet(body)) result.body.elastic_supports = elastic_feet(result.mesh, springs);
  result.mesh_hash = coarse != nullptr
                         ? coarse->mesh_hash
                         : content_hash(file);  // once: reading it takes seconds where the mesh is large
  result.model = std::make_shared<const fem::Model>(result.body, ranks_of_a_body());
  result.masses = result.model->mass_properties();
  result.geometry_error = result.model->geometry_error(round_ports(result.mesh));
  result.regions = kind.regions(result);
  return result;
}

}  // namespace pipelines

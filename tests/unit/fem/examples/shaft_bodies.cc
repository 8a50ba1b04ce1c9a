#include "tests/unit/fem/examples/shaft_bodies.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "fem/equations/operators/stiffness.h"
#include "fem/mesh/triangulation/body_grid.h"
#include "meshes/shaft/half_section.h"
#include "meshes/shaft/shaft.h"

namespace fem_tests {

namespace {

std::size_t column(const fem::UnitResponses& responses, const std::string& channel) {
  const auto found = std::find(responses.channels.begin(), responses.channels.end(), channel);
  if (found == responses.channels.end()) throw std::out_of_range("no channel " + channel);
  return found - responses.channels.begin();
}

}  // namespace

std::shared_ptr<const fem::CoarseMesh> cells_of(const meshes::BodyMesh& mesh) {
  const auto& cells = *mesh.cells;
  const bool tetrahedra = cells.kind == meshes::CellKind::tetrahedra;
  return std::make_shared<const fem::CoarseMesh>(
      fem::CoarseMesh{tetrahedra ? fem::CellKind::tetrahedra : fem::CellKind::hexahedra, cells.points,
                      cells.cells, cells.volume_id, cells.faces, cells.face_id});
}

fem::Body steel_body(const meshes::BodyMesh& mesh) {
  fem::Body body;
  body.mesh = cells_of(mesh);
  body.material = steel;
  for (const auto& c : mesh.cylinders)
    body.cylinders.push_back(
        {c.volume_id, c.shift_x_m, c.shift_y_m, c.inner_radius_m, c.outer_radius_m, c.axis_x_m, c.axis_y_m});
  for (const auto& t : mesh.tori)
    body.tori.push_back({t.boundary_id, t.centre_z_m, t.centre_radius_m, t.radius_m});
  return body;
}

Eigen::MatrixXd stiffness_times(const fem::Grid& grid, Eigen::MatrixXd displacement) {
  const auto cells = fem::cells_of_nodes(grid);
  const auto graph = fem::make_node_graph(grid, cells);
  auto matrix = fem::make_matrix(graph);
  fem::assemble_stiffness(grid, fem::colour_cells(grid, cells), graph, fem::lame(steel), matrix);
  for (const auto node : grid.hanging.node) displacement.middleRows<3>(3 * Eigen::Index(node)).setZero();
  return fem::multiply(matrix, displacement);
}

ShaftBody build(const meshes::Shaft& shaft, const meshes::ShaftMeshControl& control) {
  const auto mesh = meshes::build_shaft(shaft, control);
  ShaftBody result;
  result.body = steel_body(mesh);
  for (const auto& p : mesh.ports) {
    const bool seat = p.kind == meshes::Port::Kind::seat;
    result.ports[p.name] = {seat ? fem::LoadSurface::Kind::seat : fem::LoadSurface::Kind::face,
                            p.boundary_id,
                            {p.axis_x_m, p.axis_y_m, (p.begin_m + p.end_m) / 2},
                            p.radius_m,
                            p.end_m - p.begin_m};
  }
  for (const auto& f : mesh.features) result.features[f.name] = f.boundary_id;
  for (const auto& s : mesh.sections)
    result.planes.push_back({s.z_m, s.radius_m, s.axis_x_m, s.axis_y_m, s.inner_radius_m});
  return result;
}

fem::MeridianBody half_section(const meshes::Shaft& shaft, const meshes::ShaftMeshControl& control) {
  const auto half = meshes::build_half_section(shaft, control);
  fem::MeridianBody body;
  body.material = steel;
  for (const auto& p : half.points) body.points_m.push_back({p.z_m, p.r_m});
  for (const auto& q : half.quads) body.cells.push_back({q.corners});
  for (const auto& e : half.edges) body.edges.push_back({e.ends, e.boundary_id});
  for (const auto& t : build(shaft, control).body.tori) body.tori.push_back(t);
  for (const auto& s : shaft.segments)
    if (s.eccentricity_m != 0)
      body.eccentric.push_back({s.begin_m, s.end_m, s.diameter_m / 2,
                                s.eccentricity_m * std::cos(s.eccentricity_angle_rad),
                                s.eccentricity_m * std::sin(s.eccentricity_angle_rad)});
  return body;
}

ShaftBody rod(int n_sectors) {
  meshes::Shaft shaft;
  shaft.segments = {{"rod", 0, 0.2, 0.05, 0, true}};
  meshes::ShaftMeshControl control;
  control.n_sectors = n_sectors;
  return build(shaft, control);
}

meshes::Shaft small_eccentric_shaft() {
  meshes::Shaft shaft;
  shaft.segments = {{"bearing_1", -0.06, -0.02, 0.03, 0, true},
                    {"seat", -0.02, 0.02, 0.05, 0.002, true},
                    {"bearing_2", 0.02, 0.06, 0.03, 0, true}};
  shaft.fillets_m = {0.003, 0.003};
  return shaft;
}

ShaftBody eccentric_shaft(int cells_per_fillet_quarter) {
  meshes::ShaftMeshControl control;
  control.cells_per_fillet_quarter = cells_per_fillet_quarter;
  control.n_sectors = 8;
  return build(small_eccentric_shaft(), control);
}

ShaftBody mirrored_shaft() {
  meshes::Shaft shaft;
  shaft.segments = {{"bearing_1", -0.06, -0.02, 0.03, 0, true},
                    {"seat", -0.02, 0, 0.05, 0, true},
                    {"rest", 0, 0.02, 0.05, 0, true},
                    {"bearing_2", 0.02, 0.06, 0.03, 0, true}};
  shaft.fillets_m = {0.003, 0, 0.003};
  meshes::ShaftMeshControl control;
  control.cells_per_fillet_quarter = 2;
  control.n_sectors = 8;
  return build(shaft, control);
}

fem::Body refined_at_random(fem::Body body, int n_cycles, double share, unsigned seed) {
  std::mt19937 random(seed);
  for (int cycle = 0; cycle < n_cycles; ++cycle) {
    const auto n_cells = fem::make_grid(body).n_cells();
    std::vector<std::int32_t> cut;
    for (std::size_t c = 0; c < n_cells; ++c)
      if (double(random()) < share * double(std::mt19937::max())) cut.push_back(std::int32_t(c));
    body.refinements.push_back({cut});
  }
  return body;
}

fem::UnitLoad resultant(const ShaftBody& body, const std::string& port,
                        fem::SurfaceResultant::Component component) {
  static const std::array<const char*, 6> names = {"fx", "fy", "fz", "mx", "my", "torque"};
  return {port + "." + names[static_cast<int>(component)],
          fem::SurfaceResultant{body.ports.at(port), component}};
}

std::array<double, 6> stress(const fem::UnitResponses& responses, const LoadCase& sum, std::size_t node) {
  std::array<double, 6> tensor{};
  for (const auto& [channel, factor] : sum)
    for (int c = 0; c < 6; ++c)
      tensor[c] +=
          factor *
          responses.stress_Pa[(node * responses.channels.size() + column(responses, channel)) * 6 + c];
  return tensor;
}

double difference(const std::vector<double>& a, const std::vector<double>& b,
                  const std::vector<std::size_t>& channels, std::size_t n_channels,
                  std::size_t n_components) {
  double worst = 0;
  for (const auto k : channels) {
    double largest = 0, scale = 0;
    for (std::size_t i = k * n_components; i < a.size(); i += n_channels * n_components)
      for (std::size_t c = 0; c < n_components; ++c) {
        largest = std::max(largest, std::abs(a[i + c] - b[i + c]));
        scale = std::max(scale, std::abs(b[i + c]));
      }
    worst = std::max(worst, largest / scale);
  }
  return worst;
}

fem::SectionResponse section(const fem::UnitResponses& responses, const LoadCase& sum, std::size_t plane) {
  fem::SectionResponse result;
  for (const auto& [channel, factor] : sum) {
    const auto& unit = responses.sections[plane * responses.channels.size() + column(responses, channel)];
    for (int c = 0; c < 6; ++c) result.resultant[c] += factor * unit.resultant[c];
    for (int c = 0; c < 2; ++c) result.mean_rim_shear_Pa[c] += factor * unit.mean_rim_shear_Pa[c];
    for (int c = 0; c < 3; ++c) {
      result.translation_m[c] += factor * unit.translation_m[c];
      result.rotation_rad[c] += factor * unit.rotation_rad[c];
    }
  }
  return result;
}

}  // namespace fem_tests

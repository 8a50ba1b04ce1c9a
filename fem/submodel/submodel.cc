#include "fem/submodel/submodel.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <string>

#include "fem/loads/surface_loads.h"
#include "fem/mesh/rigid_modes.h"
#include "fem/operators/cell_materials.h"
#include "fem/operators/symmetric_matrix.h"
#include "fem/solvers/direct_solve.h"
#include "fem/stress/stress_recovery.h"
#include "fem/stress/volumetric_stress.h"
#include "fem/submodel/cut_tetrahedra.h"

namespace fem {
namespace {

constexpr int rim = -1;  // boundary group of the faces where the submodel is cut out

double von_mises(const Eigen::Ref<const Eigen::RowVectorXd>& s) {
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  return std::sqrt((a * a + b * b + c * c) / 2 + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

/// Cells around a node: those that hold it, those that share a node with these, and so on; ascending.
std::vector<std::size_t> cells_around(const Nodes& nodes, std::size_t node, int n_layers) {
  std::vector<char> is_reached(nodes.n, 0), is_taken(nodes.n_cells(), 0);
  is_reached[node] = 1;
  for (int layer = 0; layer < n_layers; ++layer) {
    std::vector<std::size_t> added;
    for (std::size_t c = 0; c < nodes.n_cells(); ++c) {
      const auto cell = nodes.cell(c);
      if (is_taken[c] == 0 && std::any_of(cell.begin(), cell.end(),
                                          [&](std::int32_t i) { return is_reached[std::size_t(i)] != 0; }))
        added.push_back(c);
    }
    for (const auto c : added) {
      is_taken[c] = 1;
      for (const auto i : nodes.cell(c)) is_reached[std::size_t(i)] = 1;
    }
  }
  std::vector<std::size_t> cells;
  for (std::size_t c = 0; c < nodes.n_cells(); ++c)
    if (is_taken[c] != 0) cells.push_back(c);
  return cells;
}

using FaceCorners = std::array<std::int32_t, 3>;
FaceCorners sorted_corners(const std::int32_t* nodes, const std::vector<int>& local) {
  FaceCorners corners = {nodes[local[0]], nodes[local[1]], nodes[local[2]]};
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// The part of a body that a submodel takes in.
struct Part {
  GridField coarse;                // displacement of the load case, n x 3
  std::vector<std::int32_t> node;  // of the part's nodes: index in the whole body
};

Part cut_out(const UnitResponses& responses, const std::vector<std::size_t>& cells,
             const std::vector<double>& factors) {
  const auto& nodes = responses.nodes;
  Part part;
  auto& grid = part.coarse.grid;
  grid.kind = CellKind::tetrahedra;
  std::map<std::int32_t, std::int32_t> place;
  for (const auto c : cells) {
    grid.volume_id.push_back(nodes.cell_volume_id.empty() ? 0 : nodes.cell_volume_id[c]);
    for (const auto i : nodes.cell(c)) {
      const auto [known, is_new] = place.try_emplace(i, std::int32_t(part.node.size()));
      if (is_new) part.node.push_back(i);
      grid.cell_nodes.push_back(known->second);
    }
  }
  grid.n_nodes = part.node.size();
  part.coarse.field.setZero(Eigen::Index(grid.n_nodes), 3);
  for (std::size_t i = 0; i < grid.n_nodes; ++i) {
    const auto whole = std::size_t(part.node[i]);
    grid.xyz_m.insert(grid.xyz_m.end(), &nodes.xyz_m[3 * whole], &nodes.xyz_m[3 * whole] + 3);
    for (std::size_t k = 0; k < factors.size(); ++k)
      part.coarse.field.row(Eigen::Index(i)) +=
          factors[k] *
          Eigen::Map<const Eigen::RowVector3d>(&responses.displacement_m[3 * (whole * factors.size() + k)]);
  }

  std::map<FaceCorners, int> group;  // of the body's own surface
  for (std::size_t f = 0; f < nodes.n_faces(); ++f) {
    std::vector<std::int32_t> own;
    for (std::size_t v = 0; v < 3; ++v)
      if (const auto known = place.find(nodes.face(f)[v]); known != place.end()) own.push_back(known->second);
    if (own.size() == 3) group[sorted_corners(own.data(), {0, 1, 2})] = nodes.face_boundary_id[f];
  }
  std::map<FaceCorners, std::vector<BoundaryFace>> faces;
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (int f = 0; f < 4; ++f)
      faces[sorted_corners(grid.nodes_of(c), face_nodes(grid.shape(), f))].push_back(
          {std::int32_t(c), f, rim});
  for (auto& [corners, both] : faces) {
    if (both.size() > 1) continue;
    if (const auto own = group.find(corners); own != group.end()) both[0].boundary_id = own->second;
    grid.boundary.push_back(both[0]);
  }
  return part;
}

/// Groups that are held: the rim, and those where the body is loaded.
std::vector<int> held_groups(const std::vector<UnitLoad>& loads) {
  std::vector<int> groups = {rim};
  for (const auto& load : loads) {
    if (const auto* resultant = std::get_if<SurfaceResultant>(&load.shape))
      groups.push_back(resultant->surface.boundary_id);
    if (const auto* pressure = std::get_if<SeatPressure>(&load.shape))
      groups.push_back(pressure->surface.boundary_id);
  }
  return groups;
}

Eigen::VectorXd body_forces(const Grid& grid, const Material& material, const std::vector<UnitLoad>& loads,
                            const std::vector<double>& factors) {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(3 * Eigen::Index(grid.n_nodes));
  const std::set<int> present(grid.volume_id.begin(), grid.volume_id.end());
  for (std::size_t k = 0; k < loads.size(); ++k) {
    const auto* own = std::get_if<BodyForce>(&loads[k].shape);
    if (own == nullptr || factors[k] == 0) continue;
    std::vector<int> here;
    for (const int id : present)
      if (own->volume_ids.empty() ||
          std::find(own->volume_ids.begin(), own->volume_ids.end(), id) != own->volume_ids.end())
        here.push_back(id);
    if (!here.empty())
      force += factors[k] * body_force(integrate_nodes(grid, here), material.density_kg_m3, own->field);
  }
  return force;
}

/// The displacement where neither rim nor loaded surfaces hold it.
void solve_inside(GridField& fine, const Material& material, const std::vector<int>& held,
                  const Eigen::VectorXd& force) {
  const auto& grid = fine.grid;
  const auto cells = cells_of_nodes(grid);
  const auto colours = colour_cells(grid, cells);
  const CellMaterials materials(material);
  const auto graph = make_node_graph(grid, cells);
  auto stiffness = make_matrix(graph);
  assemble_stiffness(grid, colours, graph, materials.elastic(), stiffness);
  std::set<std::int64_t> clamped;
  for (const auto& face : grid.boundary)
    if (std::find(held.begin(), held.end(), face.boundary_id) != held.end())
      for (const int local : face_nodes(grid.shape(), face.face))
        for (int d = 0; d < 3; ++d)
          clamped.insert(3 * std::int64_t(grid.nodes_of(std::size_t(face.cell))[local]) + d);
  // What the known displacement leaves unbalanced is the load of the correction, which is nothing at the rim.
  const Eigen::Map<Eigen::VectorXd> known(fine.field.data(), fine.field.size());
  BalancedLoads loads;
  loads.force = force - multiply(stiffness, known);
  loads.clamped.assign(clamped.begin(), clamped.end());
  for (const auto i : clamped) loads.force(i, 0) = 0;
  loads.norm = loads.force.colwise().norm().cwiseMax(1e-300);
  loads.largest_entry = loads.force.colwise().lpNorm<Eigen::Infinity>().cwiseMax(1e-300);
  const auto solution =
      solve_directly(grid, cells, colours, materials, loads, [](double, const std::string&) {});
  Eigen::Map<Eigen::VectorXd>(fine.field.data(), fine.field.size()) += solution->displacement.col(0);
}

}  // namespace

SubmodelStress submodel_stress(const UnitResponses& responses, const Material& material,
                               const std::vector<UnitLoad>& loads, std::size_t node,
                               const std::vector<double>& factors, const std::vector<char>& left_out,
                               const SubmodelControl& control) {
  if (!responses.nodes.shape().is_tetrahedron())
    throw std::invalid_argument("submodel_stress: the cells are no tetrahedra");
  if (factors.size() != responses.channels.size() || loads.size() != factors.size())
    throw std::invalid_argument("submodel_stress: one load and one factor for every channel");
  if (node >= responses.nodes.n)
    throw std::invalid_argument("submodel_stress: there is no node " + std::to_string(node));
  const auto cells = cells_around(responses.nodes, node, control.n_layers);
  const auto part = cut_out(responses, cells, factors);
  GridField fine = part.coarse;
  for (int cut = 0; cut < control.n_cuts; ++cut) fine = cut_into_eight(fine);
  const auto held = held_groups(loads);
  solve_inside(fine, material, held, body_forces(fine.grid, material, loads, factors));

  const auto& grid = fine.grid;
  RowMajor stress(Eigen::Index(grid.n_nodes), 6);
  const PerCell<Lame> elastic = CellMaterials(material).elastic();
  recover_stress(grid, cells_of_nodes(grid), {}, free_faces(grid, held), elastic,
                 any_hardly_compresses(grid, elastic), fine.field, stress);

  SubmodelStress result;
  result.n_dofs = 3 * grid.n_nodes;
  const auto own =
      std::int32_t(std::find(part.node.begin(), part.node.end(), std::int32_t(node)) - part.node.begin());
  result.at_node_Pa = result.largest_Pa = von_mises(stress.row(own));
  // Cells keep their order, and eight (or 64) new ones stand for each old one.
  const std::size_t n_parts = grid.n_cells() / cells.size();
  std::vector<char> is_near(cells.size(), 0);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto whole = responses.nodes.cell(cells[c]);
    is_near[c] = char(std::find(whole.begin(), whole.end(), std::int32_t(node)) != whole.end() &&
                      std::none_of(whole.begin(), whole.end(), [&](std::int32_t i) {
                        return !left_out.empty() && left_out[std::size_t(i)] != 0;
                      }));
  }
  for (const auto& face : grid.boundary) {
    if (face.boundary_id == rim || is_near[std::size_t(face.cell) / n_parts] == 0) continue;
    for (const int local : face_nodes(grid.shape(), face.face)) {
      const auto i = grid.nodes_of(std::size_t(face.cell))[local];
      result.largest_Pa = std::max(result.largest_Pa, von_mises(stress.row(i)));
    }
  }
  return result;
}

}  // namespace fem

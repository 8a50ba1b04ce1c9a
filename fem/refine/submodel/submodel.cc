#include "fem/refine/submodel/submodel.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>

#include "fem/equations/loads/clamps.h"
#include "fem/equations/loads/surface_loads.h"
#include "fem/equations/matrices/symmetric_matrix.h"
#include "fem/equations/operators/nodes_export.h"
#include "fem/equations/operators/sharp_edges.h"
#include "fem/equations/operators/subdomain.h"
#include "fem/mesh/grid/cell_geometry.h"
#include "fem/mesh/grid/connected_pieces.h"
#include "fem/mesh/grid/rigid_modes.h"
#include "fem/refine/submodel/cut_cells.h"
#include "fem/solve/solvers/direct_solve.h"
#include "fem/stress/recovery/recovery_on_ranks.h"

namespace fem {
namespace {

constexpr int rim = -1;  // boundary group of the faces where the submodel is cut out

/// One number for all nodes at the same place: stress has the nodes of a sharp edge once for each side
/// (equations/operators/sharp_edges.h), displacement once. Cells of a body that touch share their nodes.
std::vector<std::int32_t> nodes_of_displacement(const Nodes& nodes) {
  std::vector<std::int32_t> number(nodes.n), on_surface = nodes.faces;
  std::iota(number.begin(), number.end(), 0);
  if (!nodes.shape().is_tetrahedron()) return number;
  const auto place = [&](std::int32_t i) {
    const double* x = &nodes.xyz_m[3 * std::size_t(i)];
    return std::array<double, 3>{x[0], x[1], x[2]};
  };
  std::sort(on_surface.begin(), on_surface.end());
  on_surface.erase(std::unique(on_surface.begin(), on_surface.end()), on_surface.end());
  std::stable_sort(on_surface.begin(), on_surface.end(),
                   [&](std::int32_t a, std::int32_t b) { return place(a) < place(b); });
  for (std::size_t k = 1; k < on_surface.size(); ++k)
    if (place(on_surface[k]) == place(on_surface[k - 1]))
      number[std::size_t(on_surface[k])] = number[std::size_t(on_surface[k - 1])];
  return number;
}

/// Cells around the nodes of a point: those that hold one, those that share a node with these, and so on;
/// ascending.
/// @param number  of each node (nodes_of_displacement)
std::vector<std::int32_t> cells_around(const Nodes& nodes, const std::vector<std::int32_t>& number,
                                       const std::vector<WeightedNode>& point, int n_layers) {
  std::vector<char> is_reached(nodes.n, 0), is_taken(nodes.n_cells(), 0);
  for (const auto& part : point) is_reached[std::size_t(number[part.node])] = 1;
  for (int layer = 0; layer < n_layers; ++layer) {
    std::vector<std::size_t> added;
    for (std::size_t c = 0; c < nodes.n_cells(); ++c) {
      const auto cell = nodes.cell(c);
      if (is_taken[c] == 0 && std::any_of(cell.begin(), cell.end(), [&](std::int32_t i) {
            return is_reached[std::size_t(number[std::size_t(i)])] != 0;
          }))
        added.push_back(c);
    }
    for (const auto c : added) {
      is_taken[c] = 1;
      for (const auto i : nodes.cell(c)) is_reached[std::size_t(number[std::size_t(i)])] = 1;
    }
  }
  std::vector<std::int32_t> cells;
  for (std::size_t c = 0; c < nodes.n_cells(); ++c)
    if (is_taken[c] != 0) cells.push_back(std::int32_t(c));
  return cells;
}

/// Enters the outer faces of some cells: the body's own with their group, others as the rim.
/// @param number   of the body's nodes (nodes_of_displacement)
/// @param of_grid  that of each node of the grid
void add_boundary(const Nodes& nodes, const std::vector<std::int32_t>& number,
                  const std::vector<std::int32_t>& of_grid, Grid& grid) {
  const auto sorted = [](std::vector<std::int32_t> corners) {
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  const auto places = face_corners(grid.shape());
  std::vector<char> is_here(nodes.n, 0);
  for (const auto node : of_grid) is_here[std::size_t(node)] = 1;
  std::map<std::vector<std::int32_t>, int> group;  // of the body's own surface, by its faces' corners
  for (std::size_t f = 0; f < nodes.n_faces(); ++f) {
    std::vector<std::int32_t> corners;
    for (std::size_t i = 0; i < places.size(); ++i)  // VTK begins with them
      corners.push_back(number[std::size_t(nodes.face(f)[i])]);
    if (is_here[std::size_t(corners[0])] != 0) group[sorted(corners)] = nodes.face_boundary_id[f];
  }
  const auto beyond = cells_beyond_faces(grid);
  const auto n_faces = std::size_t(grid.shape().n_faces());
  for (std::size_t k = 0; k < beyond.size(); ++k) {
    if (beyond[k] >= 0) continue;
    BoundaryFace face{std::int32_t(k / n_faces), int(k % n_faces), rim};
    const auto of_face = nodes_of_face(grid, k / n_faces, face.face);
    std::vector<std::int32_t> corners;
    for (const int place : places) corners.push_back(of_grid[std::size_t(of_face[std::size_t(place)])]);
    if (const auto own = group.find(sorted(corners)); own != group.end()) face.boundary_id = own->second;
    grid.boundary.push_back(face);
  }
}

/// The part of a body that a submodel takes in.
struct Part {
  GridField coarse;                // displacement, three columns per load case
  std::vector<std::int32_t> node;  // of the whole body, ascending
  std::vector<std::int32_t> row;   // of each of these: its node in the part
};

/// Nodes with one number become one; with the part's surface.
Part join(const Nodes& nodes, const std::vector<std::int32_t>& number, Subdomain part,
          const RowMajor& field) {
  Part joined{{std::move(part.grid), {}}, std::move(part.node), {}};
  auto& grid = joined.coarse.grid;
  std::map<std::int32_t, std::int32_t> row_of;
  std::vector<double> xyz_m;
  std::vector<Eigen::Index> kept;
  std::vector<std::int32_t> of_grid;
  for (std::size_t i = 0; i < joined.node.size(); ++i) {
    const auto [known, is_new] =
        row_of.try_emplace(number[std::size_t(joined.node[i])], std::int32_t(kept.size()));
    joined.row.push_back(known->second);
    if (!is_new) continue;
    kept.push_back(Eigen::Index(i));
    of_grid.push_back(known->first);
    xyz_m.insert(xyz_m.end(), grid.position(std::int32_t(i)), grid.position(std::int32_t(i)) + 3);
  }
  for (auto& node : grid.cell_nodes) node = joined.row[std::size_t(node)];
  grid.xyz_m = std::move(xyz_m);
  grid.n_nodes = kept.size();
  joined.coarse.field.resize(Eigen::Index(kept.size()), field.cols());
  for (std::size_t k = 0; k < kept.size(); ++k) joined.coarse.field.row(Eigen::Index(k)) = field.row(kept[k]);
  add_boundary(nodes, number, of_grid, grid);
  return joined;
}

/// @param cases  load cases as columns of factors, one row per channel
Part cut_out(const UnitResponses& responses, const std::vector<std::int32_t>& number,
             const std::vector<std::int32_t>& cells, const Eigen::MatrixXd& cases) {
  auto part = make_subdomain(responses.nodes, cells);
  const auto field = sum_of_channels(responses, NodalField::displacement, part.node, cases);
  return join(responses.nodes, number, std::move(part), field);
}

std::vector<int> with_rim(std::vector<int> groups) {
  groups.push_back(rim);
  return groups;
}

bool contains(const std::vector<int>& groups, int group) {
  return std::find(groups.begin(), groups.end(), group) != groups.end();
}

/// Groups with springs or clamps, whose force follows from the displacement of the whole body.
std::vector<int> supported_groups(const Body& body) {
  return loaded_groups({}, body);
}

/// The cells with a face of a group as a body of their own: all that a load of the group needs.
Grid cells_at_surface(const Nodes& nodes, int boundary_id) {
  std::vector<char> is_on_it(nodes.n, 0);
  for (std::size_t f = 0; f < nodes.n_faces(); ++f)
    if (nodes.face_boundary_id[f] == boundary_id)
      for (const auto i : nodes.face(f)) is_on_it[std::size_t(i)] = 1;
  const int n_corners = int(face_corners(nodes.shape()).size());
  std::vector<std::int32_t> cells;
  for (std::size_t c = 0; c < nodes.n_cells(); ++c) {
    const auto cell = nodes.cell(c);
    if (std::count_if(cell.begin(), cell.end(),
                      [&](std::int32_t i) { return is_on_it[std::size_t(i)] != 0; }) >= n_corners)
      cells.push_back(std::int32_t(c));
  }
  auto [grid, node, cell] = make_subdomain(nodes, cells);
  std::vector<std::int32_t> number(nodes.n);
  std::iota(number.begin(), number.end(), 0);
  add_boundary(nodes, number, node, grid);
  return std::move(grid);
}

/// Forces of the loads on those surfaces of a part that are not held.
Eigen::MatrixXd surface_forces(const Nodes& nodes, const Grid& part, const std::vector<UnitLoad>& loads,
                               const std::vector<int>& held, const Eigen::MatrixXd& cases) {
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(3 * Eigen::Index(part.n_nodes), cases.cols());
  std::vector<int> present;
  for (const auto& face : part.boundary)
    if (!contains(held, face.boundary_id) && !contains(present, face.boundary_id))
      present.push_back(face.boundary_id);
  for (std::size_t k = 0; k < loads.size(); ++k) {
    const auto* surface = surface_of(loads[k]);
    if (surface == nullptr || !contains(present, surface->boundary_id) ||
        cases.row(Eigen::Index(k)).isZero(0))
      continue;
    const Grid whole = cells_at_surface(nodes, surface->boundary_id);
    const LoadedSurface loaded(whole, *surface);
    const auto* resultant = std::get_if<SurfaceResultant>(&loads[k].shape);
    force += (resultant != nullptr ? loaded.resultant_on(part, resultant->component)
                                   : loaded.pressure_on(part, std::get<SeatPressure>(loads[k].shape))) *
             cases.row(Eigen::Index(k));
  }
  return force;
}

Eigen::MatrixXd body_forces(const Grid& grid, const Material& material, const std::vector<UnitLoad>& loads,
                            const Eigen::MatrixXd& cases) {
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(3 * Eigen::Index(grid.n_nodes), cases.cols());
  const std::set<int> present(grid.volume_id.begin(), grid.volume_id.end());
  for (std::size_t k = 0; k < loads.size(); ++k) {
    const auto* own = std::get_if<BodyForce>(&loads[k].shape);
    if (own == nullptr || cases.row(Eigen::Index(k)).isZero(0)) continue;
    std::vector<int> here;
    for (const int id : present)
      if (own->volume_ids.empty() ||
          std::find(own->volume_ids.begin(), own->volume_ids.end(), id) != own->volume_ids.end())
        here.push_back(id);
    if (!here.empty())
      force += body_force(integrate_nodes(grid, here), material.density_kg_m3, own->field) *
               cases.row(Eigen::Index(k));
  }
  return force;
}

/// The displacement where no surface holds it.
void solve_inside(GridField& fine, const Material& material, const std::vector<int>& held,
                  const Eigen::MatrixXd& force) {
  const auto& grid = fine.grid;
  const auto cells = cells_of_nodes(grid);
  const auto colours = colour_cells(grid, cells);
  const auto graph = make_node_graph(grid, cells);
  auto stiffness = make_matrix(graph);
  assemble_stiffness(grid, colours, graph, lame(material), stiffness);
  std::set<std::int64_t> clamped;
  for (const auto& face : grid.boundary)
    if (contains(held, face.boundary_id))
      for (const int local : face_nodes(grid.shape(), face.face))
        for (int d = 0; d < 3; ++d)
          clamped.insert(3 * std::int64_t(grid.nodes_of(std::size_t(face.cell))[local]) + d);
  // What the known displacement leaves unbalanced is the load of the correction, which is nothing at the rim.
  const auto n = 3 * Eigen::Index(grid.n_nodes), n_cases = fine.field.cols() / 3;
  Eigen::MatrixXd known(n, n_cases);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < n_cases; ++k) known(i, k) = fine.field(i / 3, 3 * k + i % 3);
  BalancedLoads loads;
  loads.force = force - multiply(stiffness, known);
  loads.clamped.assign(clamped.begin(), clamped.end());
  clear_rows(loads.clamped, loads.force);
  loads.norm = loads.force.colwise().norm().cwiseMax(1e-300);
  loads.largest_entry = loads.force.colwise().lpNorm<Eigen::Infinity>().cwiseMax(1e-300);
  const auto solution =
      solve_directly(grid, cells, colours, lame(material), loads, [](double, const std::string&) {});
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < n_cases; ++k)
      fine.field(i / 3, 3 * k + i % 3) += solution.displacement(i, k);
}

/// A submodel of some load cases, solved.
struct Solved {
  std::vector<std::int32_t> cells;  ///< of the whole body
  Part part;
  std::size_t n_dofs = 0;
  Grid fine;        ///< with the nodes that stress has
  RowMajor stress;  ///< n_nodes x 6 per load case
};

Solved solve_submodel(const UnitResponses& responses, const Body& body, const std::vector<UnitLoad>& loads,
                      const std::vector<WeightedNode>& point, const Eigen::MatrixXd& cases,
                      const SubmodelControl& control) {
  if (responses.nodes.degree != 2) throw std::invalid_argument("submodel: the cells are not of degree 2");
  if (std::size_t(cases.rows()) != responses.channels.size() || loads.size() != responses.channels.size())
    throw std::invalid_argument("submodel: one load and one factor for every channel");
  for (const auto& p : point)
    if (p.node >= responses.nodes.n)
      throw std::invalid_argument("submodel: there is no node " + std::to_string(p.node));
  Solved solved;
  const auto number = nodes_of_displacement(responses.nodes);
  solved.cells = cells_around(responses.nodes, number, point, control.n_layers);
  solved.part = cut_out(responses, number, solved.cells, cases);
  GridField fine = solved.part.coarse;
  for (int cut = 0; cut < control.n_cuts; ++cut) fine = cut_into_eight(fine);
  const auto not_free = with_rim(loaded_groups(loads, body));
  const auto held = control.loaded_faces == LoadedFaces::held ? not_free : with_rim(supported_groups(body));
  solve_inside(fine, body.material, held,
               body_forces(fine.grid, body.material, loads, cases) +
                   surface_forces(responses.nodes, fine.grid, loads, held, cases));
  solved.n_dofs = 3 * fine.grid.n_nodes;
  auto [seen, copy] = split_at_sharp_edges(fine.grid, cells_of_nodes(fine.grid), rim);
  fine.field.conservativeResize(Eigen::Index(seen.n_nodes), Eigen::NoChange);
  for (std::size_t k = 0; k < copy.size(); ++k)
    fine.field.row(Eigen::Index(fine.grid.n_nodes + k)) = fine.field.row(copy[k]);
  solved.stress.resize(Eigen::Index(seen.n_nodes), 6 * cases.cols());
  recover_stress(seen, cells_of_nodes(seen), lame(body.material), body.cylinders, not_free, true, fine.field,
                 solved.stress);
  solved.fine = std::move(seen);
  return solved;
}

template <typename Is>
bool any_face(const Nodes& nodes, const std::vector<int>& groups, const Is& is) {
  for (std::size_t f = 0; f < nodes.n_faces(); ++f)
    if (contains(groups, nodes.face_boundary_id[f]) && is(nodes.face(f))) return true;
  return false;
}

Eigen::RowVectorXd at_point(const Solved& solved, const std::vector<WeightedNode>& point) {
  const auto& nodes = solved.part.node;
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(solved.stress.cols());
  for (const auto& p : point)
    sum +=
        p.weight * solved.stress.row(solved.part.row[std::size_t(
                       std::lower_bound(nodes.begin(), nodes.end(), std::int32_t(p.node)) - nodes.begin())]);
  return sum;
}

/// The largest von Mises stress on the surface in the cells that hold a node of the point; of one load case.
/// Fine nodes that are left out do not count.
double largest_beside(const UnitResponses& responses, const Solved& solved,
                      const std::vector<WeightedNode>& point, const LeftOut& left_out) {
  const auto holds_point = [&](const NodeList& cell) {
    return std::any_of(point.begin(), point.end(), [&](const WeightedNode& p) {
      return std::find(cell.begin(), cell.end(), std::int32_t(p.node)) != cell.end();
    });
  };
  std::vector<char> is_searched;
  for (const auto c : solved.cells)
    is_searched.push_back(char(holds_point(responses.nodes.cell(std::size_t(c)))));
  const auto& fine = solved.fine;
  const std::size_t n_parts = fine.n_cells() / solved.cells.size();  // they follow each other
  double largest_Pa = 0;
  for (const auto& face : fine.boundary) {
    if (face.boundary_id == rim || is_searched[std::size_t(face.cell) / n_parts] == 0) continue;
    for (const int local : face_nodes(fine.shape(), face.face)) {
      const auto node = fine.nodes_of(std::size_t(face.cell))[local];
      const double *x = fine.position(node), stress_Pa = von_mises(&solved.stress(node, 0));
      if (stress_Pa > largest_Pa && !(left_out && left_out({x[0], x[1], x[2]}, face.boundary_id)))
        largest_Pa = stress_Pa;
    }
  }
  return largest_Pa;
}

}  // namespace

SubmodelStress submodel_stress(const UnitResponses& responses, const Body& body,
                               const std::vector<UnitLoad>& loads, const std::vector<WeightedNode>& point,
                               const std::vector<double>& factors, const LeftOut& left_out,
                               const SubmodelControl& control) {
  const Eigen::Map<const Eigen::VectorXd> one_case(factors.data(), Eigen::Index(factors.size()));
  const auto solved = solve_submodel(responses, body, loads, point, one_case, control);
  SubmodelStress result;
  result.n_dofs = solved.n_dofs;
  result.at_point_Pa = von_mises(at_point(solved, point).data());
  result.largest_Pa = std::max(result.at_point_Pa, largest_beside(responses, solved, point, left_out));
  return result;
}

bool is_on_load(const UnitResponses& responses, const Body& body, const std::vector<UnitLoad>& loads,
                const std::vector<WeightedNode>& point) {
  const auto holds = [](const NodeList& face, std::size_t node) {
    return std::find(face.begin(), face.end(), std::int32_t(node)) != face.end();
  };
  return any_face(responses.nodes, loaded_groups(loads, body), [&](const NodeList& face) {
    return std::any_of(point.begin(), point.end(),
                       [&](const WeightedNode& p) { return holds(face, p.node); });
  });
}

bool is_beside_support(const UnitResponses& responses, const Body& body,
                       const std::vector<WeightedNode>& point) {
  const auto& nodes = responses.nodes;
  std::vector<char> is_near(nodes.n, 0);
  for (const auto c : cells_around(nodes, nodes_of_displacement(nodes), point, 1))
    for (const auto i : nodes.cell(std::size_t(c))) is_near[std::size_t(i)] = 1;
  return any_face(nodes, supported_groups(body), [&](const NodeList& face) {
    return std::all_of(face.begin(), face.end(),
                       [&](std::int32_t i) { return is_near[std::size_t(i)] != 0; });
  });
}

std::vector<std::array<double, 6>> submodel_unit_stress_Pa(const UnitResponses& responses, const Body& body,
                                                           const std::vector<UnitLoad>& loads,
                                                           const std::vector<WeightedNode>& point,
                                                           const SubmodelControl& control) {
  const auto n = Eigen::Index(responses.channels.size());
  const auto sum = at_point(
      solve_submodel(responses, body, loads, point, Eigen::MatrixXd::Identity(n, n), control), point);
  std::vector<std::array<double, 6>> unit(responses.channels.size());
  for (std::size_t k = 0; k < unit.size(); ++k)
    for (std::size_t c = 0; c < 6; ++c) unit[k][c] = sum[Eigen::Index(6 * k + c)];
  return unit;
}

}  // namespace fem

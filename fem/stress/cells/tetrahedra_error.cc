#include "fem/stress/cells/tetrahedra_error.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "fem/equations/operators/nodes_export.h"
#include "fem/equations/operators/subdomain.h"
#include "fem/stress/cells/cell_stress.h"

namespace fem {
namespace {

/// Four points, exact for squares of linear fields: Hammer, Marlowe and Stroud (1956), a = (5 - sqrt 5) / 20.
constexpr double near_corner = 0.58541019662496845, far_from_it = 0.13819660112501051;
const ReferencePoints points = {{far_from_it, far_from_it, far_from_it},
                                {near_corner, far_from_it, far_from_it},
                                {far_from_it, near_corner, far_from_it},
                                {far_from_it, far_from_it, near_corner}};

/// The node itself if it is a corner, else the ends of its edge.
std::vector<std::int32_t> corners_of(const Nodes& nodes, std::size_t node) {
  for (std::size_t c = 0; c < nodes.n_cells(); ++c) {
    const auto cell = nodes.cell(c);
    const auto local = std::size_t(std::find(cell.begin(), cell.end(), std::int32_t(node)) - cell.begin());
    if (local < 4) return {std::int32_t(node)};
    if (local < cell.size())
      return {cell[tetrahedron_edges[local - 4][0]], cell[tetrahedron_edges[local - 4][1]]};
  }
  throw std::invalid_argument("cells_against_recovered: no cell holds node " + std::to_string(node));
}

}  // namespace

CellsAgainstRecovered cells_against_recovered(const UnitResponses& responses, const Material& material,
                                              std::size_t node, const std::vector<double>& factors) {
  const auto& nodes = responses.nodes;
  if (!nodes.shape().is_tetrahedron())
    throw std::invalid_argument("cells_against_recovered: the cells are no tetrahedra");
  if (factors.size() != responses.channels.size())
    throw std::invalid_argument("cells_against_recovered: one factor for every channel");
  const auto corners = corners_of(nodes, node);
  std::vector<std::int32_t> around;
  for (std::size_t c = 0; c < nodes.n_cells(); ++c) {
    const auto cell = nodes.cell(c);
    if (std::any_of(corners.begin(), corners.end(), [&](std::int32_t corner) {
          return std::find(cell.begin(), cell.begin() + 4, corner) != cell.begin() + 4;
        }))
      around.push_back(std::int32_t(c));
  }
  const Subdomain part = make_subdomain(nodes, around);
  const Eigen::Map<const Eigen::VectorXd> load_case(factors.data(), Eigen::Index(factors.size()));
  const RowMajor displacement = sum_of_channels(responses, NodalField::displacement, part.node, load_case),
                 recovered = sum_of_channels(responses, NodalField::stress, part.node, load_case);
  const Tabulation at = tabulate_in_cell(nodes.shape(), points);
  CellStress of_cell(part.grid, at, lame(material), displacement);
  RowMajor difference(at.n_points, 6);
  double squares = 0, volume = 0;
  for (std::size_t c = 0; c < around.size(); ++c) {
    of_cell(c, difference);
    for (int q = 0; q < at.n_points; ++q) {
      for (int i = 0; i < at.n_shapes; ++i)
        difference.row(q) -=
            at.value[std::size_t(q * at.n_shapes + i)] * recovered.row(part.grid.nodes_of(c)[i]);
      const double determinant = jacobian(part.grid, c, at, q).determinant(),
                   size = von_mises(&difference(q, 0));
      squares += determinant * size * size;
      volume += determinant;
    }
  }
  const RowMajor own = sum_of_channels(responses, NodalField::stress, {std::int32_t(node)}, load_case);
  return {von_mises(own.data()), std::sqrt(squares / volume)};
}

}  // namespace fem

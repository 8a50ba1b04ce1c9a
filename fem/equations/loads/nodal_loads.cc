#include "fem/equations/loads/nodal_loads.h"

#include <stdexcept>

#include "fem/equations/loads/supports.h"
#include "fem/equations/loads/surface_loads.h"
#include "fem/equations/operators/nodes_export.h"
#include "fem/equations/operators/stiffness.h"
#include "fem/mesh/grid/rigid_modes.h"
#include "fem/mesh/triangulation/body_grid.h"

namespace fem {

NodalLoads nodal_loads(const Body& body, const std::vector<UnitLoad>& loads) {
  if (!body.clamps.empty() || !body.elastic_supports.empty())
    throw std::invalid_argument(
        "nodal forces are those of a free body: leave out its clamps and elastic supports");
  refuse_impossible(body.material);
  const Grid grid = make_grid(body);
  const auto integrals = integrate_nodes(grid, colour_cells(grid, cells_of_nodes(grid)));
  Eigen::MatrixXd force = load_vectors(grid, integrals, body.material.density_kg_m3, loads);
  RigidBalance(grid, integrals).balance(force);
  NodalLoads result;
  result.nodes = export_nodes(grid, integrals);
  result.force_N.assign(force.data(), force.data() + force.size());
  result.held = choose_supports(grid);
  return result;
}

}  // namespace fem

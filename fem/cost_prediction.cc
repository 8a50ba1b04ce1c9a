#include "fem/cost_prediction.h"

#include "fem/cell_materials.h"
#include "fem/mesh_reader.h"
#include "fem/solver_prediction.h"

namespace fem {

SolverReport predict_solver(const Body& body, std::size_t n_loads, const SolverChoice& choice) {
  const Grid grid = read_grid(body);
  return choose_solver(grid, CellMaterials(grid, body), n_loads, choice, physical_memory());
}

}  // namespace fem

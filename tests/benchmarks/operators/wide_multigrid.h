/// The one function of the shared objects that wide_multigrid.cc becomes: conjugate gradients with deal.II's
/// global-coarsening multigrid, as its users write it.
#pragma once

#include <deal.II/grid/tria.h>

#include <cstddef>
#include <string>
#include <vector>

#include "fem/mesh/grid.h"

namespace measure {

/// A body of degree 2 that nothing holds, under loads without resultants.
struct MultigridProblem {
  const dealii::Triangulation<3>* mesh;
  const fem::Grid* grid;  ///< made of the same mesh: its nodes give the shape
  double lambda_Pa, mu_Pa;
  std::size_t n_loads;
  const double* force;  ///< 3 n_nodes x n_loads, load after load; none at hanging nodes
};

struct MultigridControl {
  int smoother_degree = 5;
  double smoothing_range = 20;
  double relative_tolerance = 1e-10;  ///< of the residual, by that of the load
  int max_steps = 200;
};

struct MultigridAnswer {
  std::vector<std::size_t> n_dofs;  ///< of the levels, constrained ones too; the finest first
  int n_lanes = 0, n_steps = 0;     ///< numbers in double; most steps of a load
  bool converged = true;            ///< all loads
  double set_up_cpu_s = 0, solve_cpu_s = 0;
  std::vector<double> displacement;  ///< as the force, with some rigid motion
};

}  // namespace measure

extern "C" void solve_by_wide_multigrid(const measure::MultigridProblem& problem,
                                        const measure::MultigridControl& control,
                                        measure::MultigridAnswer& answer);

#include "fem/solver_prediction.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "fem/iterative_solve.h"

namespace fem {

namespace {

// What is saved has to be worth an answer to 1e-10 instead of rounding.
constexpr double worth_seconds = 1;
// Cells more stretched than that cost more iterations than they save (the smoother is pointwise).
constexpr double most_stretched = 12;
// Beyond it the smoother loses its grip on motions that keep volume.
constexpr double most_incompressible = 0.45;
// Other arrays of a run (responses, recovery) live beside the solver's.
constexpr double share_of_memory = 0.8;

std::string cost_text(const SolverReport& report) {
  std::ostringstream text;
  text << std::setprecision(2) << "direct " << report.predicted_direct.seconds << " s, "
       << 1e-9 * report.predicted_direct.bytes << " GB; iterative " << report.predicted_iterative.seconds
       << " s, " << 1e-9 * report.predicted_iterative.bytes << " GB predicted";
  return text.str();
}

}  // namespace

double largest_aspect(const Grid& grid) {
  if (grid.shape().is_tetrahedron()) return 0;
  const auto corner = corner_nodes(grid.shape());
  double largest = 1;
  for (std::size_t c = 0; c < grid.n_cells(); ++c) {
    double length[3] = {0, 0, 0};
    for (int axis = 0; axis < 3; ++axis)
      for (int k = 0; k < 8; ++k)
        if (((k >> axis) & 1) == 0) {
          const double* a = grid.position(grid.nodes_of(c)[corner[k]]);
          const double* b = grid.position(grid.nodes_of(c)[corner[k | (1 << axis)]]);
          length[axis] += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
        }
    largest =
        std::max(largest, *std::max_element(length, length + 3) / *std::min_element(length, length + 3));
  }
  return largest;
}

SolverCost predict_direct(std::size_t n_dofs, std::size_t n_loads) {
  const double n = static_cast<double>(n_dofs) / 2e5;
  const double factor = 7.0 * std::pow(n, 1.75), solve = 0.03 * std::pow(n, 1.3);
  return {factor + solve * static_cast<double>(n_loads), 3.4e9 * std::pow(n, 1.3)};
}

SolverCost predict_iterative(const Grid& grid, std::size_t n_loads, double aspect) {
  const double dofs = 3.0 * static_cast<double>(grid.n_nodes);
  const int k = grid.degree;
  const SolverCost coarse = predict_direct(static_cast<std::size_t>(dofs / (k * k * k)), 0);
  const double iterations = 8 + 2.3 * aspect;
  const double per_iteration = 3.5e-8 * dofs * static_cast<double>(n_loads) + 0.05 * coarse.seconds;
  const double vectors =
      dofs * std::min<double>(double(loads_per_block(3 * grid.n_nodes)), static_cast<double>(n_loads)) * 60;
  return {1.5e-6 * dofs + coarse.seconds + iterations * per_iteration, 300 * dofs + vectors + coarse.bytes};
}

double physical_memory() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

SolverReport choose_solver(const Grid& grid, const Material& material, std::size_t n_loads,
                           const SolverChoice& choice, double memory_bytes) {
  SolverReport report;
  report.predicted_direct = predict_direct(3 * grid.n_nodes, n_loads);
  report.largest_aspect = largest_aspect(grid);
  report.coarse_level = choice.coarse_level;
  if (report.coarse_level == CoarseLevel::automatic)
    report.coarse_level = 3 * grid.n_nodes / 8 > 40000 ? CoarseLevel::aggregated : CoarseLevel::factorised;
  const auto take = [&](Solver solver, const std::string& reason) {
    report.used = solver;
    report.reason = reason;
    return report;
  };
  if (grid.shape().is_tetrahedron()) return take(Solver::direct, "the body has tetrahedra");
  if (grid.degree < 2) return take(Solver::direct, "cells of degree 1 have no coarser polynomials");
  report.predicted_iterative = predict_iterative(grid, n_loads, report.largest_aspect);
  if (choice.solver != Solver::automatic) return take(choice.solver, "as asked for");
  if (report.largest_aspect > most_stretched) {
    std::ostringstream text;
    text << "cells are stretched up to 1 : " << std::setprecision(3) << report.largest_aspect;
    return take(Solver::direct, text.str());
  }
  if (material.poisson_ratio > most_incompressible) {
    std::ostringstream text;
    text << "Poisson's ratio is " << material.poisson_ratio;
    return take(Solver::direct, text.str());
  }
  const bool direct_fits = report.predicted_direct.bytes < share_of_memory * memory_bytes;
  const bool iterative_fits = report.predicted_iterative.bytes < share_of_memory * memory_bytes;
  if (!direct_fits && iterative_fits)
    return take(Solver::iterative, "the factor would not fit into memory: " + cost_text(report));
  if (!direct_fits && !iterative_fits)
    return take(
        report.predicted_direct.bytes < report.predicted_iterative.bytes ? Solver::direct : Solver::iterative,
        "neither may fit into memory, this one needs less: " + cost_text(report));
  if (!iterative_fits)
    return take(Solver::direct, "the vectors would not fit into memory: " + cost_text(report));
  const bool worth_it = report.predicted_iterative.seconds + worth_seconds < report.predicted_direct.seconds;
  return worth_it ? take(Solver::iterative, "faster: " + cost_text(report))
                  : take(Solver::direct, "as fast: " + cost_text(report));
}

}  // namespace fem

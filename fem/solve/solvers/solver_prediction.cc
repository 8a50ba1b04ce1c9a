#include "fem/solve/solvers/solver_prediction.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>

#include "fem/base/values/cost_constants.h"
#include "fem/base/values/errors.h"

namespace fem {

namespace {

std::string gigabytes(double bytes) {
  std::ostringstream text;
  text << std::setprecision(bytes < 1e10 ? 2 : 3) << 1e-9 * bytes << " GB";
  return text.str();
}

void refuse(const std::string& what, double bytes, std::size_t n_dofs, double memory_bytes) {
  if (bytes <= memory_bytes) return;
  throw DoesNotFit(
      "a body of " + std::to_string(n_dofs) + " unknowns does not fit into memory: its " + what + " needs " +
      gigabytes(bytes) + ", " + gigabytes(memory_bytes) +
      " are left; mesh with larger cells, take a lower degree, or use a machine with more memory");
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
  const double n = static_cast<double>(n_dofs) / cost::direct_unit;
  const double factor = cost::direct_s_linear * n + cost::direct_s_square * n * n,
               solve = cost::direct_s_per_load * std::pow(n, cost::direct_exponent);
  return {factor + solve * static_cast<double>(n_loads),
          cost::direct_bytes * std::pow(n, cost::direct_exponent)};
}

SolverCost predict_direct(const FactorSize& factor, std::size_t n_loads) {
  const double n = double(factor.n_dofs), k = double(n_loads);
  const double s_per_flop =
      factor.flops < flops_worth_threads ? cost::factor_s_per_flop_alone : cost::factor_s_per_flop_shared;
  return {cost::factor_s_per_dof * n + s_per_flop * factor.flops +
              (cost::factor_s_per_entry * factor.entries + cost::factor_s_per_response * n) * k,
          factor.bytes};
}

FactorSize scaled(const FactorSize& factor, std::size_t n_dofs) {
  const double ratio = double(n_dofs) / double(factor.n_dofs), larger = std::pow(ratio, 4.0 / 3);
  return {n_dofs, factor.entries * larger, factor.flops * ratio * ratio, factor.bytes * larger};
}

SolverCost predict_iterative(std::size_t n_dofs, std::size_t n_loads, double aspect) {
  const double n = double(n_dofs);
  const double steps = cost::iteration_steps + cost::iteration_steps_per_aspect * aspect;
  return {n * (cost::iteration_setup_s_per_dof + steps * cost::iteration_s_per_dof * double(n_loads)),
          n * cost::iteration_bytes_per_dof};
}

double cells_of_first_rank(std::size_t n_dofs, int n_ranks) {
  const double n = double(n_dofs), all = predict_iterative(n_dofs, 1, 1).bytes,
               factor = std::min(cost::lower_factor_bytes * std::pow(n, 4.0 / 3), all / 2),
               first = all / n_ranks - factor, other = (all - factor - first) / (n_ranks - 1);
  return n_ranks == 1 ? 1 : std::max(0.05, first / other);
}

double bytes_beside_solver(std::size_t n_dofs, std::size_t n_loads) {
  return cost::program_bytes +
         double(n_dofs) * (cost::grid_bytes_per_dof + cost::load_bytes_per_dof * double(n_loads));
}

SolverReport choose_solver(const Grid& grid, std::size_t n_loads, const SolverChoice& choice,
                           double memory_bytes) {
  const std::size_t n_dofs = grid.n_unknowns();
  SolverReport report;
  report.predicted_direct = predict_direct(n_dofs, n_loads);
  report.largest_aspect = largest_aspect(grid);
  if (grid.degree < 2) {
    report.reason = "cells of degree 1 have no coarser polynomials";
    return report;
  }
  report.predicted_iterative = predict_iterative(n_dofs, n_loads, report.largest_aspect);
  report.reason = choice.solver == Solver::automatic ? "the factor fits into memory" : "as asked for";
  if (choice.solver == Solver::iterative) {
    report.used = Solver::iterative;
    refuse("iteration", report.predicted_iterative.bytes, n_dofs, memory_bytes);
  }
  return report;
}

void turn_to_iteration(std::size_t n_dofs, double memory_bytes, SolverReport& report) {
  refuse("iteration", report.predicted_iterative.bytes, n_dofs, memory_bytes);
  report.used = Solver::iterative;
  report.reason = "the factor does not fit into memory";
}

void turn_to_factor(const std::string& failure, SolverReport& report) {
  report.used = Solver::direct;
  report.reason += ", but " + failure.substr(0, failure.find(';'));
}

void refuse_large_factor(double factor_bytes, std::size_t n_dofs, double memory_bytes) {
  refuse("factor", factor_bytes, n_dofs, memory_bytes);
}

}  // namespace fem

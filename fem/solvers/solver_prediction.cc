#include "fem/solvers/solver_prediction.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>

#include "fem/solvers/iterative_solve.h"
#include "fem/values/cost_constants.h"
#include "fem/values/errors.h"

namespace fem {

namespace {

// What is saved has to be worth an answer to 1e-10 instead of rounding.
constexpr double worth_seconds = 1;
// Cells more stretched than that cost more iterations than they save.
constexpr double most_stretched = 12;
// Up to this, and if few cells are, they do not where the factor is expensive: 82 iterations at 1 : 17, 7 %
// of the cells beyond 1 : 12. A disc of cells that are all 1 : 16 does not end in a hundred.
constexpr double stretched_at_all = 25;
constexpr double most_stretched_cells = 0.1;
constexpr double stretched_safety = 2;
// Beyond it the smoother loses its grip on motions that keep volume.
constexpr double most_incompressible = 0.45;

std::string gigabytes(double bytes) {
  std::ostringstream text;
  text << std::setprecision(bytes < 1e10 ? 2 : 3) << 1e-9 * bytes << " GB";
  return text.str();
}

std::string cost_text(const SolverReport& report) {
  std::ostringstream text;
  text << std::setprecision(2) << "direct " << report.predicted_direct.seconds << " s, "
       << gigabytes(report.predicted_direct.bytes) << "; iterative " << report.predicted_iterative.seconds
       << " s, " << gigabytes(report.predicted_iterative.bytes) << " predicted";
  return text.str();
}

constexpr const char* remedy =
    "mesh with larger cells, take a lower degree, or use a machine with more memory";

[[noreturn]] void refuse(std::size_t n_dofs, const std::string& needs, double memory_bytes) {
  throw DoesNotFit("a body of " + std::to_string(n_dofs) + " unknowns does not fit into memory: " + needs +
                   ", there are " + gigabytes(memory_bytes) + "; " + remedy);
}

}  // namespace

std::vector<double> aspects(const Grid& grid) {
  if (grid.shape().is_tetrahedron()) return {};
  const auto corner = corner_nodes(grid.shape());
  std::vector<double> result;
  for (std::size_t c = 0; c < grid.n_cells(); ++c) {
    double length[3] = {0, 0, 0};
    for (int axis = 0; axis < 3; ++axis)
      for (int k = 0; k < 8; ++k)
        if (((k >> axis) & 1) == 0) {
          const double* a = grid.position(grid.nodes_of(c)[corner[k]]);
          const double* b = grid.position(grid.nodes_of(c)[corner[k | (1 << axis)]]);
          length[axis] += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
        }
    result.push_back(*std::max_element(length, length + 3) / *std::min_element(length, length + 3));
  }
  return result;
}

double largest_aspect(const Grid& grid) {
  if (grid.shape().is_tetrahedron()) return 0;
  const auto all = aspects(grid);
  return all.empty() ? 1 : *std::max_element(all.begin(), all.end());
}

double share_stretched(const Grid& grid) {
  const auto all = aspects(grid);
  const auto n = std::count_if(all.begin(), all.end(), [](double a) { return !suits_multigrid(a); });
  return all.empty() ? 0 : double(n) / double(all.size());
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

SolverCost predict_iterative(std::size_t n_dofs, int degree, std::size_t n_loads, double aspect,
                             CoarseLevel level) {
  const double n = double(n_dofs), k = 4 * std::ceil(double(n_loads) / 4);
  const double lanes = std::min(double(loads_per_block(n_dofs)), k);
  const double trilinear = n / (degree * degree * degree);
  double iterations = cost::iterations_first + cost::iterations_per_aspect * aspect,
         setup = cost::iterative_setup_s_per_dof * n, each = cost::iteration_s_per_dof * n * k,
         bytes = n * (cost::iterative_bytes_per_dof + cost::iterative_bytes_per_lane * lanes);
  if (level == CoarseLevel::factorised) {
    const double factor_s =
        cost::coarse_factor_s * std::pow(trilinear / cost::direct_unit, cost::coarse_factor_exponent);
    setup += cost::coarse_factor_setups * factor_s;
    each += cost::coarse_factor_solves * factor_s;
    bytes += predict_direct(static_cast<std::size_t>(trilinear), 0).bytes;
  } else {
    iterations *= cost::aggregates_more_iterations;
    setup += cost::aggregates_setup_s_per_dof * trilinear;
    bytes += cost::aggregates_bytes_per_dof * trilinear;
  }
  return {setup + iterations * each, bytes};
}

bool suits_multigrid(double aspect) {
  return aspect <= most_stretched;
}

bool is_too_expensive(const FactorSize& factor, const SolverReport& report, std::size_t n_loads) {
  return report.by_analysis && stretched_safety * report.predicted_iterative.seconds + worth_seconds <
                                   predict_direct(factor, n_loads).seconds;
}

bool may_be_iterated(const Grid& grid, const CellMaterials& materials, const SolverChoice& choice,
                     const SolverReport& report, double memory_bytes) {
  return choice.solver == Solver::automatic && !report.gave_up &&
         (grid.hanging.n() == 0 || grid.degree == 2) && !grid.shape().is_tetrahedron() && grid.degree > 1 &&
         materials.largest_poisson_ratio() <= most_incompressible && share_stretched(grid) <= 0.5 &&
         report.predicted_iterative.bytes < memory_bytes;
}

bool saves_time(const SolverReport& report) {
  return report.predicted_iterative.seconds + worth_seconds < report.predicted_direct.seconds;
}

CoarseLevel cheaper_coarse_level(std::size_t n_dofs, int degree, std::size_t n_loads) {
  const auto seconds = [&](CoarseLevel level) {
    return predict_iterative(n_dofs, degree, n_loads, 3, level).seconds;
  };
  return seconds(CoarseLevel::aggregated) < seconds(CoarseLevel::factorised) ? CoarseLevel::aggregated
                                                                             : CoarseLevel::factorised;
}

double bytes_beside_solver(std::size_t n_dofs, std::size_t n_loads) {
  return cost::program_bytes +
         double(n_dofs) * (cost::grid_bytes_per_dof + cost::load_bytes_per_dof * double(n_loads));
}

SolverReport choose_solver(const Grid& grid, const CellMaterials& materials, std::size_t n_loads,
                           const SolverChoice& choice, double memory_bytes) {
  const std::size_t n_dofs = grid.n_unknowns();
  SolverReport report;
  report.predicted_direct = predict_direct(n_dofs, n_loads);
  report.largest_aspect = largest_aspect(grid);
  report.coarse_level = choice.coarse_level;
  const auto take = [&](Solver solver, const std::string& reason) {
    report.used = solver;
    report.reason = reason;
    return report;
  };
  if (grid.shape().is_tetrahedron()) return take(Solver::direct, "the body has tetrahedra");
  if (grid.degree < 2) return take(Solver::direct, "cells of degree 1 have no coarser polynomials");
  const bool is_refined = grid.hanging.n() > 0;
  if (is_refined && grid.degree > 2) return take(Solver::direct, "cubic cells are refined locally");
  if (is_refined)
    report.coarse_level = CoarseLevel::factorised;  // aggregates know no hanging nodes
  else if (report.coarse_level == CoarseLevel::automatic)
    report.coarse_level = cheaper_coarse_level(n_dofs, grid.degree, n_loads);
  report.predicted_iterative =
      predict_iterative(n_dofs, grid.degree, n_loads, report.largest_aspect, report.coarse_level);
  if (choice.gave_up_before) {
    report.gave_up = true;
    return take(Solver::direct, "the iteration has given up on this mesh and material before");
  }
  if (is_refined && choice.solver != Solver::iterative)
    return take(Solver::direct, "the mesh is refined locally");
  if (choice.solver != Solver::automatic) {
    take(choice.solver, "as asked for");
    if (report.predicted().bytes > memory_bytes)
      refuse(n_dofs, "the solver asked for is predicted to need " + gigabytes(report.predicted().bytes),
             memory_bytes);
    return report;
  }
  const double room = memory_bytes - bytes_beside_solver(n_dofs, n_loads);
  const bool direct_fits = report.predicted_direct.bytes < room;
  const bool iterative_fits = report.predicted_iterative.bytes < room;
  const bool compact = suits_multigrid(report.largest_aspect);
  // Thin bodies have small factors: what they need the analysis of their matrix will tell.
  if (!direct_fits && !iterative_fits && compact)
    refuse(n_dofs,
           "beside " + gigabytes(memory_bytes - room) + " for the rest of the run " + cost_text(report),
           memory_bytes);
  if (!compact) {
    std::ostringstream text;
    text << "cells are stretched up to 1 : " << std::setprecision(3) << report.largest_aspect;
    report.by_analysis = report.largest_aspect <= stretched_at_all &&
                         share_stretched(grid) <= most_stretched_cells && iterative_fits &&
                         materials.largest_poisson_ratio() <= most_incompressible;
    return take(Solver::direct, text.str());
  }
  if (materials.largest_poisson_ratio() > most_incompressible) {
    std::ostringstream text;
    text << "Poisson's ratio is " << materials.largest_poisson_ratio();
    return take(Solver::direct, text.str());
  }
  if (!direct_fits)
    return take(Solver::iterative, "the factor would not fit into memory: " + cost_text(report));
  if (!iterative_fits)
    return take(Solver::direct, "the vectors would not fit into memory: " + cost_text(report));
  return saves_time(report) ? take(Solver::iterative, "faster: " + cost_text(report))
                            : take(Solver::direct, "as fast: " + cost_text(report));
}

void refuse_large_factor(double factor_bytes, std::size_t n_dofs, double memory_bytes) {
  if (factor_bytes > memory_bytes)
    throw DoesNotFit("a body of " + std::to_string(n_dofs) +
                     " unknowns does not fit into memory: its factor needs " + gigabytes(factor_bytes) +
                     ", " + gigabytes(memory_bytes) + " are left; " + remedy);
}

void turn_to_factor(const std::string& failure, SolverReport& report) {
  report.used = Solver::direct;
  report.gave_up = true;
  report.reason = failure + "; solved directly";
}

}  // namespace fem

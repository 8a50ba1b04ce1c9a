#include "tests/benchmarks/solvers/cost_fit.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <utility>

#include "fem/solvers/iterative_solve.h"
#include "fem/solvers/solver_prediction.h"
#include "fem/values/cost_constants.h"

namespace measure {

namespace {

namespace cost = fem::cost;

/// The table's seconds are half the CPU seconds of two threads.
double seconds(const SolverFigures& figures) {
  return figures.cpu_s / 2;
}

/// A small factor stays on one thread: its seconds are those of that thread.
double direct_seconds(const SolverRow& row) {
  const bool is_alone = row.factor.n_dofs > 0 && row.factor.flops < fem::flops_worth_threads;
  return is_alone ? row.direct->cpu_s : seconds(*row.direct);
}

double own_bytes(const SolverFigures& figures) {
  return figures.bytes - figures.bytes_before;
}

/// value = first_constant * first + second_constant * second
struct Term {
  double value = 0, first = 0, second = 0;
};

/// The first constant alone, the second's share taken out of the values: least squares of the relative rest.
double fit_one(const std::vector<Term>& terms) {
  double above = 0, below = 0;
  for (const auto& t : terms) {
    above += t.first / t.value;
    below += t.first * t.first / (t.value * t.value);
  }
  return above / below;
}

/// Both constants; nothing where the rows are too alike to part them.
std::optional<std::pair<double, double>> fit_two(const std::vector<Term>& terms) {
  double aa = 0, ab = 0, bb = 0, a = 0, b = 0;
  for (const auto& t : terms) {
    const double first = t.first / t.value, second = t.second / t.value;
    aa += first * first;
    ab += first * second;
    bb += second * second;
    a += first;
    b += second;
  }
  const double determinant = aa * bb - ab * ab;
  if (!(determinant > 1e-4 * aa * bb)) return std::nullopt;
  return std::pair((a * bb - b * ab) / determinant, (b * aa - a * ab) / determinant);
}

bool is_aggregated(const SolverRow& row) {
  return row.coarse_level == aggregates;
}

/// Seconds of the trilinear level's factor.
double coarse_s(const SolverRow& row) {
  const double trilinear = double(row.n_dofs) / 8;
  return cost::coarse_factor_s * std::pow(trilinear / cost::direct_unit, cost::coarse_factor_exponent);
}

class Fit {
public:
  Fit(const std::vector<SolverRow>& rows, std::size_t n_loads)
      : rows_(rows), n_loads_(double(n_loads)), lanes_(4 * std::ceil(n_loads_ / 4)) {}

  std::vector<FittedConstant> constants() {
    direct_by_unknowns();
    direct_by_factor("factor_s_per_flop_alone", cost::factor_s_per_flop_alone, false);
    direct_by_factor("factor_s_per_flop_shared", cost::factor_s_per_flop_shared, true);
    iterations();
    iterative();
    return std::move(constants_);
  }

private:
  void one(const char* name, double table, const std::vector<Term>& terms) {
    if (!terms.empty()) constants_.push_back({name, table, fit_one(terms), terms.size()});
  }

  /// Two constants, or the first alone if the rows cannot part them.
  void two(const char* first, double first_table, const char* second, double second_table,
           std::vector<Term> terms) {
    if (const auto both = fit_two(terms)) {
      constants_.push_back({first, first_table, both->first, terms.size()});
      constants_.push_back({second, second_table, both->second, terms.size()});
      return;
    }
    for (auto& t : terms) t.value -= second_table * t.second;
    one(first, first_table, terms);
  }

  void direct_by_unknowns() {
    std::vector<Term> time, memory;
    for (const auto& row : rows_) {
      if (!row.direct) continue;
      const double n = double(row.n_dofs) / cost::direct_unit, power = std::pow(n, cost::direct_exponent);
      time.push_back({direct_seconds(row) - cost::direct_s_per_load * power * n_loads_, n, n * n});
      memory.push_back({own_bytes(*row.direct), power, 0});
    }
    two("direct_s_linear", cost::direct_s_linear, "direct_s_square", cost::direct_s_square, std::move(time));
    one("direct_bytes", cost::direct_bytes, memory);
  }

  void direct_by_factor(const char* name, double table, bool shared) {
    std::vector<Term> time;
    for (const auto& row : rows_) {
      if (!row.direct || row.factor.n_dofs == 0) continue;
      if ((row.factor.flops >= fem::flops_worth_threads) != shared) continue;
      auto none = row.factor;
      none.flops = 0;
      time.push_back({direct_seconds(row) - fem::predict_direct(none, std::size_t(n_loads_)).seconds,
                      row.factor.flops, 0});
    }
    one(name, table, time);
  }

  void iterations() {
    std::vector<Term> steps;
    for (const auto& row : rows_)
      steps.push_back(
          {row.n_iterations / (is_aggregated(row) ? cost::aggregates_more_iterations : 1), 1, row.aspect});
    two("iterations_first", cost::iterations_first, "iterations_per_aspect", cost::iterations_per_aspect,
        std::move(steps));
  }

  void iterative() {
    std::vector<Term> time, memory;
    for (const auto& row : rows_) {
      const double n = double(row.n_dofs), steps = row.n_iterations;
      const double lanes = std::min(double(fem::loads_per_block(row.n_dofs)), lanes_);
      double rest_s = seconds(row.iterative) - cost::iterative_setup_s_per_dof * n,
             rest_bytes = own_bytes(row.iterative) - cost::iterative_bytes_per_lane * lanes * n;
      if (is_aggregated(row)) {
        rest_s -= cost::aggregates_setup_s_per_dof * n / 8;
        rest_bytes -= cost::aggregates_bytes_per_dof * n / 8;
      } else {
        rest_s -= (cost::coarse_factor_setups + cost::coarse_factor_solves * steps) * coarse_s(row);
        rest_bytes -= fem::predict_direct(row.n_dofs / 8, 0).bytes;
      }
      time.push_back({rest_s, steps * n * lanes_, 0});
      memory.push_back({rest_bytes, n, 0});
    }
    one("iteration_s_per_dof", cost::iteration_s_per_dof, time);
    one("iterative_bytes_per_dof", cost::iterative_bytes_per_dof, memory);
  }

  const std::vector<SolverRow>& rows_;
  double n_loads_, lanes_;
  std::vector<FittedConstant> constants_;
};

/// The prediction that is furthest from what was measured, as a ratio.
double worst_ratio(const std::vector<SolverRow>& rows,
                   const std::function<std::optional<double>(const SolverRow&)>& ratio_of) {
  double worst = 1;
  for (const auto& row : rows)
    if (const auto ratio = ratio_of(row); ratio && std::abs(std::log(*ratio)) > std::abs(std::log(worst)))
      worst = *ratio;
  return worst;
}

}  // namespace

std::vector<FittedConstant> fit_costs(const std::vector<SolverRow>& rows, std::size_t n_loads) {
  return Fit(rows, n_loads).constants();
}

void print_fit(const std::vector<SolverRow>& rows, std::size_t n_loads) {
  std::printf("\nconstants of fem/values/cost_constants.h, fitted on these rows\n%-28s %12s %12s %8s %5s\n",
              "", "table", "fitted", "ratio", "rows");
  for (const auto& c : fit_costs(rows, n_loads))
    std::printf("%-28s %12.3g %12.3g %8.2f %5zu\n", c.name.c_str(), c.table, c.fitted, c.fitted / c.table,
                c.n_rows);
  std::printf("measured over predicted seconds at worst, by the table: direct %.2f, iterative %.2f\n",
              worst_ratio(rows,
                          [](const SolverRow& row) {
                            return row.direct ? std::optional(direct_seconds(row) / row.direct->predicted_s)
                                              : std::nullopt;
                          }),
              worst_ratio(rows, [](const SolverRow& row) {
                return std::optional(seconds(row.iterative) / row.iterative.predicted_s);
              }));
}

}  // namespace measure

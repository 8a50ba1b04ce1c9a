#include "pipelines/study/optimum/cobyla.h"

#include <nlopt.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <optional>

namespace pipelines {
namespace {

struct DestroyOptimiser {
  void operator()(nlopt_opt optimiser) const { nlopt_destroy(optimiser); }
};
using Optimiser = std::unique_ptr<std::remove_pointer_t<nlopt_opt>, DestroyOptimiser>;

/// What the library's callbacks share: goal and bounds of a point are found together, and asked for apart.
struct CobylaCalls {
  const CobylaProblem& problem;
  nlopt_opt optimiser;
  std::vector<double> x{};
  CobylaTrial trial{};
  std::exception_ptr failure{};

  /// No exception passes through the library.
  const CobylaTrial& at(unsigned n, const double* point) {
    const std::vector<double> wanted(point, point + n);
    if (failure || wanted == x) return trial;
    try {
      trial = problem.evaluate(wanted);
      x = wanted;
    } catch (...) {
      failure = std::current_exception();
      nlopt_force_stop(optimiser);
    }
    return trial;
  }
};

double goal_of(unsigned n, const double* x, double* /*gradient*/, void* calls) {
  return static_cast<CobylaCalls*>(calls)->at(n, x).goal;
}

void shortfalls_of(unsigned m, double* result, unsigned n, const double* x, double* /*gradient*/,
                   void* calls) {
  const auto& shortfalls = static_cast<CobylaCalls*>(calls)->at(n, x).shortfalls;
  std::fill_n(result, m, 0);
  std::copy_n(shortfalls.begin(), std::min<std::size_t>(m, shortfalls.size()), result);
}

}  // namespace

void run_cobyla(const CobylaProblem& problem) {
  const auto n = unsigned(problem.start.size()), m = unsigned(problem.n_bounds);
  const Optimiser optimiser(nlopt_create(NLOPT_LN_COBYLA, n));
  CobylaCalls calls{problem, optimiser.get()};
  nlopt_set_lower_bounds1(optimiser.get(), 0);
  nlopt_set_upper_bounds1(optimiser.get(), 1);
  nlopt_set_initial_step1(optimiser.get(), problem.step);
  nlopt_set_xtol_abs1(optimiser.get(), problem.end_step);
  nlopt_set_min_objective(optimiser.get(), goal_of, &calls);
  if (m > 0) nlopt_add_inequality_mconstraint(optimiser.get(), m, shortfalls_of, &calls, nullptr);
  auto x = problem.start;
  double goal = 0;
  nlopt_optimize(optimiser.get(), x.data(), &goal);
  if (calls.failure) std::rethrow_exception(calls.failure);
}

}  // namespace pipelines

/// The optimiser of NLopt that needs no derivatives and keeps bounds: COBYLA.
///
/// Linear models of the goal and of all bounds over n + 1 points, in a region of trust that shrinks (Powell,
/// A direct search optimization method that models the objective and constraint functions by linear
/// interpolation, 1994).
#pragma once

#include <functional>
#include <vector>

namespace pipelines {

/// A point of the search.
struct CobylaTrial {
  double goal = 0;                 ///< to be least
  std::vector<double> shortfalls;  ///< each at most 0 where its bound is kept
};

struct CobylaProblem {
  std::vector<double> start;  ///< coordinates from 0 to 1
  double step = 0.25;         ///< of the first points
  double end_step = 1e-3;     ///< a region of trust that is smaller ends the search
  std::size_t n_bounds = 0;
  /// Called with coordinates from 0 to 1; what it throws ends the search.
  std::function<CobylaTrial(const std::vector<double>& x)> evaluate;
};

/// Returns once the region of trust is small, or at once where nothing can be done any more (rounding).
/// @throws what evaluate() throws
void run_cobyla(const CobylaProblem& problem);

}  // namespace pipelines

#include "pipelines/judge/analysis/stress_under_changed_loads.h"

#include <algorithm>
#include <queue>

namespace pipelines {
namespace {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;

Stress unit_of(const double* unit, std::size_t channel) {
  Stress s;
  std::copy_n(unit + 6 * channel, 6, s.begin());
  return s;
}

/// What a point may reach at most, and which one it is.
struct Candidate {
  double reach_Pa;
  std::size_t point;
  bool operator<(const Candidate& other) const {
    return reach_Pa < other.reach_Pa || (reach_Pa == other.reach_Pa && point > other.point);
  }
};

/// The largest value over the points, best first.
template <typename Value>
double best_first(std::vector<Candidate> candidates, const Value& value_Pa) {
  std::priority_queue<Candidate> queue(std::less<Candidate>(), std::move(candidates));
  double best_Pa = 0;
  // The reach holds up to rounding, which the slack covers.
  constexpr double slack = 1e-12;
  for (; !queue.empty() && queue.top().reach_Pa * (1 + slack) > best_Pa; queue.pop())
    best_Pa = std::max(best_Pa, value_Pa(queue.top().point));
  return best_Pa;
}

double largest_over_ranks(double value, const fem::UnitResponses& responses) {
  if (responses.shared)
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, responses.shared->communicator);
  return value;
}

/// @param value_Pa  of a point: (its unit stresses, its stress in the analysis) -> new stress
template <typename Value>
LargestStresses largest(const Judged& analysis, const ArrayXXd& change, const MoreStress& more,
                        const Value& value_Pa) {
  const auto& responses = analysis.responses;
  const ArrayXd sizes = change.abs().rowwise().maxCoeff();
  const auto reach = [&](const double* unit, double own_Pa) {
    double sum = own_Pa + more(unit);
    for (Index k = 0; k < sizes.size(); ++k)
      if (sizes[k] > 0) sum += sizes[k] * von_mises_Pa(unit_of(unit, std::size_t(k)));
    return sum;
  };
  const auto& own = analysis.envelope.von_mises.value_Pa;
  std::vector<Candidate> nodes, toes;
  for (std::size_t i = 0; i < own.size(); ++i)
    if (!analysis.places.excluded[i] && responses.has(i))
      nodes.push_back({reach(responses.unit_stress_Pa(i), own[i]), i});
  std::vector<std::vector<std::array<double, 6>>> at_toes;
  for (const auto& spot : analysis.hot_spots) {
    at_toes.push_back(unit_stress_at(responses, stress_point(spot)));
    toes.push_back({reach(at_toes.back().front().data(), spot.von_mises_Pa), toes.size()});
  }
  const double of_own_nodes = best_first(
      std::move(nodes), [&](std::size_t i) { return value_Pa(responses.unit_stress_Pa(i), own[i]); });
  return {largest_over_ranks(of_own_nodes, responses), best_first(std::move(toes), [&](std::size_t i) {
            return value_Pa(at_toes[i].front().data(), analysis.hot_spots[i].von_mises_Pa);
          })};
}

}  // namespace

double largest_von_mises_Pa(const double* unit, const ArrayXXd& factors) {
  const Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>> shapes(unit, 6, factors.rows());
  const Eigen::Matrix<double, 6, Eigen::Dynamic> stress = shapes * factors.matrix();
  double most_Pa = 0;
  for (Index i = 0; i < stress.cols(); ++i) {
    Stress s;
    for (std::size_t c = 0; c < 6; ++c) s[c] = stress(Index(c), i);
    most_Pa = std::max(most_Pa, von_mises_Pa(s));
  }
  return most_Pa;
}

LargestStresses largest_stresses(const Judged& analysis) {
  return {analysis.peak.value_Pa, analysis.hot_spots.empty() ? 0 : analysis.hot_spots.front().von_mises_Pa};
}

LargestStresses largest_under(const Judged& analysis, const ArrayXXd& change) {
  const ArrayXXd factors = analysis.loads.history.values + change;
  return largest(
      analysis, change, [](const double*) { return 0.0; },
      [&](const double* unit, double) { return largest_von_mises_Pa(unit, factors); });
}

LargestStresses bound_under(const Judged& analysis, const ArrayXXd& change, const MoreStress& more) {
  return largest(analysis, change, more, [&](const double* unit, double own_Pa) {
    return own_Pa + largest_von_mises_Pa(unit, change) + more(unit);
  });
}

}  // namespace pipelines

#include "pipelines/superpose/envelope/nodal_cycles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "pipelines/base/common/parallel.h"
#include "pipelines/superpose/kernels/linear_extremes_kernel.h"
#include "pipelines/superpose/kernels/walked_factors.h"

namespace pipelines {
namespace {

using Eigen::Index;
using UnitRows = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

Eigen::Map<const UnitRows> unit_stresses(const fem::UnitResponses& responses, std::size_t node) {
  return {responses.unit_stress_Pa(node), Index(responses.channels.size()), 6};
}

/// A number whose inverse does not overflow; that of a smaller one may.
constexpr double smallest_with_inverse = 4 * std::numeric_limits<double>::min();

/// What a tensor is multiplied with, component by component, for its product with the deviator of another;
/// of size one, so that products of small stresses stay numbers.
Eigen::Matrix<double, 6, 1> direction_of(const Stress& s) {
  const double mean = (s[0] + s[1] + s[2]) / 3, dx = s[0] - mean, dy = s[1] - mean, dz = s[2] - mean;
  const double normal = std::max({std::abs(dx), std::abs(dy), std::abs(dz)});
  const double shear = std::max({std::abs(s[3]), std::abs(s[4]), std::abs(s[5])});
  const double size = std::max(normal, 2 * shear), scale = size > smallest_with_inverse ? 1 / size : 1;
  Eigen::Matrix<double, 6, 1> direction;
  direction << scale * dx, scale * dy, scale * dz, 2 * scale * s[3], 2 * scale * s[4], 2 * scale * s[5];
  return direction;
}

/// Nodes that a thread takes at once.
constexpr std::size_t nodes_at_once = 64 * kernel::forms_at_once;

/// Walks some nodes at once, a linear form each.
class CycleWalk {
public:
  CycleWalk(const ChannelHistory& loads, const fem::UnitResponses& responses, const WalkedFactors& factors)
      : loads_(loads),
        responses_(responses),
        factors_(factors),
        weights_(factors.n_channels() * kernel::forms_at_once),
        room_(kernel::room_of_linear_walk(factors.for_kernel())) {}

  /// @param n  at most kernel::forms_at_once
  void walk(const std::size_t* nodes, std::size_t n, const NodalMaximum& von_mises, NodalCycle* cycles) {
    for (std::size_t i = 0; i < n; ++i) directions_[i] = direction_of(von_mises.stress_Pa[nodes[i]]);
    find_extremes(nodes, n, kernel::Wanted::smallest);
    for (std::size_t i = 0; i < n; ++i)  // no stress is longer, so that none reaches farther along this one
      found_[i].largest_instant = von_mises.instant[nodes[i]];
    for (std::size_t i = 0; i < n; ++i) directions_[i] = direction_of(change_at(nodes[i], found_[i]));
    find_extremes(nodes, n, kernel::Wanted::both);
    for (std::size_t i = 0; i < n; ++i) {
      const Index from = found_[i].smallest_instant, to = found_[i].largest_instant;
      const auto cycle = cycle_between(own_stress_at(responses_, loads_, nodes[i], from),
                                       own_stress_at(responses_, loads_, nodes[i], to), from, to);
      cycles[i] = {std::int32_t(cycle.from), std::int32_t(cycle.to), cycle.amplitude_Pa,
                   cycle.signed_mean_Pa};
    }
  }

private:
  /// Finds the extremes of the forms that are the nodes' stresses along their directions.
  void find_extremes(const std::size_t* nodes, std::size_t n, kernel::Wanted wanted) {
    for (std::size_t i = 0; i < n; ++i) {
      const auto unit = unit_stresses(responses_, nodes[i]);
      factors_.gather_numbers([&](Index k) { return unit.row(k).dot(directions_[i]); }, &weights_[i],
                              kernel::forms_at_once);
    }
    kernel::linear_walk_for_this_machine()(weights_.data(), factors_.for_kernel(), wanted, room_.data(),
                                           found_.data());
  }

  /// Change of the stress from the smallest value to the largest one.
  Stress change_at(std::size_t node, const kernel::LinearExtremes& extremes) const {
    const auto unit = unit_stresses(responses_, node);
    Eigen::Matrix<double, 6, 1> change = Eigen::Matrix<double, 6, 1>::Zero();
    for (Index k = 0; k < unit.rows(); ++k)
      change += (loads_.values(k, extremes.largest_instant) - loads_.values(k, extremes.smallest_instant)) *
                unit.row(k).transpose();
    Stress stress;
    std::copy_n(change.data(), 6, stress.begin());
    return stress;
  }

  const ChannelHistory& loads_;
  const fem::UnitResponses& responses_;
  const WalkedFactors& factors_;
  std::vector<double> weights_, room_;
  std::array<Eigen::Matrix<double, 6, 1>, kernel::forms_at_once> directions_;
  std::array<kernel::LinearExtremes, kernel::forms_at_once> found_{};
};

}  // namespace

std::vector<std::size_t> surface_nodes(const fem::Nodes& nodes) {
  std::vector<std::size_t> result(nodes.faces.begin(), nodes.faces.end());
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

NodalCycles nodal_cycles(const ChannelHistory& loads, const fem::UnitResponses& responses,
                         const NodalMaximum& von_mises, std::vector<std::size_t> nodes, int n_threads) {
  check_channels(loads, responses);
  const WalkedFactors factors(loads.values);
  std::vector<std::size_t> own;  // nodes that this rank has, and their places in the list
  std::vector<std::size_t> place;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (responses.has(nodes[i])) {
      own.push_back(nodes[i]);
      place.push_back(i);
    }
  std::vector<NodalCycle> cycles(own.size());
  for_each_range(own.size(), nodes_at_once, n_threads, [&](std::size_t begin, std::size_t end) {
    CycleWalk walk(loads, responses, factors);
    for (std::size_t first = begin; first < end; first += kernel::forms_at_once)
      walk.walk(&own[first], std::min(kernel::forms_at_once, end - first), von_mises, &cycles[first]);
  });
  NodalCycles result{std::move(nodes), {}};
  if (!responses.shared) {
    result.cycles = std::move(cycles);
    return result;
  }
  std::vector<double> numbers(4 * result.nodes.size(), 0.0);
  for (std::size_t i = 0; i < own.size(); ++i) {
    const auto& cycle = cycles[i];
    double* to = &numbers[4 * place[i]];
    to[0] = cycle.from, to[1] = cycle.to, to[2] = cycle.amplitude_Pa, to[3] = cycle.signed_mean_Pa;
  }
  responses.complete(numbers);
  for (std::size_t i = 0; i < result.nodes.size(); ++i) {
    const double* from = &numbers[4 * i];
    result.cycles.push_back({std::int32_t(from[0]), std::int32_t(from[1]), from[2], from[3]});
  }
  return result;
}

Eigen::ArrayXXd stress_history_Pa(const fem::UnitResponses& responses, const ChannelHistory& loads,
                                  std::size_t node) {
  const Eigen::Map<const UnitRows> unit(responses.stress_anywhere_Pa(node), Index(responses.channels.size()),
                                        6);
  return (unit.transpose() * loads.values.matrix()).array();
}

}  // namespace pipelines

#include "pipelines/superposition/nodal_cycles.h"

#include <algorithm>
#include <array>
#include <thread>

#include "pipelines/superposition/linear_extremes_kernel.h"

namespace pipelines {
namespace {

using Eigen::Index;
using UnitRows = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

constexpr std::size_t nodes_at_once = 64;
static_assert(nodes_at_once % kernel::forms_at_once == 0);

Eigen::Map<const UnitRows> unit_stresses(const fem::UnitResponses& responses, std::size_t node) {
  const std::size_t n_channels = responses.channels.size();
  return {responses.stress_Pa.data() + node * n_channels * 6, Index(n_channels), 6};
}

/// What a tensor is multiplied with, component by component, for its product with the deviator of another;
/// of size one, so that products of small stresses stay numbers.
Eigen::Matrix<double, 6, 1> direction_of(const Stress& stress) {
  const double mean = (stress[0] + stress[1] + stress[2]) / 3;
  Eigen::Matrix<double, 6, 1> direction;
  for (Index c = 0; c < 6; ++c)
    direction[c] = c < 3 ? stress[std::size_t(c)] - mean : 2 * stress[std::size_t(c)];
  const double size = direction.lpNorm<Eigen::Infinity>();
  return size > 0 ? Eigen::Matrix<double, 6, 1>(direction / size) : direction;
}

/// Walks some nodes at once.
class CycleWalk {
public:
  CycleWalk(const ChannelHistory& loads, const fem::UnitResponses& responses)
      : loads_(loads), responses_(responses), independent_(independent_channels(loads.values)) {
    factors_ = blocked_factors(loads.values, independent_.channels);
    if (!independent_.channels.empty())
      n_blocks_ = factors_.size() / (independent_.channels.size() * factors_block);
  }

  void walk(const std::size_t* nodes, std::size_t n, const NodalMaximum& von_mises,
            StressCycle* cycles) const {
    std::array<Stress, nodes_at_once> along;
    for (std::size_t i = 0; i < n; ++i) along[i] = von_mises.stress_Pa[nodes[i]];
    for (int round = 0; round < 2; ++round) {
      const auto found = extremes_along(nodes, n, along);
      for (std::size_t i = 0; i < n; ++i) {
        const Index from = found[i].smallest_instant, to = found[i].largest_instant;
        cycles[i] = cycle_between(stress_at(responses_, loads_, nodes[i], from),
                                  stress_at(responses_, loads_, nodes[i], to), from, to);
        along[i] = cycles[i].half_range_Pa;
      }
    }
  }

private:
  std::array<kernel::LinearExtremes, nodes_at_once> extremes_along(
      const std::size_t* nodes, std::size_t n, const std::array<Stress, nodes_at_once>& along) const {
    const auto n_walked = Index(independent_.channels.size());
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> weights =
        decltype(weights)::Zero(Index(nodes_at_once), n_walked);
    for (std::size_t i = 0; i < n; ++i)
      weights.row(Index(i)).noalias() =
          (unit_stresses(responses_, nodes[i]) * direction_of(along[i])).transpose() *
          independent_.of_channel;
    std::array<kernel::LinearExtremes, nodes_at_once> found{};
    if (n_walked > 0)
      kernel::linear_walk_for_this_machine()(weights.data(), nodes_at_once, std::size_t(n_walked),
                                             factors_.data(), n_blocks_, found.data());
    return found;
  }

  const ChannelHistory& loads_;
  const fem::UnitResponses& responses_;
  IndependentChannels independent_;
  std::vector<double> factors_;
  std::size_t n_blocks_ = 0;
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
  const CycleWalk walk(loads, responses);
  NodalCycles result{std::move(nodes), {}};
  const std::size_t n_nodes = result.nodes.size();
  result.cycles.resize(n_nodes);
  const auto work = [&](std::size_t begin, std::size_t end) {
    for (std::size_t first = begin; first < end; first += nodes_at_once)
      walk.walk(&result.nodes[first], std::min(nodes_at_once, end - first), von_mises, &result.cycles[first]);
  };
  // Nodes are independent, so the split between threads cannot change a bit of the result.
  const std::size_t n_workers = std::size_t(std::max(1, n_threads));
  std::vector<std::thread> threads;
  for (std::size_t w = 1; w < n_workers; ++w)
    threads.emplace_back(work, n_nodes * w / n_workers, n_nodes * (w + 1) / n_workers);
  work(0, n_nodes / n_workers);
  for (auto& thread : threads) thread.join();
  return result;
}

Eigen::ArrayXXd stress_history_Pa(const fem::UnitResponses& responses, const ChannelHistory& loads,
                                  std::size_t node) {
  return (unit_stresses(responses, node).transpose() * loads.values.matrix()).array();
}

}  // namespace pipelines

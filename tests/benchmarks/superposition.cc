// Superposition over the cycle: what a node takes at an instant, and that a stress which does not change, as
// in a shaft that turns with its load, takes no more.
#include "pipelines/superposition/superposition.h"

#include <cmath>

#include "tests/benchmarks/measure.h"

namespace {

struct Problem {
  pipelines::ChannelHistory loads;
  fem::UnitResponses responses;
};

constexpr std::size_t n_nodes = 4096;
constexpr Eigen::Index n_instants = 2400;

Problem problem(std::size_t n_channels, bool steady) {
  Problem p;
  for (std::size_t k = 0; k < n_channels; ++k) {
    p.loads.channels.push_back({"port.c" + std::to_string(k), "N"});
    p.responses.channels.push_back(p.loads.channels.back().name);
  }
  p.responses.nodes.n = n_nodes;
  for (std::size_t i = 0; i < n_nodes * n_channels * 6; ++i)
    p.responses.stress_Pa.push_back(std::cos(1.7 * double(i)));
  p.loads.effects = {"all"};
  p.loads.values.resize(Eigen::Index(n_channels), n_instants);
  for (Eigen::Index k = 0; k < p.loads.values.rows(); ++k)
    for (Eigen::Index i = 0; i < n_instants; ++i)
      p.loads.values(k, i) =
          steady ? 1 + double(k) : std::cos(0.05 * double(i) * double(1 + k) + double(k));
  p.loads.by_effect = {p.loads.values};
  return p;
}

/// @param state  channels; whether the stress is steady
void superposition(benchmark::State& state) {
  const auto superpose = [](const Problem& p) { return [&p] { return envelope(p.loads, p.responses, 1); }; };
  const auto n_channels = std::size_t(state.range(0));
  const auto p = problem(n_channels, state.range(1) != 0), changing = problem(n_channels, false);
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(superpose(p)());
  state.counters["ns_per_instant"] =
      1e9 * measure::smallest_s(superpose(p)) / double(n_nodes) / double(n_instants);
  state.counters["of_changing"] =
      measure::smallest_s(superpose(p)) / measure::smallest_s(superpose(changing));
}

}  // namespace

BENCHMARK(superposition)->ArgNames({"channels", "steady"})->ArgsProduct({{10, 31}, {0, 1}});

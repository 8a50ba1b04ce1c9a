// Superposition over the cycle: what a node takes at an instant, and that a stress which does not change, as
// in a shaft that turns with its load, takes no more; what fatigue's cycles add to it.
#include "pipelines/superposition/superposition.h"

#include <cmath>
#include <numeric>

#include "pipelines/superposition/nodal_cycles.h"
#include "tests/benchmarks/measure.h"

namespace {

struct Problem {
  pipelines::ChannelHistory loads;
  fem::UnitResponses responses;
};

constexpr std::size_t n_nodes = 4096;

Problem problem(std::size_t n_channels, bool steady, Eigen::Index n_instants = 2400) {
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
      p.loads.values(k, i) = steady ? 1 + double(k) : std::cos(0.05 * double(i) * double(1 + k) + double(k));
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
      1e9 * measure::smallest_s(superpose(p)) / double(n_nodes) / double(p.loads.values.cols());
  state.counters["of_changing"] =
      measure::smallest_s(superpose(p)) / measure::smallest_s(superpose(changing));
}

/// Fatigue's walks through the instants beside the envelope's.
/// @param state  channels
void largest_cycles(benchmark::State& state) {
  const auto p = problem(std::size_t(state.range(0)), false, 720);
  std::vector<std::size_t> nodes(n_nodes);
  std::iota(nodes.begin(), nodes.end(), std::size_t(0));
  const auto found = envelope(p.loads, p.responses, 1);
  const auto cycles = [&] { return nodal_cycles(p.loads, p.responses, found.von_mises, nodes, 1); };
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(cycles());
  const double alone_s = measure::smallest_s([&] { return envelope(p.loads, p.responses, 1); });
  state.counters["with_envelope_of_envelope"] = 1 + measure::smallest_s(cycles) / alone_s;
}

}  // namespace

BENCHMARK(largest_cycles)->ArgName("channels")->Arg(12)->Arg(31);
BENCHMARK(superposition)->ArgNames({"channels", "steady"})->ArgsProduct({{10, 31}, {0, 1}});

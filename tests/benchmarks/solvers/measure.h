/// Figures that the benchmarks of loads report beside the time per call.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include "kinetics/values/load_history.h"

namespace measure {

/// The smallest time of some calls [s]: what other work on the machine disturbs least.
template <class Call>
double smallest_s(const Call& call, int n_calls = 15) {
  double smallest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < n_calls; ++i) {
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(call());
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    smallest = std::min(smallest, taken.count());
  }
  return smallest;
}

/// Runs a call that gives a load history; counters: instants, values stored per instant, time per instant.
template <class Call>
void loads(benchmark::State& state, const Call& call) {
  const kinetics::LoadHistory history = call();
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(call());
  std::size_t stored = 4 + history.quantities.size();
  for (const kinetics::Resultant& resultant : history.resultants)
    stored += 3 * (1 + resultant.contributions.size());
  const double instants = double(history.n_instants());
  state.counters["instants"] = instants;
  state.counters["values_per_instant"] = double(stored);
  using benchmark::Counter;
  state.counters["per_instant"] = Counter(instants, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

}  // namespace measure

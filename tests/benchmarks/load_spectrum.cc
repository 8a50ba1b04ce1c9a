// Rainflow counting of a long random series.
#include "kinetics/series/load_spectrum.h"

#include <benchmark/benchmark.h>

#include <random>

namespace {

void rainflow(benchmark::State& state) {
  std::mt19937 generator(3);
  std::normal_distribution<> load;
  const Eigen::ArrayXd series =
      Eigen::ArrayXd::NullaryExpr(Eigen::Index(state.range(0)), [&] { return load(generator); });
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(kinetics::rainflow(series));
  using benchmark::Counter;
  state.counters["per_point"] =
      Counter(double(series.size()), Counter::kIsIterationInvariantRate | Counter::kInvert);
}

}  // namespace

BENCHMARK(rainflow)->ArgName("points")->Arg(1000000)->Unit(benchmark::kMillisecond);

// Natural frequencies of long drive trains.
#include <benchmark/benchmark.h>

#include <cmath>

#include "tests/unit/kinetics/torsion/trains.h"

namespace {

std::vector<double> spread(int n, double middle, std::mt19937& generator) {
  std::uniform_real_distribution<> decades(-1, 1);
  std::vector<double> values(static_cast<std::size_t>(n));
  for (double& value : values) value = middle * std::pow(10, decades(generator));
  return values;
}

/// Inertias and stiffnesses over two decades.
kinetics::DriveTrain chain(int n) {
  std::mt19937 generator(1);
  const auto inertia_kg_m2 = spread(n, 0.1, generator);
  return trains::chain(inertia_kg_m2, spread(n - 1, 1e4, generator));
}

/// The same, each inertia behind one of those before it, drawn at random.
kinetics::DriveTrain tree(int n) {
  std::mt19937 generator(2);
  auto train = chain(n);
  for (std::size_t e = 0; e < train.elements.size(); ++e)
    train.elements[e].first =
        train.inertias[std::uniform_int_distribution<std::size_t>(0, e)(generator)].name;
  return train;
}

void spectrum(benchmark::State& state, kinetics::DriveTrain (*make)(int)) {
  const auto train = make(int(state.range(0)));
  for ([[maybe_unused]] auto _ : state)
    benchmark::DoNotOptimize(natural_modes(train, kinetics::Shapes::none));
}

}  // namespace

BENCHMARK_CAPTURE(spectrum, chain, chain)->ArgName("inertias")->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(spectrum, tree, tree)->ArgName("inertias")->Arg(200)->Unit(benchmark::kMillisecond);

// The planetary mill's load stage, all effects, one turn of the carrier.
#include "tests/benchmarks/solvers/measure.h"
#include "tests/unit/kinetics/planetary/planetary_machines.h"

namespace {

void planetary_mill(benchmark::State& state) {
  const auto mill = machines::printed_planetary();
  const auto names = machines::effects_without(mill, {});
  const kinetics::TimeGrid turn{1, int(state.range(0))};
  measure::loads(state, [&] { return compute_loads(mill, names, turn); });
}

}  // namespace

BENCHMARK(planetary_mill)->ArgName("per_turn")->Arg(2400);

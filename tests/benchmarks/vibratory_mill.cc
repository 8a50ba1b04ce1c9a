// The vibratory mill's load stage: what an instant costs, and that effects which are off cost nothing.
#include "tests/benchmarks/solvers/measure.h"
#include "tests/unit/kinetics/vibratory/machines.h"

namespace {

kinetics::VibratoryMill mill() {
  auto m = machines::laboratory();
  m.charge_lag.loss_angle_rad = 0.2;
  return m;
}

/// The first effects in the order of summation; zero: all.
std::vector<std::string> effects(int n) {
  auto names = machines::effects_without(mill(), {});
  if (n > 0) names.resize(std::size_t(n));
  return names;
}

/// @param state  how many effects (zero: all), instants per turn; 20 turns are the laboratory mill's period
void vibratory_mill(benchmark::State& state) {
  const kinetics::TimeGrid period{20, int(state.range(1))};
  const auto run = [&](int n_effects) {
    return [m = mill(), names = effects(n_effects), period] { return compute_loads(m, names, period); };
  };
  const int n_effects = int(state.range(0));
  measure::loads(state, run(n_effects));
  state.counters["of_all"] = measure::smallest_s(run(n_effects)) / measure::smallest_s(run(0));
}

}  // namespace

BENCHMARK(vibratory_mill)->ArgNames({"effects", "per_turn"})->ArgsProduct({{1, 2, 4, 8, 0}, {120}});
BENCHMARK(vibratory_mill)->ArgNames({"effects", "per_turn"})->ArgsProduct({{0}, {12, 1200}});

// Superposition over the cycle: what a node takes at an instant, beside the multiply-adds that one core does
// at most; that a stress which does not change, as in a shaft that turns with its load, takes no more; what
// fatigue's cycles add to it; the memory that both take.
#include "pipelines/superpose/envelope/superposition.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fem/base/common/memory.h"
#include "pipelines/superpose/envelope/nodal_cycles.h"
#include "pipelines/superpose/kernels/batch_walk.h"
#include "pipelines/superpose/kernels/superposition_kernel.h"
#include "tests/benchmarks/multiply_add_limit.h"
#include "tests/benchmarks/solvers/process.h"

namespace {

struct Problem {
  pipelines::ChannelHistory loads;
  fem::UnitResponses responses;
};

/// Time factors of the channels: orders of the drive, two channels each, over one turn; up to ten instants
/// for a period, more than a run's sampling allows; one value.
enum class Course { orders, rough, steady };

double factor(Course course, Eigen::Index channel, double instant, double n_instants) {
  const double phase = double(channel);
  if (course == Course::steady) return 1 + phase;
  if (course == Course::rough) return std::cos(0.05 * instant * (1 + phase) + phase);
  return std::cos(2 * M_PI * instant / n_instants * double(1 + channel / 2) + phase);
}

void share_among(int n_effects, pipelines::ChannelHistory& loads) {
  loads.effects.clear();
  for (int e = 0; e < n_effects; ++e) loads.effects.push_back("effect " + std::to_string(e));
  loads.by_effect.assign(std::size_t(n_effects), loads.values / n_effects);
}

Problem problem(std::size_t n_nodes, std::size_t n_channels, Eigen::Index n_instants, Course course) {
  Problem p;
  for (std::size_t k = 0; k < n_channels; ++k) {
    p.loads.channels.push_back({"port.c" + std::to_string(k), "N"});
    p.responses.channels.push_back(p.loads.channels.back().name);
  }
  p.responses.nodes.n = n_nodes;
  p.responses.stress_Pa.resize(n_nodes * n_channels * 6);
  for (std::size_t i = 0; i < p.responses.stress_Pa.size(); ++i)
    p.responses.stress_Pa[i] = std::cos(1.7 * double(i));
  p.loads.values.resize(Eigen::Index(n_channels), n_instants);
  for (Eigen::Index k = 0; k < p.loads.values.rows(); ++k)
    for (Eigen::Index i = 0; i < n_instants; ++i)
      p.loads.values(k, i) = factor(course, k, double(i), double(n_instants));
  share_among(1, p.loads);
  return p;
}

/// Of one thread, so that other work on the machine disturbs little.
template <class Call>
double smallest_s(const Call& call, int n_calls) {
  return measure::smallest_cpu_s([&] { benchmark::DoNotOptimize(call()); }, n_calls);
}

/// Floating-point operations per second that one core does at most, by the instructions of the walk.
double most_flops() {
  namespace kernel = pipelines::kernel;
  namespace limit = benchmarks::limit;
  auto* multiply_adds = &limit::generic::multiply_adds;
#if defined(__x86_64__)
  if (&kernel::walk_for_this_machine() == &kernel::avx2::walk) multiply_adds = &limit::avx2::multiply_adds;
  if (&kernel::walk_for_this_machine() == &kernel::avx512::walk)
    multiply_adds = &limit::avx512::multiply_adds;
#endif
  double sum = 0, n_flops = 0;
  const double taken_s = smallest_s([&] { return n_flops = multiply_adds(1000000, sum); }, 15);
  return n_flops / taken_s;
}

/// Multiply-adds of five coordinates of stress for each channel, node and instant, whether the walk leaves
/// instants out or not.
double flops_of_all_instants(const Problem& p) {
  return 2.0 * 5 * double(p.loads.values.size()) * double(p.responses.nodes.n);
}

/// Floating-point operations that the walk does of those that superpose: the coordinates' multiply-adds and
/// the squared von Mises stress, of instants that it does not leave out. No bounds, cubics, comparisons, nor
/// what is kept of a node.
/// @param instants  superposed, to be written: of each node, those that were superposed twice counted twice
double flops_done(const Problem& p, double& instants) {
  const pipelines::WalkedFactors factors(p.loads.values);
  pipelines::BatchWalk walk(factors, p.responses);
  const std::size_t n_nodes = p.responses.nodes.n, batch = pipelines::kernel::batch;
  double n_with_five = 0, n_with_six = 0;
  for (std::size_t first = 0; first < n_nodes; first += batch) {
    const std::size_t n = std::min(batch, n_nodes - first);
    const auto& found = walk.of(first, n);
    for (std::size_t i = 0; i < n; ++i) {
      n_with_five += double(found[i].n_with_five);
      n_with_six += double(found[i].n_with_six);
    }
  }
  instants = (n_with_five + n_with_six) / double(n_nodes);
  const double n_channels = double(factors.n_channels()), square = 9;  // five products, four sums
  return n_with_five * (2 * 5 * n_channels + square) + n_with_six * (2 * 6 * n_channels + square);
}

/// The limit of multiply-adds in registers, measured in the same run, and how much of it is reached.
void report_flops(benchmark::State& state, const Problem& p, double taken_s) {
  const double limit = most_flops();
  double instants = 0;
  state.counters["of_limit_done"] = flops_done(p, instants) / taken_s / limit;
  state.counters["of_limit_all_instants"] = flops_of_all_instants(p) / taken_s / limit;
  state.counters["instants_done"] = instants / double(p.loads.values.cols());
}

/// @param state  channels, instants, course
void superposition(benchmark::State& state) {
  const std::size_t n_nodes = 4096;
  const auto p = problem(n_nodes, std::size_t(state.range(0)), state.range(1), Course(state.range(2)));
  const auto superpose = [&p] { return envelope(p.loads, p.responses, 1); };
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(superpose());
  const double taken_s = smallest_s(superpose, 50);
  state.counters["ns_per_instant"] = 1e9 * taken_s / double(n_nodes) / double(p.loads.values.cols());
  if (Course(state.range(2)) != Course::steady) report_flops(state, p, taken_s);
}

/// The results that a call leaves, and by what its largest memory exceeds that before it. Memory that is free
/// in the process goes back to the system before, else it would hide what is taken.
template <class Call>
void report_memory(benchmark::State& state, const Call& call) {
  fem::release_free_memory();
  measure::reset_peak();
  const double before = measure::memory_bytes("VmRSS:");
  const std::size_t result_bytes = call();
  state.counters["MiB_peak"] = (measure::memory_bytes("VmHWM:") - before) / 1048576;
  state.counters["MiB_of_results"] = double(result_bytes) / 1048576;
}

std::size_t bytes_of(const pipelines::NodalMaximum& maximum) {
  return maximum.value_Pa.size() * (sizeof(double) + sizeof(std::int32_t) + sizeof(pipelines::Stress));
}

/// Fatigue's walks through the instants beside the envelope's.
/// @param state  nodes, channels, instants
void largest_cycles(benchmark::State& state) {
  auto p = problem(std::size_t(state.range(0)), std::size_t(state.range(1)), state.range(2), Course::orders);
  std::vector<std::size_t> nodes(p.responses.nodes.n);
  std::iota(nodes.begin(), nodes.end(), std::size_t(0));
  const auto superpose = [&] { return envelope(p.loads, p.responses, 1); };
  share_among(18, p.loads);  // as many as the vibratory mill has
  report_memory(state, [&] {
    const auto found = superpose();
    const auto cycles = nodal_cycles(p.loads, p.responses, found.von_mises, nodes, 1);
    return bytes_of(found.von_mises) + bytes_of(found.principal) + found.effect_share.size() * sizeof(float) +
           cycles.nodes.size() * (sizeof(std::size_t) + sizeof(pipelines::NodalCycle));
  });
  share_among(1, p.loads);
  const auto found = superpose();
  const auto cycles = [&] { return nodal_cycles(p.loads, p.responses, found.von_mises, nodes, 1); };
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(cycles());
  const int n_calls = p.responses.nodes.n > 10000 ? 5 : 50;
  const double alone_s = smallest_s(superpose, n_calls);
  state.counters["envelope_s"] = alone_s;
  state.counters["with_envelope_of_envelope"] = 1 + smallest_s(cycles, n_calls) / alone_s;
  report_flops(state, p, alone_s);
}

}  // namespace

BENCHMARK(largest_cycles)
    ->ArgNames({"nodes", "channels", "instants"})
    ->Args({4096, 12, 720})
    ->Args({4096, 31, 720})
    ->Args({200000, 12, 720});
BENCHMARK(superposition)
    ->ArgNames({"channels", "instants", "course"})
    ->ArgsProduct({{12, 31}, {720, 2400}, {0, 1, 2}});

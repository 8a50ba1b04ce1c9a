#include "pipelines/superposition.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <thread>

#include "pipelines/superposition_kernel.h"

namespace pipelines {
namespace {

/// Time factors in the kernel's order, padded with zero load: n_blocks x K x block.
struct PackedFactors {
  std::size_t n_channels, n_instants, n_blocks;
  std::vector<double> values;

  explicit PackedFactors(const ChannelHistory& loads)
      : n_channels(std::size_t(loads.values.rows())),
        n_instants(std::size_t(loads.values.cols())),
        n_blocks((n_instants + kernel::block - 1) / kernel::block),
        values(n_blocks * n_channels * kernel::block, 0.0) {
    for (std::size_t i = 0; i < n_instants; ++i)
      for (std::size_t k = 0; k < n_channels; ++k)
        values[((i / kernel::block) * n_channels + k) * kernel::block + i % kernel::block] =
            loads.values(Eigen::Index(k), Eigen::Index(i));
  }
};

/// The unit stresses of a node, K x 6.
const double* unit_stress(const fem::UnitResponses& responses, std::size_t node) {
  return responses.stress_Pa.data() + node * responses.channels.size() * 6;
}

Stress combine(const double* unit, const Eigen::ArrayXXd& factors, Eigen::Index instant) {
  Stress s{};
  for (Eigen::Index k = 0; k < factors.rows(); ++k)
    for (std::size_t c = 0; c < 6; ++c) s[c] += factors(k, instant) * unit[6 * std::size_t(k) + c];
  return s;
}

/// Stress of a node over one block of instants: six components of `block` values.
std::array<std::array<double, kernel::block>, 6> stress_of_block(const double* unit,
                                                                 const PackedFactors& factors,
                                                                 std::size_t b) {
  std::array<std::array<double, kernel::block>, 6> stress{};
  const double* a = factors.values.data() + b * factors.n_channels * kernel::block;
  for (std::size_t k = 0; k < factors.n_channels; ++k, a += kernel::block, unit += 6)
    for (std::size_t c = 0; c < 6; ++c)
      for (std::size_t i = 0; i < kernel::block; ++i) stress[c][i] += unit[c] * a[i];
  return stress;
}

/// Largest principal stress over the cycle, best-first: blocks in descending order of their bound until the
/// bound of the next one cannot beat what has been found.
void find_principal(const double* unit, const PackedFactors& factors, const double* bounds,
                    std::size_t n_blocks, std::vector<std::size_t>& order, double& value,
                    std::int32_t& instant, Stress& tensor) {
  order.resize(n_blocks);
  std::iota(order.begin(), order.end(), std::size_t(0));
  const auto by_bound = [&](std::size_t a, std::size_t b) {
    return bounds[a] < bounds[b] || (bounds[a] == bounds[b] && a > b);
  };
  std::make_heap(order.begin(), order.end(), by_bound);
  value = -HUGE_VAL;
  while (!order.empty()) {
    std::pop_heap(order.begin(), order.end(), by_bound);
    const std::size_t b = order.back();
    order.pop_back();
    // The bound holds up to rounding; the slack keeps a tie from being lost.
    if (bounds[b] < value - 1e-12 * std::abs(value)) break;
    const auto stress = stress_of_block(unit, factors, b);
    for (std::size_t i = 0; i < kernel::block && b * kernel::block + i < factors.n_instants; ++i) {
      const Stress s{stress[0][i], stress[1][i], stress[2][i], stress[3][i], stress[4][i], stress[5][i]};
      const double mean = (s[0] + s[1] + s[2]) / 3;
      if (mean + 2.0 / 3.0 * von_mises_Pa(s) < value - 1e-12 * std::abs(value)) continue;
      const double principal = largest_principal_Pa(s);
      const auto at = std::int32_t(b * kernel::block + i);
      if (principal > value || (principal == value && at < instant)) {
        value = principal;
        instant = at;
        tensor = s;
      }
    }
  }
}

/// Shares of the effects in the von Mises stress of a node at one instant.
void find_shares(const double* unit, const ChannelHistory& loads, const Stress& stress, Eigen::Index instant,
                 double* shares) {
  const std::size_t n_effects = loads.effects.size();
  const double sigma_v = von_mises_Pa(stress);
  const double mean = (stress[0] + stress[1] + stress[2]) / 3;
  const Stress deviator{stress[0] - mean, stress[1] - mean, stress[2] - mean,
                        stress[3],        stress[4],        stress[5]};
  for (std::size_t e = 0; e < n_effects; ++e) {
    if (sigma_v == 0) {
      shares[e] = 0;
      continue;
    }
    const Stress part = combine(unit, loads.by_effect[e], instant);
    double product = 0;
    for (std::size_t c = 0; c < 6; ++c) product += (c < 3 ? 1 : 2) * part[c] * deviator[c];
    shares[e] = 1.5 * product / (sigma_v * sigma_v);
  }
}

void check_channels(const ChannelHistory& loads, const fem::UnitResponses& responses) {
  bool same = loads.channels.size() == responses.channels.size() &&
              loads.values.rows() == Eigen::Index(loads.channels.size());
  for (std::size_t k = 0; same && k < loads.channels.size(); ++k)
    same = loads.channels[k].name == responses.channels[k];
  if (!same)
    throw std::invalid_argument("superposition: the load channels are not those of the unit responses");
}

}  // namespace

namespace {

/// Squares and cubes of stresses beyond these leave the range of numbers.
constexpr double smallest_Pa = 1e-80, largest_Pa = 1e80;

/// A power of two that brings the largest size to about 1; 1 where there is no need, or nothing to scale.
double power_to_unit_size(double largest) {
  if (!(largest > 0) || !std::isfinite(largest) || (largest > smallest_Pa && largest < largest_Pa)) return 1;
  return std::ldexp(1.0, std::clamp(-std::ilogb(largest), -1000, 1000));
}

double power_to_unit_size(const Stress& s) {
  double largest = 0;
  for (const double component : s) largest = std::max(largest, std::abs(component));
  return power_to_unit_size(largest);
}

Stress scaled(Stress s, double factor) {
  for (double& component : s) component *= factor;
  return s;
}

/// The envelope of loads times `scale`, brought back.
Envelope unscaled(Envelope envelope, double scale) {
  for (NodalMaximum* maximum : {&envelope.von_mises, &envelope.principal}) {
    for (double& value : maximum->value_Pa) value /= scale;
    for (Stress& stress : maximum->stress_Pa) stress = scaled(stress, 1 / scale);
  }
  return envelope;
}

}  // namespace

double von_mises_Pa(const Stress& s) {
  if (const double scale = power_to_unit_size(s); scale != 1) return von_mises_Pa(scaled(s, scale)) / scale;
  const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
  return std::sqrt(0.5 * (xy * xy + yz * yz + zx * zx) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

double largest_principal_Pa(const Stress& s) {
  if (const double scale = power_to_unit_size(s); scale != 1)
    return largest_principal_Pa(scaled(s, scale)) / scale;
  const double mean = (s[0] + s[1] + s[2]) / 3;
  const double x = s[0] - mean, y = s[1] - mean, z = s[2] - mean;
  const double j2 = 0.5 * (x * x + y * y + z * z) + s[3] * s[3] + s[4] * s[4] + s[5] * s[5];
  if (j2 == 0) return mean;
  const double j3 =
      x * (y * z - s[4] * s[4]) - s[3] * (s[3] * z - s[4] * s[5]) + s[5] * (s[3] * s[4] - y * s[5]);
  const double cosine = std::clamp(1.5 * std::sqrt(3.0) * j3 / (j2 * std::sqrt(j2)), -1.0, 1.0);
  return mean + 2 * std::sqrt(j2 / 3) * std::cos(std::acos(cosine) / 3);
}

Stress stress_at(const fem::UnitResponses& responses, const ChannelHistory& loads, std::size_t node,
                 Eigen::Index instant) {
  return combine(unit_stress(responses, node), loads.values, instant);
}

Envelope envelope(const ChannelHistory& loads, const fem::UnitResponses& responses, int n_threads) {
  check_channels(loads, responses);
  if (const double scale = power_to_unit_size(loads.values.size() > 0 ? loads.values.abs().maxCoeff() : 0.0);
      scale != 1) {
    ChannelHistory of_unit_size = loads;
    of_unit_size.values *= scale;
    for (auto& part : of_unit_size.by_effect) part *= scale;
    return unscaled(envelope(of_unit_size, responses, n_threads), scale);
  }
  const std::size_t n_nodes = responses.nodes.n, n_effects = loads.effects.size();
  const PackedFactors factors(loads);
  Envelope result;
  for (NodalMaximum* maximum : {&result.von_mises, &result.principal}) {
    maximum->value_Pa.assign(n_nodes, 0.0);
    maximum->instant.assign(n_nodes, 0);
    maximum->stress_Pa.assign(n_nodes, Stress{});
  }
  result.effect_share.assign(n_nodes * n_effects, 0.0);

  kernel::Walk& walk = kernel::walk_for_this_machine();
  const auto work = [&](std::size_t begin, std::size_t end) {
    std::vector<double> bounds(kernel::batch * factors.n_blocks);
    std::array<kernel::NodeMaximum, kernel::batch> found;
    std::vector<std::size_t> order;
    for (std::size_t first = begin; first < end; first += kernel::batch) {
      const std::size_t n = std::min(kernel::batch, end - first);
      walk(unit_stress(responses, first), n, factors.n_channels, factors.values.data(), factors.n_blocks,
           found.data(), bounds.data());
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t node = first + i;
        const double* unit = unit_stress(responses, node);
        const auto instant = std::min(found[i].instant, long(factors.n_instants) - 1);
        const Stress stress = combine(unit, loads.values, instant);
        result.von_mises.instant[node] = std::int32_t(instant);
        result.von_mises.stress_Pa[node] = stress;
        result.von_mises.value_Pa[node] = von_mises_Pa(stress);
        find_principal(unit, factors, bounds.data() + i * factors.n_blocks, factors.n_blocks, order,
                       result.principal.value_Pa[node], result.principal.instant[node],
                       result.principal.stress_Pa[node]);
        find_shares(unit, loads, stress, instant, result.effect_share.data() + node * n_effects);
      }
    }
  };
  // Nodes are independent, so the split between threads cannot change a bit of the result.
  const std::size_t n_workers = std::size_t(std::max(1, n_threads));
  std::vector<std::thread> threads;
  for (std::size_t w = 0; w < n_workers; ++w)
    threads.emplace_back(work, n_nodes * w / n_workers, n_nodes * (w + 1) / n_workers);
  for (auto& thread : threads) thread.join();
  return result;
}

std::vector<double> displacement_at(const fem::UnitResponses& responses, const ChannelHistory& loads,
                                    Eigen::Index instant) {
  const std::size_t n_channels = responses.channels.size();
  std::vector<double> displacement(responses.nodes.n * 3, 0.0);
  for (std::size_t node = 0; node < responses.nodes.n; ++node)
    for (std::size_t k = 0; k < n_channels; ++k)
      for (std::size_t c = 0; c < 3; ++c)
        displacement[3 * node + c] += loads.values(Eigen::Index(k), instant) *
                                      responses.displacement_m[(node * n_channels + k) * 3 + c];
  return displacement;
}

}  // namespace pipelines

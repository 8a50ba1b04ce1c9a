#include "pipelines/base/fatigue/sn_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "pipelines/base/fatigue/fatigue_input.h"

namespace pipelines {
namespace {

void require_blocks(const std::vector<StressBlock>& blocks) {
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const std::string name = "blocks[" + std::to_string(i) + "].";
    require_non_negative_input(name + "amplitude_Pa", blocks[i].amplitude_Pa);
    require_non_negative_input(name + "count", blocks[i].count);
  }
}

/// x with above e^(k x) + below e^(k2 x) = 1; both sums not negative, one positive. The left side grows and
/// is convex: Newton's method from the right comes down to the root.
double crossing_of_powers(double above, double k, double below, double k2) {
  const double never = std::numeric_limits<double>::infinity();
  const double by_above = above > 0 ? -std::log(above) / k : never;
  const double by_below = below > 0 ? -std::log(below) / k2 : never;
  double x = std::min(by_above, by_below);
  if (above == 0 || below == 0) return x;
  for (int i = 0; i < 100; ++i) {
    const double a = above * std::exp(k * x), b = below * std::exp(k2 * x);
    const double step = (a + b - 1) / (k * a + k2 * b);
    x -= step;
    if (std::abs(step) <= 1e-15 * std::max(1.0, std::abs(x))) break;
  }
  return x;
}

}  // namespace

void require_sound(const SnCurve& curve) {
  require_positive_input("knee_amplitude_Pa", curve.knee_amplitude_Pa);
  require_positive_input("knee_cycles", curve.knee_cycles);
  require_input_between("slope", curve.slope, 1, 1000);
  if (curve.second_slope) require_input_between("second_slope", *curve.second_slope, curve.slope, 2000);
}

std::optional<double> cycles_to_failure(const SnCurve& curve, double amplitude_Pa) {
  require_sound(curve);
  require_non_negative_input("amplitude_Pa", amplitude_Pa);
  const double ratio = amplitude_Pa / curve.knee_amplitude_Pa;
  if (ratio == 0 || (ratio <= 1 && !curve.second_slope)) return std::nullopt;
  const double cycles = curve.knee_cycles * std::pow(ratio, ratio > 1 ? -curve.slope : -*curve.second_slope);
  if (!std::isfinite(cycles)) return std::nullopt;
  return cycles;
}

double endured_amplitude_Pa(const SnCurve& curve, double cycles) {
  require_sound(curve);
  require_positive_input("cycles", cycles);
  const double ratio = cycles / curve.knee_cycles;
  if (ratio < 1) return curve.knee_amplitude_Pa * std::pow(ratio, -1 / curve.slope);
  if (!curve.second_slope) return curve.knee_amplitude_Pa;
  return curve.knee_amplitude_Pa * std::pow(ratio, -1 / *curve.second_slope);
}

double miner_damage(const SnCurve& curve, const std::vector<StressBlock>& blocks) {
  require_sound(curve);
  require_blocks(blocks);
  double damage = 0;
  for (const StressBlock& block : blocks)
    if (const auto cycles = cycles_to_failure(curve, block.amplitude_Pa)) damage += block.count / *cycles;
  return damage;
}

SnCurve curve_with_damage(SnCurve curve, const std::vector<StressBlock>& blocks) {
  if (miner_damage(curve, blocks) > 0) return curve;
  double largest_Pa = 0;
  for (const auto& block : blocks)
    if (block.count > 0) largest_Pa = std::max(largest_Pa, block.amplitude_Pa);
  if (largest_Pa > 0) curve.knee_amplitude_Pa = largest_Pa;
  curve.second_slope = curve.slope;
  return curve;
}

double elementary_damage(const std::vector<StressBlock>& blocks, double slope) {
  double damage = 0;
  for (const StressBlock& block : blocks) damage += block.count * std::pow(block.amplitude_Pa, slope);
  return damage;
}

std::optional<double> life_factor(const SnCurve& curve, const std::vector<StressBlock>& blocks,
                                  double repetitions, double damage_sum) {
  require_sound(curve);
  require_blocks(blocks);
  require_positive_input("repetitions", repetitions);
  require_positive_input("damage_sum", damage_sum);
  std::vector<StressBlock> falling;
  for (const StressBlock& block : blocks)
    if (block.amplitude_Pa > 0 && block.count > 0)
      falling.push_back({block.amplitude_Pa / curve.knee_amplitude_Pa, block.count});
  if (falling.empty()) return std::nullopt;
  std::sort(falling.begin(), falling.end(),
            [](const StressBlock& a, const StressBlock& b) { return a.amplitude_Pa > b.amplitude_Pa; });

  // Amplitudes as parts of the largest, factors as those that bring the largest to the knee: no power
  // overflows.
  const double largest = falling.front().amplitude_Pa;
  if (curve.endures_together) {
    const SnCurve one_slope{curve.knee_amplitude_Pa, curve.knee_cycles, curve.slope, curve.slope};
    return std::max(1 / largest, *life_factor(one_slope, blocks, repetitions, damage_sum));
  }
  const double per_count = repetitions / (curve.knee_cycles * damage_sum);
  const double k = curve.slope, k2 = curve.second_slope.value_or(k);
  std::vector<double> rest(falling.size() + 1, 0);  // sum of the blocks from i on, below the knee
  if (curve.second_slope)
    for (std::size_t i = falling.size(); i-- > 0;)
      rest[i] = rest[i + 1] + per_count * falling[i].count * std::pow(falling[i].amplitude_Pa / largest, k2);
  double above = 0;
  for (std::size_t i = 0; i <= falling.size(); ++i) {
    // i blocks are above the knee, up to the factor that brings the next one there
    if (i > 0) above += per_count * falling[i - 1].count * std::pow(falling[i - 1].amplitude_Pa / largest, k);
    const bool last = i == falling.size();
    const double border = last ? 0 : std::log(largest / falling[i].amplitude_Pa);
    if (!last && i > 0 && falling[i].amplitude_Pa == falling[i - 1].amplitude_Pa) continue;
    if (above == 0 && rest[i] == 0) continue;
    double x = crossing_of_powers(above, k, rest[i], k2);
    if (i > 0) x = std::max(x, std::log(largest / falling[i - 1].amplitude_Pa));  // a jump of the damage
    if (last || x <= border) return std::exp(x) / largest;
  }
  return std::nullopt;  // not reached: the last sum has all blocks
}

}  // namespace pipelines

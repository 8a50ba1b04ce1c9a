#include "pipelines/judge/life/life_certainty.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace pipelines {

LifeCertainty certainty_of(double error_share, const std::string& beyond,
                           const std::function<std::optional<double>(double)>& life_s) {
  if (!beyond.empty()) return {std::nullopt, beyond};
  if (!std::isfinite(error_share)) {
    constexpr double any = 1e30;  // times a stress that changes at all
    if (life_s(any)) return {};
    return {LifeRange{}, ""};
  }
  if (error_share >= 1) {  // nothing is known of a life; what seems to endure may not
    if (life_s(1)) return {std::nullopt, ""};
    return {LifeRange{life_s(1 + error_share), std::nullopt}, ""};
  }
  return {LifeRange{life_s(1 + error_share), life_s(1 - error_share)}, ""};
}

std::optional<double> least_safety(double safety, double error_share) {
  if (!std::isfinite(error_share)) return std::nullopt;
  return safety / (1 + error_share);
}

std::vector<StressBlock> scaled(std::vector<StressBlock> blocks, double factor) {
  for (auto& block : blocks) block.amplitude_Pa *= factor;
  return blocks;
}

namespace {

double largest_amplitude_Pa(const std::vector<StressBlock>& blocks) {
  double largest_Pa = 0;
  for (const auto& block : blocks)
    if (block.count > 0) largest_Pa = std::max(largest_Pa, block.amplitude_Pa);
  return largest_Pa;
}

}  // namespace

std::optional<double> life_safety(const SnCurve& curve, const std::vector<StressBlock>& blocks,
                                  double repetitions, double damage_sum) {
  const auto factor = life_factor(curve, blocks, repetitions, damage_sum);
  if (!factor) return factor;
  return std::min(*factor,
                  endured_amplitude_Pa(curve, least_cycles_of_curves) / largest_amplitude_Pa(blocks));
}

std::string beyond_curve(double largest_Pa, double yield_Pa, const SnCurve& curve,
                         const std::vector<StressBlock>& blocks) {
  if (largest_Pa > yield_Pa)
    return fmt::format("amplitude plus mean, {:.4g} MPa, exceed the yield strength, {:.4g} MPa",
                       largest_Pa / 1e6, yield_Pa / 1e6);
  const auto cycles = cycles_to_failure(curve, largest_amplitude_Pa(blocks));
  if (cycles && *cycles < least_cycles_of_curves)
    return fmt::format("{:.2g} of its largest cycles are endured, and S-N curves begin at {:.0e}", *cycles,
                       least_cycles_of_curves);
  return "";
}

std::string warning_beyond_curve(const std::string& body, std::size_t n_places, const std::string& place,
                                 const std::string& beyond) {
  return fmt::format(
      "{}: {}: {}{}; lives there follow from elastic stress by curves of high-cycle fatigue, and are no "
      "lives "
      "to rely on",
      body, place, beyond, n_places > 1 ? fmt::format(" (and {} more places)", n_places - 1) : "");
}

}  // namespace pipelines

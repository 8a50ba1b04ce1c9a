#include "pipelines/judge/texts/zone_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipelines/base/names/name_lists.h"
#include "pipelines/judge/analysis/error_text.h"
#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/scene/values/effect_groups.h"
#include "pipelines/superpose/envelope/zone_parts.h"

namespace pipelines {
namespace {

constexpr std::size_t n_shares_named = 3;
constexpr double least_named_share = 0.01;

std::string whole_percent(double share) {
  return fmt::format("{:.0f} %", 100 * share);
}

/// Decimals with which a number shows two digits at least.
int decimals_of(double number) {
  constexpr int most = 6;
  return number > 0 ? std::clamp(1 - int(std::floor(std::log10(number))), 0, most) : 1;
}

}  // namespace

std::vector<NamedShare> group_shares(const std::vector<std::string>& effects,
                                     const std::vector<double>& shares) {
  std::vector<NamedShare> sums;
  for (const auto& group : effect_groups(effects)) {
    NamedShare sum{group.name, 0};
    for (std::size_t i = 0; i < effects.size(); ++i)
      if (contains(group.effects, effects[i])) sum.share += shares[i];
    sums.push_back(sum);
  }
  return sums;
}

std::string largest_shares(std::vector<NamedShare> shares) {
  std::stable_sort(shares.begin(), shares.end(),
                   [](const auto& a, const auto& b) { return std::abs(a.share) > std::abs(b.share); });
  std::string text;
  double rest = 0;
  std::size_t n_named = 0;
  const auto add = [&](const std::string& name, double share) {
    text += (text.empty() ? "" : ", ") + name + " " + whole_percent(share);
  };
  for (const auto& [name, share] : shares) {
    if (n_named < n_shares_named && std::abs(share) >= least_named_share) {
      add(name, share);
      ++n_named;
    } else {
      rest += share;
    }
  }
  if (std::abs(rest) >= least_named_share) add("others", rest);
  return text;
}

ZoneFigures figures_of(const Judged& analysis, const Zone& zone) {
  return {zone.feature,   to_string(zone.place),
          zone.peak_Pa,   error_Pa(analysis, zone).value_or(std::numeric_limits<double>::quiet_NaN()),
          zone.safety,    zone.peak_m,
          zone.volume_m3, std::int64_t(zone.n_nodes)};
}

VolumeText volume_text(double volume_m3, const std::optional<double>& error_m3) {
  constexpr double mm3 = 1e9;
  if (!std::isfinite(volume_m3)) return {"-", "-"};
  const double volume = volume_m3 * mm3;
  if (!error_m3 || !std::isfinite(*error_m3)) return {fixed(volume, decimals_of(volume)), "-"};
  const double error = *error_m3 * mm3;
  if (error >= volume)
    return {fixed(volume, decimals_of(volume)),
            "up to " + fixed(volume + error, decimals_of(volume + error))};
  const int decimals = decimals_of(error);
  return {fixed(volume, decimals), fixed(error, decimals)};
}

std::string VolumeText::text() const {
  if (volume == "-") return volume;
  if (error == "-") return volume + " +- ?";
  return volume + (error.find("up to") == 0 ? ", " : " +- ") + error;
}

std::string parts_text(const Zone& zone) {
  std::string text;
  for (const auto& split : splits_of(zone))
    text += text.empty()
                ? fmt::format("{} parts at {} of the peak", split.n_parts, whole_percent(split.share_of_peak))
                : fmt::format(", {} at {}", split.n_parts, whole_percent(split.share_of_peak));
  return text;
}

}  // namespace pipelines

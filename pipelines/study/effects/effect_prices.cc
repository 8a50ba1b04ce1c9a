#include "pipelines/study/effects/effect_prices.h"

#include <fmt/core.h>

#include <algorithm>
#include <ostream>
#include <string>

#include "pipelines/base/fields/field_outputs.h"
#include "pipelines/base/names/name_lists.h"
#include "pipelines/scene/values/effect_groups.h"

namespace pipelines {
namespace {

/// Effects that feed channel k.
std::size_t n_feeding(const ChannelHistory& history, Eigen::Index k) {
  return std::size_t(std::count_if(history.by_effect.begin(), history.by_effect.end(),
                                   [&](const auto& part) { return (part.row(k) != 0).any(); }));
}

}  // namespace

std::vector<EffectPrice> price_effects(const Judged& analysis, double solve_s, double superpose_s,
                                       const std::vector<std::pair<std::string, double>>& evaluation_s) {
  const auto& history = analysis.loads.history;
  const auto n_channels = history.values.rows();
  std::vector<EffectPrice> prices;
  for (std::size_t e = 0; e < history.effects.size(); ++e) {
    EffectPrice price;
    price.effect = history.effects[e];
    price.share = analysis.peak.effect_share[e];
    for (Eigen::Index k = 0; k < n_channels; ++k)
      if ((history.by_effect[e].row(k) != 0).any()) {
        ++price.n_channels;
        if (n_feeding(history, k) == 1) ++price.n_own;
      }
    const double part = n_channels > 0 ? double(price.n_own) / double(n_channels) : 0;
    price.unit_loads_s = part * solve_s;
    price.superposition_s = part * superpose_s;
    for (const auto& [effect, seconds] : evaluation_s)
      if (effect == price.effect) price.evaluation_s = seconds;
    prices.push_back(price);
  }
  std::stable_sort(prices.begin(), prices.end(),
                   [](const auto& a, const auto& b) { return std::abs(a.share) > std::abs(b.share); });
  return prices;
}

FieldTable<EffectPrice> effect_price_fields() {
  using Field = FieldOf<EffectPrice>;
  return without_csv(FieldTable<EffectPrice>{
      {"effect", quantities::text, "that is on", "effect", &EffectPrice::effect},
      Field("share", quantities::percent, "of the peak", "of the peak", &EffectPrice::share).digits("{:.2f}"),
      {"channels", quantities::count, "that it feeds", "channels", &EffectPrice::n_channels},
      {"own_channels", quantities::count, "that it alone feeds", "its own", &EffectPrice::n_own},
      Field("evaluation", quantities::time, "of the load stage", "load stage", &EffectPrice::evaluation_s)
          .digits("{:.3g}"),
      Field("saved", quantities::time,
            "at most without it: of the load stage, and of solve and superposition of its own channels",
            "saved if off",
            [](const EffectPrice& p) { return p.evaluation_s + p.unit_loads_s + p.superposition_s; })
          .digits("{:.3g}"),
  });
}

void print_effect_prices(std::ostream& out, const std::string& body, const std::vector<EffectPrice>& prices) {
  out << "\n  effects on the " << body;
  print_list(out, effect_price_fields(), prices);
  std::vector<std::string> names;
  for (const auto& p : prices) names.push_back(p.effect);
  if (const auto groups = effect_groups(names); any_sums(groups))
    for (const auto& group : groups) {
      double share = 0;
      for (const auto& p : prices)
        if (contains(group.effects, p.effect)) share += p.share;
      out << fmt::format("    {}, in sum: {:.2f}%\n", group.name, 100 * share);
    }
  out << "    saved if off, at most: its own seconds of the load stage, and the share of solve and "
         "superposition "
         "that the\n    channels have which no other effect feeds\n";
}

}  // namespace pipelines

#include <fmt/core.h>

#include <ostream>

#include "pipelines/base/names/name_lists.h"
#include "pipelines/base/names/nearest_name.h"
#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/scene/whole/machine_kind.h"
#include "pipelines/write/report/summary.h"

namespace pipelines {
namespace {

std::string rough_percent(double share) {
  return fmt::format("{:.2g} %", 100 * share);
}

/// Bound as a share of the body's governing stress; an estimate is said to be one.
std::string bound_text(const EffectBound& bound, const Judged& analysis) {
  const double stress_Pa = governing_stress(analysis).value_Pa;
  if (!(stress_Pa > 0)) return "-";
  return rough_percent(bound.bound_Pa / stress_Pa) + (bound.estimated_Pa > 0 ? " (est.)" : "");
}

const EffectBound* find(const DroppedBounds& bounds, const std::string& effect) {
  for (const auto& bound : bounds.effects)
    if (bound.effect == effect) return &bound;
  return nullptr;
}

/// Effects that are left out in one step each have the share of all of them: that is said.
void print_groups(std::ostream& out, const EffectChoice& choice) {
  std::vector<std::string> told;
  for (const auto& dropped : choice.dropped) {
    if (dropped.with.empty() || contains(told, dropped.effect)) continue;
    out << fmt::format("\n    together, since they need each other: {}, {}", dropped.effect,
                       listed(dropped.with));
    told.insert(told.end(), dropped.with.begin(), dropped.with.end());
  }
}

}  // namespace

void print_effect_choice(std::ostream& out, const Scene& scene, const std::vector<Judged>& bodies) {
  const auto& choice = scene.effect_choice;
  if (choice.offered.empty()) return;
  const std::string off = "off by effects = \"auto\"";
  if (choice.dropped.empty())
    out << fmt::format("\n  {}: none, with a limit of {}{}\n", off, rough_percent(choice.limit),
                       kind_of(scene.machine).has_samples() ? "; a load table's histories all count" : "");
  else {
    out << fmt::format("\n  {:<30}{:>16}", off, "of the loads");
    for (const auto& analysis : bodies) out << fmt::format("{:>22}", analysis.scene.name + ", at most");
    const auto row = [&](const std::string& name, double share, bool together) {
      out << fmt::format("\n    {:<28}{:>16}", name, rough_percent(share));
      for (const auto& analysis : bodies) {
        const EffectBound* bound = nullptr;
        if (analysis.dropped) bound = together ? &analysis.dropped->together : find(*analysis.dropped, name);
        out << fmt::format("{:>22}", bound ? bound_text(*bound, analysis) : "-");
      }
    };
    for (const auto& dropped : choice.dropped) row(dropped.effect, dropped.share, false);
    row(choice.taken_back.empty() ? "all of these" : "all, before any came back", choice.share, true);
    print_groups(out, choice);
    out << fmt::format("\n    limit {}; the load that changes most, felt by a body or not, is {}, by {}\n",
                       rough_percent(choice.limit), choice.load_change.load,
                       rough_percent(choice.load_change.share));
  }
  if (!choice.taken_back.empty())
    out << fmt::format("    on again, their bound was too large: {}\n", listed(choice.taken_back));
}

}  // namespace pipelines

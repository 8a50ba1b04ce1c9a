#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>

#include "pipelines/common/nearest_name.h"
#include "pipelines/effects/effect_report.h"

namespace pipelines {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

}  // namespace

std::string percent(double share) {
  return std::isfinite(share) ? fmt::format("{:.3g} %", 100 * share) : "-";
}

void print_effects(std::ostream& out, const Scene& scene, const EffectReport& report) {
  out << fmt::format("\n{}: the effects and what they are worth\n", scene.title);
  for (const auto& worth : report.effects) {
    out << fmt::format("\n  {}: {} ({})\n", worth.effect.name, worth.effect.description, worth.effect.source);
    out << fmt::format("    {:<28}{:>16}{:>16}{:>16}\n", "load", "largest share", "RMS share",
                       "change if off");
    for (const auto& share : worth.shares)
      out << fmt::format("    {:<28}{:>16}{:>16}{:>16}\n", share.load, percent(share.largest),
                         percent(share.rms), percent(share.if_off));
    if (!worth.indispensable.empty())
      out << "    cannot be left out by itself: " << worth.indispensable << '\n';
    else
      out << fmt::format("    {:.1f} ns per instant\n", 1e9 * worth.seconds_per_instant);
  }
  out << fmt::format("\n  all effects: {:.1f} ns per instant\n", 1e9 * report.seconds_per_instant);
  if (report.dispensable.empty())
    out << fmt::format("  below a threshold of {} none can be left out\n", percent(report.threshold));
  else
    out << fmt::format(
        "  below a threshold of {} these can be left out together: {}\n    the load that changes most is {}, "
        "by "
        "{} of its largest magnitude\n",
        percent(report.threshold), listed(report.dispensable), report.worst_load, percent(report.if_all_off));
}

std::string effects_json(const Scene& scene, const EffectReport& report) {
  Json json;
  json["scene"] = scene.file.filename().string();
  if (!scene.settings.empty()) json["settings"] = scene.settings;
  for (const auto& worth : report.effects) {
    Json entry{{"description", worth.effect.description}, {"source", worth.effect.source}};
    for (const auto& share : worth.shares)
      entry["loads"][share.load] = {{"largest_share", number_or_null(share.largest)},
                                    {"rms_share", number_or_null(share.rms)},
                                    {"change_if_off", number_or_null(share.if_off)}};
    entry["change_if_off"] = number_or_null(worth.if_off);
    entry["worst_load"] = worth.worst_load;
    entry["indispensable"] = worth.indispensable;
    entry["seconds_per_instant"] = worth.seconds_per_instant;
    json["effects"][worth.effect.name] = std::move(entry);
  }
  json["threshold"] = report.threshold;
  json["dispensable"] = report.dispensable;
  json["change_if_all_off"] = report.if_all_off;
  json["seconds_per_instant"] = report.seconds_per_instant;
  return json.dump(2) + "\n";
}

}  // namespace pipelines

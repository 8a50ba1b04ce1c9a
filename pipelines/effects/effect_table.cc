#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>

#include "pipelines/effects/effect_report.h"
#include "pipelines/names/nearest_name.h"

namespace pipelines {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

std::string nanoseconds(const MeasuredTime& time) {
  return fmt::format("{:.0f} ns per instant, of seven runs five took {:.0f} to {:.0f}", 1e9 * time.median_s,
                     1e9 * time.low_s, 1e9 * time.high_s);
}

Json json_of_time(const MeasuredTime& time) {
  return {{"median", time.median_s}, {"low", time.low_s}, {"high", time.high_s}};
}

void print_shares(std::ostream& out, const std::vector<LoadShare>& shares) {
  out << fmt::format("    {:<28}{:>16}{:>16}{:>16}\n", "load", "largest share", "RMS share", "change if off");
  for (const auto& share : shares)
    out << fmt::format("    {:<28}{:>16}{:>16}{:>16}\n", share.load, percent(share.largest),
                       percent(share.rms), percent(share.if_off));
}

Json json_of_shares(const std::vector<LoadShare>& shares) {
  Json json;
  for (const auto& share : shares)
    json[share.load] = {{"largest_share", number_or_null(share.largest)},
                        {"rms_share", number_or_null(share.rms)},
                        {"change_if_off", number_or_null(share.if_off)}};
  return json;
}

}  // namespace

std::string percent(double share) {
  return std::isfinite(share) ? fmt::format("{:.3g} %", 100 * share) : "-";
}

void print_effects(std::ostream& out, const Scene& scene, const EffectReport& report) {
  out << fmt::format("\n{}: the effects and what they are worth\n", scene.title);
  for (const auto& worth : report.effects) {
    out << fmt::format("\n  {}: {} ({})\n", worth.effect.name, worth.effect.description, worth.effect.source);
    print_shares(out, worth.shares);
    if (!worth.indispensable.empty())
      out << "    cannot be left out by itself: " << worth.indispensable << '\n';
    else if (worth.per_instant.is_seen())
      out << "    " << nanoseconds(worth.per_instant) << '\n';
    else
      out << "    costs less time than repeated runs differ by\n";
  }
  for (const auto& group : report.groups) {
    out << fmt::format("\n  {}, in sum: {}\n", group.name, listed(group.effects));
    print_shares(out, group.shares);
    if (!group.indispensable.empty()) out << "    cannot be left out: " << group.indispensable << '\n';
  }
  out << "\n  all effects: " << nanoseconds(report.per_instant) << '\n';
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
    if (!worth.shares.empty()) entry["loads"] = json_of_shares(worth.shares);
    entry["change_if_off"] = number_or_null(worth.if_off);
    entry["worst_load"] = worth.worst_load;
    entry["indispensable"] = worth.indispensable;
    entry["seconds_per_instant"] = json_of_time(worth.per_instant);
    json["effects"][worth.effect.name] = std::move(entry);
  }
  json["threshold"] = report.threshold;
  json["dispensable"] = report.dispensable;
  json["change_if_all_off"] = report.if_all_off;
  for (const auto& group : report.groups)
    json["groups"][group.name] = {{"effects", group.effects},
                                  {"loads", json_of_shares(group.shares)},
                                  {"indispensable", group.indispensable}};
  json["seconds_per_instant"] = json_of_time(report.per_instant);
  return json.dump(2) + "\n";
}

}  // namespace pipelines

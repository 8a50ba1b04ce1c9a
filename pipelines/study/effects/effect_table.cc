#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "pipelines/base/fields/field_outputs.h"
#include "pipelines/base/names/nearest_name.h"
#include "pipelines/study/effects/body_effect_report.h"

namespace pipelines {
namespace {

using summary::Json, summary::number_or_none;

std::string nanoseconds(const MeasuredTime& time) {
  return fmt::format("{:.0f} ns per instant, of seven runs five took {:.0f} to {:.0f}", 1e9 * time.median_s,
                     1e9 * time.low_s, 1e9 * time.high_s);
}

Json json_of_time(const MeasuredTime& time) {
  return {{"median", time.median_s}, {"low", time.low_s}, {"high", time.high_s}};
}

/// Everything: a table of each group, then of each effect.
void print_all(std::ostream& out, const EffectReport& report) {
  for (const auto& group : report.groups) {
    out << fmt::format("\n  {}, in sum: {}\n", group.name, listed(group.effects));
    print_load_shares(out, group.shares);
    if (!group.indispensable.empty()) out << "    cannot be left out: " << group.indispensable << '\n';
  }
  for (const auto& worth : report.effects) {
    out << fmt::format("\n  {}: {} ({})\n", worth.effect.name, worth.effect.description, worth.effect.source);
    print_load_shares(out, worth.shares);
    if (!worth.indispensable.empty())
      out << "    cannot be left out by itself: " << worth.indispensable << '\n';
    else if (worth.per_instant.is_seen())
      out << "    " << nanoseconds(worth.per_instant) << '\n';
    else
      out << "    costs less time than repeated runs differ by\n";
  }
  out << "\n  all effects: " << nanoseconds(report.per_instant) << '\n';
}

/// Percentage as people read it: no exponents, and nothing of round-off.
std::string short_percent(double share) {
  constexpr double least = 1e-4;
  if (!std::isfinite(share)) return "-";
  if (share < least) return "< 0.01 %";
  return share >= 1 ? fmt::format("{:.0f} %", 100 * share) : fmt::format("{:.2g} %", 100 * share);
}

/// One line of the short table.
struct EffectRow {
  std::string name;
  const std::vector<LoadShare>* shares = nullptr;
  bool is_indispensable = false;

  /// The load that it is the largest part of; where it is none, what leaving it out changes most.
  const LoadShare* most() const {
    const LoadShare *part = nullptr, *change = nullptr;
    for (const auto& share : *shares) {
      if (part == nullptr || share.largest > part->largest) part = &share;
      if (change == nullptr || share.if_off > change->if_off) change = &share;
    }
    return part != nullptr && part->largest >= negligible_load_share ? part : change;
  }
  double size(const LoadShare& share) const {
    return std::isfinite(share.if_off) ? std::max(share.largest, share.if_off) : share.largest;
  }
};

void print_effect_rows(std::ostream& out, const std::string& title, std::vector<EffectRow> rows) {
  const auto size_of = [](const EffectRow& row) {
    const auto* most = row.most();
    return most == nullptr ? 0.0 : row.size(*most);
  };
  std::stable_sort(rows.begin(), rows.end(),
                   [&](const auto& a, const auto& b) { return size_of(a) > size_of(b); });
  ShownRows table{{title, "largest part", "change if off", "of the load", "other loads"}, {}};
  for (const auto& row : rows) {
    const auto* most = row.most();
    if (most == nullptr) {
      table.cells.push_back({row.name, "-", "-", "", ""});
      continue;
    }
    std::size_t n_felt = 0, n_small = 0;
    for (const auto& share : *row.shares)
      if (&share != most) ++(row.size(share) >= negligible_load_share ? n_felt : n_small);
    std::string others = n_felt > 0 ? fmt::format("{} felt", n_felt) : "";
    if (n_small > 0)
      others +=
          fmt::format("{}{} below {}", others.empty() ? "" : ", ", n_small, percent(negligible_load_share));
    table.cells.push_back({row.name, short_percent(most->largest),
                           row.is_indispensable ? "needed" : short_percent(most->if_off), most->load,
                           others});
  }
  print_rows(out, title, table);
}

void print_short(std::ostream& out, const EffectReport& report) {
  std::vector<EffectRow> groups, effects;
  for (const auto& group : report.groups)
    groups.push_back({group.name, &group.shares, !group.indispensable.empty()});
  for (const auto& worth : report.effects)
    effects.push_back({worth.effect.name, &worth.shares, !worth.indispensable.empty()});
  if (!groups.empty()) print_effect_rows(out, "parts of the machine", std::move(groups));
  print_effect_rows(out, "effects", std::move(effects));
  out << "    largest part: its largest size over that of the load; needed: others need it, -v says which; "
         "all "
         "loads, RMS and seconds: -v, --json\n";
}

}  // namespace

std::string percent(double share) {
  return std::isfinite(share) ? fmt::format("{:.3g} %", 100 * share) : "-";
}

void print_effects(std::ostream& out, const Scene& scene, const EffectReport& report, bool all) {
  out << fmt::format("\n{}: the effects and what they are worth\n", scene.title);
  all ? print_all(out, report) : print_short(out, report);
  if (report.dispensable.empty())
    out << fmt::format("\n  below a threshold of {} none can be left out\n", percent(report.threshold));
  else
    out << fmt::format(
        "\n  below a threshold of {} these can be left out together: {}\n    the load that changes most is "
        "{}, "
        "by {} of its largest magnitude\n",
        percent(report.threshold), listed(report.dispensable), report.worst_load, percent(report.if_all_off));
}

std::string effects_json(const Scene& scene, const EffectReport& report) {
  Json json;
  json["scene"] = scene.file.filename().string();
  if (!scene.settings.empty()) json["settings"] = scene.settings;
  for (const auto& worth : report.effects) {
    Json entry{{"description", worth.effect.description}, {"source", worth.effect.source}};
    if (!worth.shares.empty()) entry["loads"] = load_shares_json(worth.shares);
    entry["change_if_off"] = number_or_none(worth.if_off);
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
                                  {"loads", load_shares_json(group.shares)},
                                  {"indispensable", group.indispensable}};
  json["seconds_per_instant"] = json_of_time(report.per_instant);
  return json.dump(2) + "\n";
}

}  // namespace pipelines

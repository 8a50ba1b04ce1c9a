#include "pipelines/report_parts/duty_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <ostream>

#include "pipelines/analysis/error_text.h"
#include "pipelines/analysis/weld_places.h"
#include "pipelines/files/csv.h"
#include "pipelines/names/name_lists.h"
#include "pipelines/report_parts/damage_share_text.h"
#include "pipelines/report_parts/fatigue_report.h"

namespace pipelines {
namespace {

constexpr std::size_t n_duty_places_shown = 4;
constexpr double hour_s = 3600, day_h = 24;

/// What lies between the instants, where it is worth a word.
std::string sampling_text(const BlockStress& stress) {
  constexpr double worth_a_word = 0.001;
  const double share = stress.sampling_error_Pa / stress.value_Pa;
  return share > worth_a_word ? fmt::format(", up to {:.2g} % more between the instants", 100 * share)
                              : std::string();
}

void print_blocks(std::ostream& out, const DutyResult& duty) {
  const bool have_bodies =
      std::any_of(duty.blocks.begin(), duty.blocks.end(), [](const auto& b) { return !b.stresses.empty(); });
  out << fmt::format("\n  {:<24}{:>8}{:>12}{}\n", "operating block", "share", "starts/day",
                     have_bodies ? "  largest stress" : "");
  for (const auto& block : duty.blocks) {
    std::string stresses;
    for (const auto& stress : block.stresses)
      stresses +=
          fmt::format("{}{} {} MPa (safety {}) at {}", stresses.empty() ? "" : "; ", stress.body,
                      fixed(stress.value_Pa / 1e6, 1), fixed(stress.safety, 2),
                      stress.feature + (stress.is_hot_spot ? " (weld toe)" : "") + sampling_text(stress));
    out << fmt::format("  {:<24}{:>6.4g} %{:>12}{}{}\n", block.name, 100 * block.share,
                       block.starts_per_day > 0
                           ? fmt::format("{:.4g}{}", block.starts_per_day, block.has_transient ? "" : " *")
                           : "-",
                       stresses.empty() ? "" : "  ", stresses);
  }
  const bool at_once = std::any_of(duty.blocks.begin(), duty.blocks.end(), [](const auto& block) {
    return block.starts_per_day > 0 && !block.has_transient;
  });
  if (at_once) out << "    * from rest to running at once: no transient is in it\n";
  if (duty.in_operation < 1 - 1e-9)
    out << fmt::format("    in operation {:.4g} % of the time; lives are hours in operation\n",
                       100 * duty.in_operation);
}

/// "coarse 80 %, starts of fine 15 %": the shares of the damage, the largest first.
std::string causes_of(const DutyResult& duty, const DutyPlace& place) {
  if (!(place.damage_per_s > 0)) return "no damage";
  std::vector<std::pair<double, std::string>> causes;
  for (std::size_t b = 0; b < place.blocks.size(); ++b) {
    causes.emplace_back(place.blocks[b].damage_per_s, duty.blocks[b].name);
    causes.emplace_back(place.blocks[b].starts_per_s, "starts of " + duty.blocks[b].name);
  }
  std::stable_sort(causes.begin(), causes.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, causes.size()); ++i)
    if (const double share = causes[i].first / place.damage_per_s; share >= 0.005)
      text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", causes[i].second, 100 * share);
  return text;
}

std::string rule_of_lives() {
  return fmt::format(
      "lives: Palmgren-Miner over all blocks and starts, at each place one S-N curve for the cycles of all, "
      "at "
      "a damage sum of 1, at weld toes {:.3g}; the order of blocks does not count",
      damage_sum_of_spectra);
}

void print_places(std::ostream& out, const DutyResult& duty) {
  for (const auto& [body, places] : duty.places) {
    out << fmt::format("\n  {:<40}{:>13}{:>44}  {}\n", body + " over all blocks", "amplitude MPa", "life",
                       "damage by");
    const auto n = std::min(n_duty_places_shown, places.size());
    for (std::size_t i = 0; i < n; ++i) {
      double amplitude_Pa = 0;
      for (const auto& block : places[i].blocks)
        amplitude_Pa = std::max({amplitude_Pa, block.amplitude_Pa, block.start_amplitude_Pa});
      out << fmt::format("  {:<40}{:>13.1f}{:>44}  {}\n",
                         places[i].feature + (places[i].is_weld ? " (weld toe)" : ""), amplitude_Pa / 1e6,
                         life_text(places[i].life_s, places[i].certainty), causes_of(duty, places[i]));
      if (const auto text =
              damage_text(duty.effects.at(body), places[i].effect_share, places[i].damage_per_s > 0);
          !text.empty())
        out << "    effects: " << text << '\n';
      if (places[i].life_safety)
        out << fmt::format("    safety against the wanted life, beyond the safety factor: {}\n",
                           safety_text(*places[i].life_safety, places[i].error_share));
    }
    print_may_last_less(out, places.empty() ? "" : places.front().feature,
                        may_last_less(places, [](const auto& place) { return place.feature; }));
  }
  if (!duty.places.empty()) out << "    " << rule_of_lives() << '\n';
}

void print_bearings(std::ostream& out, const DutyResult& duty) {
  if (duty.bearings.empty()) return;
  out << fmt::format("\n  {:<40}{:>18}{:>12}{:>16}\n", "bearings over all blocks", "equivalent load N",
                     "L10h hours", "modified hours");
  const auto hours = [](const std::optional<double>& life) {
    return life ? fmt::format("{:.5g}", *life) : std::string("-");
  };
  for (const auto& bearing : duty.bearings)
    out << fmt::format("  {:<40}{:>18.5g}{:>12}{:>16}\n", bearing.name, bearing.equivalent_load_N,
                       hours(bearing.life_h), hours(bearing.modified_life_h));
}

double or_infinite(const std::optional<double>& value) {
  return value.value_or(std::numeric_limits<double>::infinity());
}

summary::Json place_json(const DutyResult& duty, const std::string& body, const DutyPlace& place) {
  using summary::number;
  using summary::number_or_none;
  using summary::object;
  summary::Json by_block = summary::Json::object();
  for (std::size_t b = 0; b < place.blocks.size(); ++b)
    by_block[duty.blocks[b].name] =
        object({{"amplitude_Pa", number(place.blocks[b].amplitude_Pa)},
                {"damage_per_hour", number(place.blocks[b].damage_per_s * hour_s)},
                {"start_amplitude_Pa", number(place.blocks[b].start_amplitude_Pa)},
                {"starts_damage_per_hour", number(place.blocks[b].starts_per_s * hour_s)}});
  return object(
      {{"feature", place.feature},
       {"weld_toe", place.is_weld},
       {"position_m", place.position_m},
       {"damage_per_hour", number(place.damage_per_s * hour_s)},
       {"life_h", number_or_none(or_infinite(place.life_s) / hour_s)},
       {"life_days", number_or_none(or_infinite(place.life_s) / hour_s / day_h / duty.in_operation)},
       {"life_range_h", life_range_json(place.certainty)},
       {"beyond_sn_curve", beyond_json(place.certainty)},
       {"life_safety", number_or_none(or_infinite(place.life_safety))},
       {"life_safety_least", least_safety_json(or_infinite(place.life_safety), place.error_share)},
       {"stress_error", number_or_none(place.error_share)},
       {"by_block", by_block},
       {"effect_share_of_damage", effect_shares_json(duty.effects.at(body), place.effect_share)}});
}

}  // namespace

void print_duty(std::ostream& out, const DutyResult& duty) {
  print_blocks(out, duty);
  print_places(out, duty);
  print_bearings(out, duty);
}

summary::Json duty_json(const DutyResult& duty) {
  using summary::figure;
  using summary::number;
  using summary::number_or_none;
  using summary::object;
  summary::Json json;
  json["in_operation"] = number(duty.in_operation);
  if (!duty.places.empty()) json["rule"] = rule_of_lives();
  for (const auto& block : duty.blocks) {
    auto& entry = json["blocks"][block.name];
    entry = object({{"share", number(block.share)},
                    {"starts_per_day", number(block.starts_per_day)},
                    {"start_transient", block.has_transient},
                    {"bodies", summary::Json::object()}});
    for (const auto& stress : block.stresses)
      entry["bodies"][stress.body] = object({{"von_mises", figure(stress.value_Pa, "Pa")},
                                             {"time_sampling", figure(stress.sampling_error_Pa, "Pa")},
                                             {"feature", stress.feature},
                                             {"weld_toe", stress.is_hot_spot},
                                             {"safety", number_or_none(stress.safety)}});
    for (const auto& bearing : block.bearings)
      entry["bearings"][bearing.name] =
          object({{"equivalent_load", figure(bearing.equivalent_load_N, "N")},
                  {"L10h", bearing.life ? figure(bearing.life->hours, "h") : summary::Json(nullptr)}});
  }
  for (const auto& [body, places] : duty.places)
    for (const auto& place : places) json["places"][body].push_back(place_json(duty, body, place));
  for (const auto& bearing : duty.bearings)
    json["bearings"][bearing.name] =
        object({{"equivalent_load", figure(bearing.equivalent_load_N, "N")},
                {"L10h", bearing.life_h ? figure(*bearing.life_h, "h") : summary::Json(nullptr)},
                {"modified_life",
                 bearing.modified_life_h ? figure(*bearing.modified_life_h, "h") : summary::Json(nullptr)}});
  return json;
}

void write_duty(const std::filesystem::path& file, const DutyResult& duty) {
  std::vector<std::string> bodies, features, kinds, lives, least, most;
  std::vector<double> damage;
  std::array<std::vector<double>, 3> position;
  std::vector<std::string> effects;  // of all bodies
  for (const auto& [body, own] : duty.effects)
    for (const auto& effect : own)
      if (!contains(effects, effect)) effects.push_back(effect);
  std::vector<std::vector<double>> shares;
  std::vector<std::vector<double>> running(duty.blocks.size()), starts(duty.blocks.size());
  for (const auto& [body, places] : duty.places)
    for (const auto& place : places) {
      bodies.push_back(body);
      auto& row = shares.emplace_back();
      if (!place.effect_share.empty()) row.assign(effects.size(), 0.0);
      for (std::size_t e = 0; e < place.effect_share.size(); ++e)
        row[std::size_t(std::find(effects.begin(), effects.end(), duty.effects.at(body)[e]) -
                        effects.begin())] = place.effect_share[e];
      features.push_back(place.feature);
      kinds.push_back(place.is_weld ? "weld toe" : "surface");
      damage.push_back(place.damage_per_s * hour_s);
      lives.push_back(place.life_s ? shortest(*place.life_s / hour_s) : std::string());
      least.push_back(life_cell(place.certainty, &LifeRange::least_s));
      most.push_back(life_cell(place.certainty, &LifeRange::most_s));
      for (std::size_t d = 0; d < 3; ++d) position[d].push_back(place.position_m[d]);
      for (std::size_t b = 0; b < duty.blocks.size(); ++b) {
        running[b].push_back(place.blocks[b].damage_per_s * hour_s);
        starts[b].push_back(place.blocks[b].starts_per_s * hour_s);
      }
    }
  std::vector<CsvColumn> columns{{"body", "", bodies},     {"feature", "", features},
                                 {"kind", "", kinds},      {"damage_per_hour", "1/h", damage},
                                 {"life", "h", lives},     {"life_least", "h", least},
                                 {"life_most", "h", most}, {"x", "m", position[0]},
                                 {"y", "m", position[1]},  {"z", "m", position[2]}};
  for (std::size_t b = 0; b < duty.blocks.size(); ++b) {
    columns.push_back({duty.blocks[b].name + ".running", "1/h", running[b]});
    if (duty.blocks[b].starts_per_day > 0)
      columns.push_back({duty.blocks[b].name + ".starts", "1/h", starts[b]});
  }
  add_damage_shares(columns, effects, shares);
  write_csv(file, columns);
}

}  // namespace pipelines

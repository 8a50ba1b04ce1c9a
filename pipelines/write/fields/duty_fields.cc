#include "pipelines/write/fields/duty_fields.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "pipelines/judge/texts/damage_share_text.h"
#include "pipelines/judge/texts/life_text.h"

namespace pipelines {
namespace {

using summary::Json, summary::number, summary::number_or_none;

constexpr double hour_s = 3600, day_h = 24;

double or_none(const std::optional<double>& value) {
  return value.value_or(std::numeric_limits<double>::infinity());
}

double largest_amplitude_Pa(const DutyPlace& place) {
  double amplitude_Pa = 0;
  for (const auto& block : place.blocks)
    amplitude_Pa = std::max({amplitude_Pa, block.amplitude_Pa, block.start_amplitude_Pa});
  return amplitude_Pa;
}

/// "coarse 80 %, starts of fine 15 %": the shares of the damage, the largest first.
std::string damage_by(const DutyPlaceRow& r) {
  if (!(r.place.damage_per_s > 0)) return "no damage";
  std::vector<std::pair<double, std::string>> causes;
  for (std::size_t b = 0; b < r.place.blocks.size(); ++b) {
    causes.emplace_back(r.place.blocks[b].damage_per_s, r.duty.blocks[b].name);
    causes.emplace_back(r.place.blocks[b].starts_per_s, "starts of " + r.duty.blocks[b].name);
  }
  std::stable_sort(causes.begin(), causes.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, causes.size()); ++i)
    if (const double share = causes[i].first / r.place.damage_per_s; share >= 0.005)
      text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", causes[i].second, 100 * share);
  return text;
}

Json by_block(const DutyPlaceRow& r) {
  Json blocks = Json::object();
  for (std::size_t b = 0; b < r.place.blocks.size(); ++b) {
    const auto& block = r.place.blocks[b];
    blocks[r.duty.blocks[b].name] =
        summary::object({{"amplitude_Pa", number(block.amplitude_Pa)},
                         {"damage_per_hour", number(block.damage_per_s * hour_s)},
                         {"start_amplitude_Pa", number(block.start_amplitude_Pa)},
                         {"starts_damage_per_hour", number(block.starts_per_s * hour_s)}});
  }
  return blocks;
}

/// Damage by "<block>.running", and by "<block>.starts" where a block has some.
Json damage_of_blocks(const DutyPlaceRow& r) {
  Json damage = Json::object();
  for (std::size_t b = 0; b < r.place.blocks.size(); ++b) {
    const auto& block = r.duty.blocks[b];
    damage[block.name + ".running"] = number(r.place.blocks[b].damage_per_s * hour_s);
    if (block.starts_per_day > 0)
      damage[block.name + ".starts"] = number(r.place.blocks[b].starts_per_s * hour_s);
  }
  return damage;
}

Json hours_figure(const std::optional<double>& hours) {
  return hours ? summary::figure(*hours, "h") : Json(nullptr);
}

Json bearings_of(const BlockResult& block) {
  Json bearings;
  for (const auto& bearing : block.bearings)
    bearings[bearing.name] =
        summary::object({{"equivalent_load", summary::figure(bearing.equivalent_load_N, "N")},
                         {"L10h", bearing.life ? summary::figure(bearing.life->hours, "h") : Json(nullptr)}});
  return bearings;
}

}  // namespace

FieldTable<DutyPlaceRow> duty_place_fields() {
  using Row = DutyPlaceRow;
  using Field = FieldOf<Row>;
  const FieldTable<Row> place{
      Field("body", quantities::text, "name of the body", [](const Row& r) { return r.body; })
          .without_summary(),
      {"feature", quantities::text, "surface of the place, or weld toe", "place",
       [](const Row& r) { return r.place.feature; }},
      Field("kind", quantities::text, "`surface` or `weld toe`",
            [](const Row& r) { return r.place.is_weld ? "weld toe" : "surface"; })
          .without_summary(),
      Field("weld_toe", quantities::flag, "whether it is one", "weld toe",
            [](const Row& r) { return r.place.is_weld; })
          .without_csv(),
      {"position", quantities::position, "of the worst node, or of the toe",
       [](const Row& r) { return r.place.position_m; }},
      {"amplitude", quantities::stress, "the largest of all blocks and starts", "amplitude",
       [](const Row& r) { return number(largest_amplitude_Pa(r.place)); }},
      {"damage_per_hour", quantities::per_hour, "of operation, of all blocks and starts", "damage",
       [](const Row& r) { return number(r.place.damage_per_s * hour_s); }},
  };
  const auto life = life_fields<Row>([](const Row& r) { return r.place.life_s; },
                                     [](const Row& r) { return r.place.certainty; });
  const FieldTable<Row> others{
      Field("life_days", quantities::count, "with standstill; null: endures",
            [](const Row& r) {
              return number_or_none(or_none(r.place.life_s) / hour_s / day_h / r.duty.in_operation);
            })
          .without_csv(),
      Field("life_safety", quantities::ratio,
            "against the wanted life, beyond the safety factor: a factor on all stresses", "safety (least)",
            [](const Row& r) { return number_or_none(or_none(r.place.life_safety)); })
          .shown_as([](const Json& row) { return safety_of_row(row, "life_safety", "life_safety_least"); }),
      {"life_safety_least", quantities::ratio, "what the whole error leaves of it",
       [](const Row& r) { return least_safety_json(or_none(r.place.life_safety), r.place.error_share); }},
      {"stress_error", quantities::percent, "whole error of the stress; empty: not known",
       [](const Row& r) { return number_or_none(r.place.error_share); }},
      {"damage_by", quantities::text, "blocks and starts that bring most of it", "damage by", damage_by},
      {"by_block", quantities::structure, "amplitude and damage of each block and its starts", by_block},
      Field("damage_of", quantities::per_hour_by_name, "damage of each block's running and starts",
            damage_of_blocks)
          .in_column("")
          .without_summary(),
      Field("effect_share_of_damage", quantities::percentages, "by effect",
            [](const Row& r) { return effect_shares_json(r.duty.effects.at(r.body), r.place.effect_share); })
          .in_column("damage_share_"),
  };
  return joined(joined(place, life), others);
}

FieldTable<BlockResult> block_fields() {
  using Field = FieldOf<BlockResult>;
  return without_csv<BlockResult>({
      Field("share", quantities::percent, "of all time", "share", &BlockResult::share).digits("{:.4g}"),
      Field("starts_per_day", quantities::count, "of all time, standstill included", "starts a day",
            &BlockResult::starts_per_day)
          .digits("{:.4g}"),
      {"start_transient", quantities::flag,
       "a start is followed over time; else it is from rest to running at once", "with transient",
       &BlockResult::has_transient},
      {"bearings", quantities::structure, "equivalent load and L10h of each", bearings_of},
  });
}

FieldTable<BlockStress> block_stress_fields() {
  using Field = FieldOf<BlockStress>;
  return without_csv<BlockStress>({
      {"von_mises", as_figure(quantities::stress), "outside the exclusion distances, or at a weld toe",
       "largest stress", [](const auto& s) { return summary::figure(s.value_Pa, "Pa"); }},
      Field("time_sampling", as_figure(quantities::stress),
            "by how much it may be larger between the instants", "between instants",
            [](const auto& s) { return summary::figure(s.sampling_error_Pa, "Pa"); })
          .digits("{:.2g}"),
      {"safety", quantities::ratio, "yield strength over it", "safety",
       [](const auto& s) { return number_or_none(s.safety); }},
      {"feature", quantities::text, "where it is", "at", &BlockStress::feature},
      {"weld_toe", quantities::flag, "whether that is one", "weld toe", &BlockStress::is_hot_spot},
  });
}

FieldTable<DutyBearing> duty_bearing_fields() {
  using Field = FieldOf<DutyBearing>;
  return without_csv<DutyBearing>({
      {"equivalent_load", as_figure(quantities::force), "by turns: (sum n P^p / sum n)^(1/p)",
       "equivalent load", [](const auto& b) { return summary::figure(b.equivalent_load_N, "N"); }},
      Field("L10h", as_figure(quantities::hours), "in operation; null: never loaded", "L10",
            [](const auto& b) { return hours_figure(b.life_h); })
          .digits("{:.5g}"),
      Field("modified_life", as_figure(quantities::hours), "likewise, of ISO 281; null: not asked for",
            "modified life", [](const auto& b) { return hours_figure(b.modified_life_h); })
          .digits("{:.5g}"),
  });
}

}  // namespace pipelines

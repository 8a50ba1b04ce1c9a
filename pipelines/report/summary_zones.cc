#include "pipelines/analysis/governing_stress.h"
#include "pipelines/life/body_fatigue.h"
#include "pipelines/report/summary_parts.h"
#include "pipelines/report_parts/fatigue_report.h"
#include "pipelines/report_parts/moment.h"
#include "pipelines/report_parts/zone_text.h"
#include "pipelines/scene_values/effect_groups.h"

namespace pipelines::summary {
namespace {

/// Groups only where one of them has several effects, as of the peak.
Json shares_json(const ChannelHistory& loads, const StressShares& shares) {
  Json json = Json::object();
  for (std::size_t i = 0; i < loads.effects.size(); ++i)
    json["effects"][loads.effects[i]] = number(shares.effects[i]);
  if (any_sums(effect_groups(loads.effects)))
    for (const auto& group : group_shares(loads.effects, shares.effects))
      json["groups"][group.name] = number(group.share);
  for (std::size_t i = 0; i < loads.channels.size(); ++i)
    json["channels"][loads.channels[i].name] = number(shares.channels[i]);
  return json;
}

Json moment_json(const RunReport& report, double instant) {
  const auto moment = moment_between(report.scene, report.loads, instant);
  return object({{"turn", moment.turn}, {"drive_angle_rad", moment.angle_rad}});
}

/// The amplitude has shares where there is one.
Json causes_json(const RunReport& report, const ChannelHistory& loads, const ZoneCauses& causes) {
  Json amplitude = object({{"value_Pa", number(causes.cycle.amplitude_Pa)}});
  if (!causes.amplitude.effects.empty()) {
    amplitude["from"] = moment_json(report, causes.from);
    amplitude["to"] = moment_json(report, causes.to);
    amplitude.update(shares_json(loads, causes.amplitude));
  }
  return object({{"peak", shares_json(loads, causes.peak)}, {"amplitude", amplitude}});
}

/// Of a zone on the surface, where fatigue is asked for; shares where something changes.
Json damage_json(const ChannelHistory& loads, const ZoneDamage& damage) {
  if (!damage.is_on_surface) return nullptr;
  Json json = object({{"damage_per_turn", number(damage.damage_per_turn)},
                      {"life_h", damage.life_s ? number(*damage.life_s / 3600) : Json(nullptr)},
                      {"life_range_h", life_range_json(damage.certainty)},
                      {"beyond_sn_curve", beyond_json(damage.certainty)},
                      {"stress_error", number_or_none(damage.error_share)}});
  if (!damage.shares.effects.empty()) json.update(shares_json(loads, damage.shares));
  return json;
}

Json part_json(const RunReport& report, const ZonePart& part) {
  Json json = object({{"zone", part.number},
                      {"level_Pa", number(part.level_Pa)},
                      {"peak_von_mises_Pa", number(part.peak_Pa)},
                      {"nodes", part.n_nodes}});
  json.update(place_and_moment(report, part.peak_m, part.feature, part.place, part.instant));
  return json;
}

}  // namespace

Json zones_json(const RunReport& report, const BodyAnalysis& analysis) {
  Json json = Json::array();
  for (const Zone& zone : analysis.zones.zones) {
    const auto error = error_Pa(analysis, zone);
    Json entry = object(
        {{"peak_von_mises_Pa", number(zone.peak_Pa)},
         {"error_Pa", error ? number_or_none(*error) : Json(nullptr)},
         {"safety_against_yield", number_or_none(zone.safety)},
         {"volume_m3", number_or_none(zone.volume_m3)},
         {"volume_error_m3", zone.volume_error_m3 ? number_or_none(*zone.volume_error_m3) : Json(nullptr)},
         {"nodes", zone.n_nodes}});
    entry.update(place_and_moment(report, zone.peak_m, zone.feature, zone.place, zone.instant));
    if (json.size() < analysis.zone_causes.size())
      entry["causes"] = causes_json(report, analysis.loads.history, analysis.zone_causes[json.size()]);
    if (analysis.fatigue && json.size() < analysis.fatigue->zones.size() && entry.contains("causes"))
      entry["causes"]["damage"] = damage_json(analysis.loads.history, analysis.fatigue->zones[json.size()]);
    for (const auto& part : zone.parts) entry["parts"].push_back(part_json(report, part));
    json.push_back(entry);
  }
  return json;
}

}  // namespace pipelines::summary

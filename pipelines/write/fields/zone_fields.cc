#include "pipelines/write/fields/zone_fields.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "pipelines/judge/analysis/error_text.h"
#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/judge/life/body_fatigue.h"
#include "pipelines/judge/stages/shaft_torsion.h"
#include "pipelines/judge/texts/life_text.h"
#include "pipelines/scene/values/effect_groups.h"

namespace pipelines {
namespace {

using summary::figure, summary::Json, summary::number, summary::number_or_none, summary::object;
using ZoneRow = RowOf<Zone>;
using PartRow = RowOf<ZonePart>;
using ToeRow = RowOf<HotSpotStress>;

/// Null without it.
const Json& item_of(const Json& json, const char* key) {
  static const Json none = nullptr;
  return json.is_object() && json.contains(key) ? json.at(key) : none;
}

std::string text_of(const Json& json, const char* key) {
  const auto& text = item_of(json, key);
  return text.is_string() ? text.get<std::string>() : std::string();
}

double number_or_infinite(const Json& value) {
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::infinity();
}

/// "66.1 +- 1.6", "66.1 +- ?" in MPa.
std::string stress_text(const Json& value_Pa, const Json& error_Pa) {
  return value_Pa.is_number() ? with_error(value_Pa.get<double>(), number_or_infinite(error_Pa)) : "-";
}

/// A stress beside its error `<error>_Pa`.
template <typename Row>
FieldOf<Row> beside_error(FieldOf<Row> field, const std::string& label, const char* error) {
  field.label = label + " " + field.quantity.unit;
  return field.shown_as([value = field.json_key(), error = std::string(error) + "_Pa"](const Json& row) {
    return stress_text(item_of(row, value.c_str()), item_of(row, error.c_str()));
  });
}

/// The moment of a row, "turn 4, 30 deg".
std::string moment_of_row(const Json& row) {
  const auto &turn = item_of(row, "turn"), &angle_rad = item_of(row, "drive_angle_rad");
  if (!turn.is_number() || !angle_rad.is_number()) return "-";
  return fmt::format("turn {}, {:.0f} deg", turn.get<int>(), angle_rad.get<double>() * 180 / pi);
}

/// Fields of the moment for rows with an instant.
template <typename Row>
FieldTable<Row> moment_fields() {
  const auto moment = [](const Row& r) { return moment_of(r.body.scene, r.body.loads, r.item.instant); };
  return {FieldOf<Row>("turn", quantities::count, "turn of the drive with the largest stress, from 1",
                       [=](const Row& r) { return moment(r).turn; }),
          FieldOf<Row>("drive_angle", quantities::angle, "within that turn", "moment", [=](const Row& r) {
            return moment(r).angle_rad;
          }).shown_as(moment_of_row)};
}

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

/// Damage of a zone on the surface, where fatigue is asked for; shares where something changes.
Json damage_json(const ChannelHistory& loads, const ZoneDamage& damage) {
  if (!damage.is_on_surface) return nullptr;
  Json json = object({{"damage_per_turn", number(damage.damage_per_turn)},
                      {"life_h", hours_json(damage.life_s)},
                      {"life_range_h", life_range_json(damage.certainty)},
                      {"beyond_sn_curve", beyond_json(damage.certainty)},
                      {"stress_error", number_or_none(damage.error_share)}});
  if (!damage.shares.effects.empty()) json.update(shares_json(loads, damage.shares));
  return json;
}

/// The amplitude has shares where there is one.
Json causes_json(const ZoneRow& r) {
  const auto& analysis = r.body.analysis;
  if (r.index >= analysis.zone_causes.size()) return nullptr;
  const auto& causes = analysis.zone_causes[r.index];
  const auto& loads = analysis.loads.history;
  Json amplitude = object({{"value_Pa", number(causes.cycle.amplitude_Pa)}});
  if (!causes.amplitude.effects.empty()) {
    amplitude["from"] = moment_json(r.body, causes.from);
    amplitude["to"] = moment_json(r.body, causes.to);
    amplitude.update(shares_json(loads, causes.amplitude));
  }
  Json json = object({{"peak", shares_json(loads, causes.peak)}, {"amplitude", amplitude}});
  if (analysis.fatigue && r.index < analysis.fatigue->zones.size())
    json["damage"] = damage_json(loads, analysis.fatigue->zones[r.index]);
  return json;
}

/// " by belt 83 %, drive 17 %" of "causes.peak", "causes.amplitude" or "causes.damage"; empty of one effect.
std::string brought_by(const Json& of) {
  std::vector<NamedShare> shares;
  for (const auto& [name, share] : item_of(of, of.contains("groups") ? "groups" : "effects").items())
    shares.push_back({name, share.get<double>()});
  return shares.size() < 2 ? "" : " by " + largest_shares(std::move(shares));
}

/// What fatigue says of a zone.
std::string damage_of_row(const Json& damage) {
  if (damage.is_null()) return "inside the body or at a weld, where no fatigue of the material is judged";
  if (damage.at("damage_per_turn").get<double>() > 0) {
    const auto by = brought_by(damage);
    return by.empty() ? by : "damage" + by;
  }
  const auto& range = item_of(damage, "life_range_h");
  return range.is_array() && range[0].is_null() ? "no damage" : "no damage by itself, " + life_of_row(damage);
}

/// "zone 1: fillet a/b"; the feature alone in rows that are not counted.
std::string name_of_zone(const Json& zone) {
  const auto feature = text_of(zone, "feature");
  const auto& rank = item_of(zone, "zone");
  return rank.is_number() ? fmt::format("zone {}: {}", rank.get<int>(), feature) : feature;
}

std::string volume_of_row(const Json& zone) {
  const auto &volume = item_of(zone, "volume_m3"), &error = item_of(zone, "volume_error_m3");
  if (!volume.is_number()) return "-";
  return volume_text(volume.get<double>(),
                     error.is_number() ? std::optional(error.get<double>()) : std::nullopt)
      .text();
}

// Headlines.

Json place_and_moment(const BodyResult& body, const std::array<double, 3>& position,
                      const std::string& feature, Place place, std::int32_t instant) {
  Json json = object({{"feature", feature}, {"place", to_string(place)}, {"position_m", position}});
  json.update(moment_json(body, instant));
  return json;
}

/// What the body is judged by.
Json governing_json(const BodyResult& body) {
  const auto& analysis = body.analysis;
  const auto stress = governing_stress(analysis);
  Json json = figure(stress.value_Pa, "Pa");
  json["kind"] = stress.kind == GoverningStress::Kind::hot_spot ? "hot_spot" : "peak_von_mises";
  json["name"] = stress.name();
  json["text"] = value_with_errors(stress.value_Pa, stress.errors);
  json["safety_against_yield"] = number_or_none(stress.safety);
  json["error"] = budget_json(stress.errors);
  json.update(place_and_moment(body, stress.position_m, stress.place, stress.surface, stress.instant));
  if (const auto trouble = not_known_well(stress, analysis.search); !trouble.empty())
    json["not_known_well"] = trouble;
  if (const auto rise = rises_towards_edge(analysis); !rise.empty()) json["rises_towards_edge"] = rise;
  return json;
}

/// A stress at the peak, at its moment.
Json at_peak(const BodyResult& body, double value_Pa) {
  const Peak& peak = body.analysis.peak;
  Json json = figure(value_Pa, "Pa");
  json.update(place_and_moment(body, peak.position_m, peak.feature, peak.place, peak.instant));
  return json;
}

Json peak_json(const BodyResult& body) {
  const Peak& peak = body.analysis.peak;
  Json json = at_peak(body, peak.value_Pa);
  json["error"] = budget_json(peak.errors);
  json["safety_against_yield"] = number_or_none(peak.safety);
  json["stress_Pa"] = peak.stress_Pa;
  const auto& effects = body.analysis.loads.history.effects;
  for (std::size_t i = 0; i < effects.size(); ++i)
    json["effect_share"][effects[i]] = number(peak.effect_share[i]);
  if (any_sums(effect_groups(effects)))
    for (const auto& group : group_shares(effects, peak.effect_share))
      json["effect_group_share"][group.name] = number(group.share);
  return json;
}

Json principal_json(const BodyResult& body) {
  const auto& analysis = body.analysis;
  const std::size_t node = analysis.principal_node;
  const auto& nodes = analysis.responses.nodes;
  const auto& maximum = analysis.envelope.principal;
  std::array<double, 3> position;
  std::copy_n(&nodes.xyz_m[3 * node], 3, position.begin());
  Json json = figure(maximum.value_Pa[node], "Pa");
  json.update(place_and_moment(body, position, feature_at(nodes, analysis.places, node),
                               analysis.places.place[node], maximum.instant[node]));
  json["stress_Pa"] = maximum.stress_Pa[node];
  return json;
}

/// Null where no section diagrams are.
Json torsional_json(const BodyResult& body) {
  const auto& analysis = body.analysis;
  if (!analysis.diagrams) return nullptr;
  const auto* ring = largest_torsion_ring(*analysis.diagrams);
  Json json = figure(ring ? ring->max_Pa : 0.0, "Pa");
  if (ring == nullptr) return json;
  json["error"] = number_or_none(ring_error_Pa(analysis, *ring));
  json["feature"] = ring->feature;
  json["z_m"] = ring->z_m;
  if (is_rounding(analysis, *ring)) json["nothing_twists"] = true;
  return json;
}

/// "17.19 +- 0.04 MPa"; without an error where none is estimated; the figure's own text where it has one.
std::string figure_text(const Json& of) {
  if (const auto text = text_of(of, "text"); !text.empty()) return text;
  if (!of.is_object()) return "-";
  if (of.contains("nothing_twists")) return "none: nothing twists the shaft";
  if (!of.contains("error")) return stress_in_MPa(of.at("value").get<double>(), 0) + " MPa";
  const auto& error = of.at("error");
  return stress_text(of.at("value"), error.is_object() ? item_of(error, "total") : error) + " MPa";
}

/// @param get  a figure, with place and moment
FieldOf<BodyResult> headline(const char* key, const char* label, const char* meaning,
                             Json (*get)(const BodyResult&)) {
  const FieldOf<BodyResult> field(key, quantities::structure, meaning, label, get);
  return field.shown_as([=](const Json& body) { return figure_text(value_of(body, field)); });
}

/// "fillet a/b (free surface), (1.0, 2.0, 3.0) mm", "fillet a/b, z = 38.9 mm"
std::string where_of(const Json& of) {
  auto text = text_of(of, "feature");
  if (const auto place = text_of(of, "place"); !place.empty()) text += " (" + place + ")";
  const auto join = [&](const std::string& more) { text += (text.empty() ? "" : ", ") + more; };
  if (const auto& x = item_of(of, "position_m"); x.is_array())
    join(fmt::format("({:.1f}, {:.1f}, {:.1f}) mm", 1e3 * x.at(0).get<double>(), 1e3 * x.at(1).get<double>(),
                     1e3 * x.at(2).get<double>()));
  if (const auto& z = item_of(of, "z_m"); z.is_number())
    join(fmt::format("z = {:.1f} mm", 1e3 * z.get<double>()));
  return text;
}

}  // namespace

FieldTable<ZoneFigures> zone_figure_fields() {
  using Field = FieldOf<ZoneFigures>;
  return {
      Field("feature", quantities::text, "surface of the peak, or the nearest one", "zone",
            &ZoneFigures::feature)
          .shown_as(name_of_zone),
      {"place", quantities::text,
       "`under seat pressure`, `under the charge's pressure` (a mill's inner wall), `free surface` or "
       "`interior`",
       "surface", &ZoneFigures::place},
      beside_error(Field("peak_von_mises", quantities::stress, "largest in the zone", &ZoneFigures::peak_Pa),
                   "peak", "error"),
      Field("error", quantities::stress,
            "all that a finer mesh or a more expensive model lowers; may be empty beyond the first ten zones",
            [](const ZoneFigures& z) { return number_or_none(z.error_Pa); })
          .in_column("peak_error"),
      {"safety_against_yield", quantities::ratio, "yield strength over the peak", "safety",
       [](const ZoneFigures& z) { return number_or_none(z.safety); }},
      {"position", quantities::position, "of the peak, body frame", "position", &ZoneFigures::peak_m},
      {"nodes", quantities::count, "nodes of the mesh in the zone", &ZoneFigures::n_nodes},
      Field("volume", quantities::volume, "above the level; empty for a beam", "volume mm3",
            [](const ZoneFigures& z) { return number_or_none(z.volume_m3); })
          .shown_as(volume_of_row),
  };
}

FieldTable<ZoneRow> zone_fields() {
  using Field = FieldOf<ZoneRow>;
  const FieldTable<ZoneRow> rank{
      {"zone", quantities::count, "rank by peak, from 1", [](const ZoneRow& r) { return r.index + 1; }}};
  const FieldTable<ZoneRow> volume_error{{"volume_error", quantities::volume,
                                          "numerical: [its estimate](../../judge/README.md#volumes); not "
                                          "below `volume` where the zone may not be there; empty for "
                                          "a beam",
                                          [](const ZoneRow& r) {
                                            return r.item.volume_error_m3
                                                       ? number_or_none(*r.item.volume_error_m3)
                                                       : Json(nullptr);
                                          }}};
  const FieldTable<ZoneRow> others{
      Field("stress", quantities::stress_tensor, "tensor at the peak and moment", of_item(&Zone::stress_Pa))
          .in_column("sigma"),
      Field("causes", quantities::structure, "[what brings it](../../judge/README.md#causes)", causes_json)
          .detail("brought by")
          .shown_as(causes_of_row),
      {"parts", quantities::structure, "as `zone_tree.csv`",
       [](const ZoneRow& r) {
         return r.item.parts.empty() ? Json(nullptr) : summary_rows(zone_part_fields(), r.body, r.item.parts);
       }},
  };
  const auto figures = fields_of_part<ZoneRow>(
      zone_figure_fields(), [](const ZoneRow& r) { return figures_of(r.body.analysis, r.item); });
  return joined(joined(joined(joined(rank, figures), volume_error), moment_fields<ZoneRow>()), others);
}

FieldTable<PartRow> zone_part_fields() {
  const FieldTable<PartRow> peak{
      {"zone", quantities::text,
       "`1`, its parts `1.1`, `1.2` ... at the next level, `1.1.1` ... at the one after that; by peak. A "
       "text: `1.10` is not `1.1`",
       "part", of_item(&ZonePart::number)},
      {"level", quantities::stress, "that all of its nodes reach", "above", of_item(&ZonePart::level_Pa)},
      {"feature", quantities::text, "as in `zones.csv`", "where", of_item(&ZonePart::feature)},
      {"place", quantities::text, "likewise", [](const PartRow& r) { return to_string(r.item.place); }},
      {"peak_von_mises", quantities::stress, "largest in the part", "peak", of_item(&ZonePart::peak_Pa)},
  };
  const FieldTable<PartRow> others{
      {"position", quantities::position, "of the peak", "position", of_item(&ZonePart::peak_m)},
      {"nodes", quantities::count, "nodes of the mesh in the part", of_item(&ZonePart::n_nodes)},
  };
  return joined(joined(peak, moment_fields<PartRow>()), others);
}

FieldTable<ToeRow> hot_spot_fields() {
  using Field = FieldOf<ToeRow>;
  const FieldTable<ToeRow> stress{
      Field("name", quantities::text, "plate and place of the toe", "weld toe", of_item(&HotSpotStress::name))
          .in_column("hot_spot"),
      beside_error(Field("von_mises", quantities::stress, "largest hot-spot stress",
                         of_item(&HotSpotStress::von_mises_Pa))
                       .in_column("von_mises_max"),
                   "von Mises", "error"),
      Field("error", quantities::stress,
            "the first toe's error with what other places may exceed it by; the others' of their mesh, and "
            "what instants, pressure and solver add to the first",
            [](const ToeRow& r) { return number_or_none(error_Pa(r.body.analysis, r.item)); })
          .in_column("von_mises_error"),
  };
  const FieldTable<ToeRow> normal{
      {"normal_max", quantities::stress, "largest across the toe", of_item(&HotSpotStress::max_normal_Pa)},
      {"normal_min", quantities::stress, "least across the toe", of_item(&HotSpotStress::min_normal_Pa)},
      {"normal_range", quantities::stress, "the difference of both, which fatigue counts", "range across",
       [](const ToeRow& r) { return number(r.item.max_normal_Pa - r.item.min_normal_Pa); }},
      {"position", quantities::position, "of the toe, body frame", of_item(&HotSpotStress::toe_m)},
      {"extrapolated_from", quantities::structure,
       "nodes with weights whose stress adds up to the toe's; not of submodels",
       [](const ToeRow& r) -> Json {
         if (r.item.resolved != nullptr) return nullptr;
         Json parts = Json::array();
         const auto& xyz_m = r.body.analysis.responses.nodes.xyz_m;
         for (const auto& part : stress_point(r.item).parts) {
           const double* x_m = &xyz_m[3 * part.node];
           parts.push_back(object({{"position_m", {x_m[0], x_m[1], x_m[2]}}, {"weight", part.weight}}));
         }
         return parts;
       }},
      {"error", quantities::structure, "whole error of the first, by its sources",
       [](const ToeRow& r) {
         return r.index == 0 ? budget_json(r.body.analysis.hot_spot_errors) : Json(nullptr);
       }},
  };
  return joined(joined(stress, moment_fields<ToeRow>()), normal);
}

FieldTable<RowOf<PlaceStress>> place_fields() {
  using Row = RowOf<PlaceStress>;
  return without_csv(FieldTable<Row>{
      {"feature", quantities::text, "surface, weld toe, or `inside`", of_item(&PlaceStress::feature)},
      {"von_mises", quantities::stress, "largest there", of_item(&PlaceStress::value_Pa)},
      {"error", quantities::stress, "all that a finer mesh or a more expensive model lowers",
       [](const Row& r) { return number_or_none(error_Pa(r.body.analysis, r.item)); }},
      {"position", quantities::position, "of the maximum", of_item(&PlaceStress::position_m)},
  });
}

FieldTable<BodyResult> headline_fields() {
  return {
      headline("governing", "governing stress", "what the body is judged by", governing_json),
      headline("peak_von_mises", "peak von Mises stress outside the exclusion distances",
               "largest outside the exclusion distances", peak_json)
          .shown_as([](const Json& body) {
            const bool governs = text_of(item_of(body, "governing"), "kind") == "peak_von_mises";
            return governs ? std::string() : figure_text(item_of(body, "peak_von_mises"));
          }),
      headline("peak_principal", "largest principal stress", "likewise", principal_json),
      headline("torsion.max_shear_stress", "largest torsional stress", "on a ring of the surface",
               torsional_json),
  };
}

ShownRows headline_rows(const Json& body) {
  ShownRows rows{{"", "value", "safety against yield", "where", "when"}, {}};
  for (const auto& field : headline_fields()) {
    const auto& of = value_of(body, field);
    if (!of.is_object()) continue;
    const auto text = shown_value(field, body);
    if (text.empty()) continue;
    const auto name = text_of(of, "name");
    const auto& safety = item_of(of, "safety_against_yield");
    rows.cells.push_back({name.empty() ? field.label : name, text,
                          safety.is_number() ? fixed(safety.get<double>(), 2) : "-", where_of(of),
                          moment_of_row(of)});
  }
  return rows;
}

std::string causes_of_row(const Json& zone) {
  const auto& causes = item_of(zone, "causes");
  if (causes.is_null()) return {};
  auto text = brought_by(causes.at("peak"));
  if (!text.empty()) text = text.substr(1) + "; ";
  const auto& amplitude = causes.at("amplitude");
  if (!amplitude.contains("effects")) return text + "constant over the cycle";
  text +=
      "amplitude " + fixed(amplitude.at("value_Pa").get<double>() / 1e6, 1) + " MPa" + brought_by(amplitude);
  if (!causes.contains("damage")) return text;
  const auto damage = damage_of_row(causes.at("damage"));
  return damage.empty() ? text : text + "; " + damage;
}

Json budget_json(const ErrorBudget& budget) {
  Json json = object({{"total", number_or_none(budget.total_Pa())},
                      {"numerical", number_or_none(budget.numerical_Pa())},
                      {"model", number_or_none(budget.total_Pa() - budget.numerical_Pa())}});
  for (const auto* entries : {&budget.numerical, &budget.model})
    for (const auto& entry : *entries) {
      json[entry.source] = number_or_none(entry.value_Pa);
      json["methods"][entry.source] = entry.method;
    }
  return json;
}

}  // namespace pipelines

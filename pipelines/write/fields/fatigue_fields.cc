#include "pipelines/write/fields/fatigue_fields.h"

#include <fmt/core.h>

#include <cmath>
#include <limits>

#include "pipelines/judge/texts/damage_share_text.h"
#include "pipelines/judge/texts/life_text.h"

namespace pipelines {
namespace {

using summary::Json, summary::number, summary::number_or_none;
using PlaceRow = RowOf<FatiguePlace>;
using WeldRow = RowOf<WeldFatigue>;
using DinRow = RowOf<NominalFatigue>;

constexpr Quantity stress_by_kind{Shape::number, "", "MPa", 1e6, "{:.1f}"};

double or_infinite(const std::optional<double>& value) {
  return value.value_or(std::numeric_limits<double>::infinity());
}

template <typename Row>
Json shares_of_amplitude(const Row& r) {
  return effect_shares_json(r.body.analysis.loads.history.effects, r.item.effect_share);
}

template <typename Row>
Json shares_of_damage(const Row& r) {
  return effect_shares_json(r.body.analysis.loads.history.effects, r.item.damage_share);
}

/// What errors and wanted life make of a life, and who brings the damage.
template <typename Row>
FieldTable<Row> fields_of_life() {
  auto fields = life_fields<Row>([](const Row& r) { return r.item.life_s; },
                                 [](const Row& r) { return r.item.certainty; });
  const FieldTable<Row> others{
      {"life_safety", quantities::ratio,
       "against the wanted life, beyond the safety factor: a factor on all stresses",
       [](const Row& r) { return number_or_none(or_infinite(r.item.life_safety)); }},
      {"life_safety_least", quantities::ratio, "what the whole error leaves of it",
       [](const Row& r) { return least_safety_json(or_infinite(r.item.life_safety), r.item.error_share); }},
      {"stress_error", quantities::percent, "whole error of the stress; empty: not known",
       [](const Row& r) { return number_or_none(r.item.error_share); }},
      {"counted_cycles", quantities::count, "by rainflow in a period",
       [](const Row& r) { return r.item.n_counted; }},
  };
  fields.insert(fields.end(), others.begin(), others.end());
  return fields;
}

/// "12.3 x 1.85": nominal stress and shape factor.
std::string nominal_and_factor(const Json& row, const char* kind) {
  return fmt::format("{:.1f} x {:.2f}", row.at("amplitude_Pa").at(kind).get<double>() / 1e6,
                     row.at("shape_factor").at(kind).get<double>());
}

FieldTable<DinRow> din_kind(const char* kind, double DinTriple::*of) {
  const auto field = [&](const char* what, const Quantity& quantity, const std::string& meaning, auto get,
                         const std::string& title = "") {
    return FieldOf<DinRow>(fmt::format("{}.{}", what, kind), quantity, meaning, title,
                           [=](const DinRow& r) { return number(get(r.item).*of); });
  };
  return {field(
              "amplitude_Pa", stress_by_kind, "nominal", [](const auto& f) { return f.load.amplitude_Pa; },
              std::string(kind) + " MPa x factor")
              .shown_as([=](const Json& row) { return nominal_and_factor(row, kind); }),
          field("mean_Pa", stress_by_kind, "nominal", [](const auto& f) { return f.load.mean_Pa; }),
          field("shape_factor", quantities::ratio, "local over nominal amplitude",
                [](const auto& f) { return f.shape_factor; }),
          field("notch_effect", quantities::ratio, "of DIN 743",
                [](const auto& f) { return f.safety.notch_effect; })};
}

}  // namespace

std::string utilisation_of_row(const Json& row) {
  const auto percent = [&](const char* key) {
    return row.contains(key) && row.at(key).is_number()
               ? fmt::format("{:.1f}%", 100 * row.at(key).get<double>())
               : std::string("-");
  };
  const auto used = percent("utilisation");
  return used == "-" ? used : fmt::format("{} ({})", used, percent("utilisation_most"));
}

FieldTable<PlaceRow> fatigue_fields() {
  using Field = FieldOf<PlaceRow>;
  const auto safety_by = [](const char* rule, const char* title, double SecondOpinions::*of) {
    return Field(std::string("safety_by.") + rule, quantities::ratio,
                 std::string("by ") + title + ", same limit",
                 [=](const PlaceRow& r) { return number_or_none(r.item.others.*of); })
        .in_column(std::string("safety_") + rule)
        .detail(title);
  };
  const FieldTable<PlaceRow> stress{
      {"feature", quantities::text, "surface of the place", "place", of_item(&FatiguePlace::feature)},
      {"place", quantities::text, "kind of surface, as in `zones.csv`",
       [](const PlaceRow& r) { return to_string(r.item.surface); }},
      {"position", quantities::position, "of the worst node, body frame", of_item(&FatiguePlace::position_m)},
      {"amplitude", quantities::stress,
       "half of the von Mises stress of the largest difference of two instants", "amplitude",
       [](const PlaceRow& r) { return number(r.item.cycle.amplitude_Pa); }},
      {"mean", quantities::stress,
       "von Mises stress of the middle of both, with the sign of the normal stresses", "mean",
       [](const PlaceRow& r) { return number(r.item.cycle.signed_mean_Pa); }},
      Field("half_range", quantities::stress_tensor, "half of that difference",
            [](const PlaceRow& r) { return r.item.cycle.half_range_Pa; })
          .without_csv(),
      Field("mean_tensor", quantities::stress_tensor, "middle of both",
            [](const PlaceRow& r) { return r.item.cycle.mean_Pa; })
          .without_csv(),
      Field("from", quantities::moment, "the one instant, as drive angle over all turns",
            [](const PlaceRow& r) { return moment_json(r.body, r.item.from); })
          .in_column("drive_angle_from")
          .detail("from"),
      Field("to", quantities::moment, "the other instant",
            [](const PlaceRow& r) { return moment_json(r.body, r.item.to); })
          .in_column("drive_angle_to")
          .detail("to"),
      {"related_gradient", quantities::related_gradient, "of the amplitude, into the body",
       of_item(&FatiguePlace::gradient_per_m)},
      {"support_factor", quantities::ratio, "n_sigma that the gradient brings",
       of_item(&FatiguePlace::support)},
      {"endurance", quantities::stress, "amplitude that is endured at this mean, before the safety factor",
       "endured", of_item(&FatiguePlace::endurance_Pa)},
      Field("safety_against_endurance", quantities::ratio, "endurance over amplitude; empty: nothing changes",
            "safety (least)", [](const PlaceRow& r) { return number_or_none(r.item.safety); })
          .shown_as(
              [](const Json& row) { return safety_of_row(row, "safety_against_endurance", "safety_least"); }),
      {"safety_least", quantities::ratio, "what the whole error leaves of it",
       [](const PlaceRow& r) { return least_safety_json(r.item.safety, r.item.error_share); }},
      Field("utilisation", quantities::percent,
            "the safety factor over that safety: 100 % is what is allowed", "used (most)",
            of_item(&FatiguePlace::utilisation))
          .shown_as(utilisation_of_row),
      {"utilisation_most", quantities::percent, "what the whole error makes of it",
       [](const PlaceRow& r) { return number_or_none(r.item.utilisation * (1 + r.item.error_share)); }},
      {"damage_per_turn", quantities::count, "of the drive, at the limit over the safety factor",
       of_item(&FatiguePlace::damage_per_turn)},
      {"damage_per_hour", quantities::per_hour, "likewise",
       [](const PlaceRow& r) { return number(r.item.life_s ? seconds_per_hour / *r.item.life_s : 0); }},
      {"life_turns", quantities::count, "turns of the drive; empty: endures",
       [](const PlaceRow& r) {
         return number_or_none(r.item.life_s ? 1 / r.item.damage_per_turn : INFINITY);
       }},
  };
  const FieldTable<PlaceRow> rules{
      safety_by("findley", "Findley", &SecondOpinions::findley),
      safety_by("goodman", "Goodman", &SecondOpinions::goodman),
      safety_by("gerber", "Gerber", &SecondOpinions::gerber),
      safety_by("soderberg", "Soderberg", &SecondOpinions::soderberg),
      Field("effect_share_of_amplitude", quantities::percentages,
            "by effect, in the difference of the two instants", shares_of_amplitude<PlaceRow>)
          .in_column("amplitude_share_"),
      Field("effect_share_of_damage", quantities::percentages, "by effect", shares_of_damage<PlaceRow>)
          .in_column("damage_share_"),
  };
  return joined(joined(stress, fields_of_life<PlaceRow>()), rules);
}

FieldTable<WeldRow> weld_fields() {
  using Field = FieldOf<WeldRow>;
  const FieldTable<WeldRow> stress{
      Field("name", quantities::text, "plate and place of the toe", "weld toe", of_item(&WeldFatigue::name))
          .in_column("toe"),
      {"position", quantities::position, "of the toe, body frame", of_item(&WeldFatigue::toe_m)},
      {"type", quantities::text, "of the weld; empty: the class is the scene's own",
       [](const WeldRow& r) { return r.item.type.empty() ? Json(nullptr) : Json(r.item.type); }},
      {"range", quantities::stress, "largest counted range of the structural or effective notch stress",
       "range", of_item(&WeldFatigue::range_Pa)},
      {"thickness", quantities::length, "of the plate at the toe; null: a notch", "thickness",
       [](const WeldRow& r) { return r.item.thickness_m > 0 ? Json(r.item.thickness_m) : Json(nullptr); }},
      {"thickness_factor", quantities::ratio, "f(t) on the class", "f(t)",
       of_item(&WeldFatigue::thickness_factor)},
      {"thickness_exponent", quantities::ratio, "n of f(t)", of_item(&WeldFatigue::thickness_exponent)},
      {"angle", quantities::angle, "of the governing direction from the toe's normal", "angle",
       of_item(&WeldFatigue::angle_rad)},
      {"principal", quantities::flag, "that direction is a principal one of the range",
       of_item(&WeldFatigue::is_principal)},
      Field("class", quantities::stress, "FAT class of IIW", "FAT", of_item(&WeldFatigue::class_Pa))
          .digits("{:.0f}"),
      {"damage_per_turn", quantities::count, "of the drive", of_item(&WeldFatigue::damage_per_turn)},
  };
  const FieldTable<WeldRow> shares{
      Field("effect_share_of_range", quantities::percentages, "by effect", shares_of_amplitude<WeldRow>)
          .in_column("range_share_"),
      Field("effect_share_of_damage", quantities::percentages, "by effect", shares_of_damage<WeldRow>)
          .in_column("damage_share_"),
  };
  return joined(joined(stress, fields_of_life<WeldRow>()), shares);
}

FieldTable<DinRow> din_743_fields() {
  using Field = FieldOf<DinRow>;
  const FieldTable<DinRow> place{
      {"feature", quantities::text, "the fillet", "DIN 743, nominal stresses: fillet",
       of_item(&NominalFatigue::fillet)},
      {"z", quantities::length, "of the section", of_item(&NominalFatigue::z_m)},
      {"diameter", quantities::length, "of the section", of_item(&NominalFatigue::diameter_m)},
  };
  const FieldTable<DinRow> safety{
      {"stress_error", quantities::percent, "of the shape factors; null: not known", "error of factors",
       [](const DinRow& r) { return number_or_none(r.item.error_share); }},
      Field("safety_against_fatigue", quantities::ratio, "DIN asks for 1.2", "fatigue safety (least)",
            [](const DinRow& r) { return number_or_none(r.item.safety.fatigue); })
          .shown_as([](const Json& row) {
            return safety_of_row(row, "safety_against_fatigue", "safety_against_fatigue_least");
          }),
      {"safety_against_fatigue_least", quantities::ratio, "what the error of the factors leaves of it",
       [](const DinRow& r) {
         return r.item.least_safety ? number_or_none(*r.item.least_safety) : Json(nullptr);
       }},
      {"safety_against_yielding", quantities::ratio, "likewise", "yield safety",
       [](const DinRow& r) { return number_or_none(r.item.safety.yielding); }},
  };
  auto fields = place;
  for (const auto& kind : {din_kind("tension", &DinTriple::tension), din_kind("bending", &DinTriple::bending),
                           din_kind("torsion", &DinTriple::torsion), safety})
    fields = joined(std::move(fields), kind);
  return without_csv(std::move(fields));
}

FieldTable<RankedPlace> ranking_fields() {
  using Field = FieldOf<RankedPlace>;
  const FieldTable<RankedPlace> place{
      {"body", quantities::text, "name of the body", "body", &RankedPlace::body},
      {"feature", quantities::text, "or weld toe", "place", &RankedPlace::feature},
      {"weld_toe", quantities::flag, "whether it is one", "weld toe", &RankedPlace::is_weld},
  };
  const FieldTable<RankedPlace> used{
      Field("utilisation", quantities::percent, "of what is allowed; toes have none", "used (most)",
            [](const RankedPlace& r) { return r.utilisation ? number(*r.utilisation) : Json(nullptr); })
          .shown_as(utilisation_of_row),
      {"utilisation_most", quantities::percent, "what the whole error makes of it",
       [](const RankedPlace& r) {
         return r.utilisation ? number_or_none(*r.utilisation * (1 + r.error_share)) : Json(nullptr);
       }},
  };
  const auto life = life_fields<RankedPlace>(&RankedPlace::life_s, &RankedPlace::certainty);
  return without_csv(joined(joined(place, life), used));
}

}  // namespace pipelines

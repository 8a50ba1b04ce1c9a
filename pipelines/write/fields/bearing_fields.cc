#include "pipelines/write/fields/bearing_fields.h"

#include <fmt/core.h>

#include <optional>
#include <string>

namespace pipelines {
namespace {

using summary::Json, summary::figure, summary::number;

/// @param label  over its column; its key is another word
FieldOf<BearingResult> answer(const char* key, const Quantity& quantity, const char* label,
                              const char* meaning, std::optional<double> BearingAnswers::*of) {
  const std::string unit = quantity.unit;
  return FieldOf<BearingResult>(key, quantity, meaning, label,
                                [=](const BearingResult& b) {
                                  const auto& value = b.answers.*of;
                                  if (!value) return Json(nullptr);
                                  return unit.empty() ? number(*value) : figure(*value, unit);
                                })
      .digits("{:.5g}")
      .optional();
}

}  // namespace

FieldTable<BearingResult> bearing_fields() {
  using Field = FieldOf<BearingResult>;
  return without_csv(FieldTable<BearingResult>{
      {"load", quantities::text, "the force on it", &BearingResult::load},
      {"equivalent_load", as_figure(quantities::force), "by the life law over the cycle", "equivalent load",
       [](const BearingResult& b) { return figure(b.equivalent_load_N, "N"); }},
      {"largest_load", as_figure(quantities::force), "over the cycle", "largest",
       [](const BearingResult& b) { return figure(b.largest_load_N, "N"); }},
      {"speed", as_figure(quantities::angular_speed), "of its shaft",
       [](const BearingResult& b) { return figure(b.speed_rad_s, "rad/s"); }},
      Field("L10", quantities::count, "revolutions that nine in ten reach; null: never loaded", "revolutions",
            [](const BearingResult& b) {
              return b.life ? number(b.life->million_revolutions * 1e6) : Json(nullptr);
            })
          .shown_as([](const Json& row) {
            const auto& turns = row.at("L10");
            return turns.is_number() ? fmt::format("{:.3g}", turns.get<double>()) : "unloaded";
          }),
      Field("L10h", as_figure(quantities::hours), "the same in hours of operation; null: never loaded", "L10",
            [](const BearingResult& b) { return b.life ? figure(b.life->hours, "h") : Json(nullptr); })
          .digits("{:.5g}"),
  });
}

FieldTable<BearingResult> bearing_answer_fields() {
  using A = BearingAnswers;
  const auto hours = as_figure(quantities::hours), force = as_figure(quantities::force);
  return without_csv(FieldTable<BearingResult>{
      answer("reliability", quantities::ratio, "reliability", "that the lives below belong to",
             &A::reliability),
      answer("a1", quantities::ratio, "a1", "factor of ISO 281 for the reliability", &A::a1),
      answer("a_ISO", quantities::ratio, "a_ISO", "factor of ISO 281 for the lubricant", &A::a_iso),
      answer("modified_life", hours, "modified life (ISO 281)", "a1 a_ISO L10h", &A::modified_life_h),
      answer("required_life", hours, "required life", "as the scene has it", &A::required_life_h),
      answer("required_rating", force, "required rating (ISO 281)", "dynamic, with the factors above",
             &A::required_rating_N),
      answer("required_rating_weibull", force, "required rating (Weibull)",
             "dynamic, by the catalogues' law (Shigley)", &A::weibull_rating_N),
      answer("reliability_weibull", quantities::ratio, "reliability at the required life (Weibull)",
             "with which the bearing reaches it, same law", &A::weibull_reliability),
      answer("static_safety", quantities::ratio, "static safety", "static rating over the largest load",
             &A::static_safety),
  });
}

Json bearings_json(const std::vector<BearingResult>& bearings) {
  const auto fields = joined(bearing_fields(), bearing_answer_fields());
  Json json;
  for (const auto& bearing : bearings) json[bearing.name] = summary_row(fields, bearing);
  return json;
}

ShownRows shown_bearings(const Json& bearings) {
  return shown_named_rows("bearing", fields_of(bearing_fields()), bearings);
}

ShownRows shown_bearing_answers(const Json& bearings) {
  return shown_named_rows("bearing", fields_of(bearing_answer_fields()), bearings);
}

}  // namespace pipelines

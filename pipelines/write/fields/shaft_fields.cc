#include "pipelines/write/fields/shaft_fields.h"

#include <fmt/core.h>

#include "pipelines/base/common/statistics.h"
#include "pipelines/base/fields/shown_unit.h"
#include "pipelines/judge/analysis/error_text.h"
#include "pipelines/judge/texts/damage_share_text.h"

namespace pipelines {
namespace {

using summary::Json, summary::figure, summary::number, summary::number_or_none;

FieldTable<SectionRow> plane_fields() {
  return {
      {"z", quantities::length, "of the plane", [](const auto& r) { return r.section.plane.z_m; }},
      {"segment", quantities::text, "of the contour", [](const auto& r) { return r.section.plane.segment; }},
      {"diameter", quantities::length, "of the plane",
       [](const auto& r) { return 2 * r.section.plane.radius_m; }},
  };
}

/// Largest over the cycle of the length of rows (r, r + 1).
double largest_pair(const SectionHistory& history, Eigen::Index row) {
  return history.middleRows<2>(row).matrix().colwise().stableNorm().maxCoeff();
}

double longest(const Eigen::Array2Xd& over_the_cycle) {
  return over_the_cycle.matrix().colwise().stableNorm().maxCoeff();
}

FieldTable<SectionRow> extremes_of_torque(const std::string& ending, const std::string& meaning,
                                          SectionHistory SectionResult::*by) {
  return {
      {"V_max" + ending, quantities::force, "largest shear force over the cycle" + meaning,
       [=](const auto& r) { return largest_pair(r.section.*by, 0); }},
      {"M_max" + ending, quantities::torque, "largest bending moment" + meaning,
       [=](const auto& r) { return largest_pair(r.section.*by, 3); }},
      {"T_max" + ending, quantities::torque, "largest torque" + meaning,
       [=](const auto& r) { return (r.section.*by).row(5).maxCoeff(); }},
      {"T_min" + ending, quantities::torque, "least torque" + meaning,
       [=](const auto& r) { return (r.section.*by).row(5).minCoeff(); }},
  };
}

/// A resultant, or a component of the deflection, at the instant of the peak.
template <typename Component>
FieldOf<SectionRow> at_peak(const std::string& name, const Quantity& quantity, const Component& component) {
  return {name + "_at_peak", quantity, "at the instant of the peak",
          [=](const SectionRow& r) { return double(component(r.section)[r.instant]); }};
}

using SectionSeries = Eigen::ArrayXd (*)(const SectionResult&);

FieldTable<SectionRow> over_the_cycle(const std::string& name, const Quantity& quantity,
                                      const std::string& meaning, SectionSeries series) {
  return {
      {name + "_max", quantity, meaning + ", largest over the cycle",
       [=](const auto& r) { return series(r.section).maxCoeff(); }},
      {name + "_min", quantity, "least", [=](const auto& r) { return series(r.section).minCoeff(); }},
      {name + "_mean", quantity, "mean", [=](const auto& r) { return series(r.section).mean(); }},
      {name + "_rms", quantity, "root mean square",
       [=](const auto& r) { return root_mean_square(series(r.section)); }},
  };
}

constexpr Quantity own_unit{Shape::number, "", "", 1, "{:.4g}"};
constexpr Quantity torque_part{Shape::number, "", "N m", 1, "{:.4g}"};
constexpr Quantity stress_part{Shape::number, "", "MPa", 1e6, "{:.4g}"};

/// Titles for people; empty: they do not see it.
struct CourseTitles {
  const char *mean = "", *amplitude = "", *largest = "";
};

/// A course in an object of its own, "torque.mean"; without a course there are no keys.
template <typename CourseOf>
FieldTable<ElementTorsion> course_fields(const std::string& key, const Quantity& quantity,
                                         const std::string& meaning, const CourseTitles& titles,
                                         const CourseOf& course_of) {
  const auto part = [&](const char* name, const char* title, const std::string& what, double Course::*of) {
    return FieldOf<ElementTorsion>(key + name, quantity, what, title,
                                   [=](const ElementTorsion& e) {
                                     const Course* course = course_of(e);
                                     return course != nullptr ? number(course->*of) : Json(nullptr);
                                   })
        .optional();
  };
  const std::string si_unit = quantity.one == 1 ? quantity.unit : "Pa";
  return {part(".mean", titles.mean, meaning + ", static part", &Course::mean),
          part(".amplitude", titles.amplitude, "oscillating part, half of the range", &Course::amplitude),
          part(".largest", titles.largest, "largest size", &Course::largest),
          FieldOf<ElementTorsion>(key + ".unit", quantities::text, "of the three", [=](const auto& e) {
            return course_of(e) != nullptr ? Json(si_unit) : Json(nullptr);
          }).optional()};
}

std::string place_of_ring(const Json& row) {
  return row.contains("z_m") ? fmt::format("{}, z = {:.1f} mm", row.at("feature").get<std::string>(),
                                           1e3 * row.at("z_m").get<double>())
                             : row.value("feature", "-");
}

/// "fillet a/b, safety against yield 2.31", "fillet a/b, z = 30.0 mm", "at bearing_1"
std::string place_of_start(const Json& row) {
  if (row.contains("port")) return "at " + row.at("port").get<std::string>();
  const auto safety = row.value("safety_against_yield", Json(nullptr));
  return place_of_ring(row) +
         (safety.is_number() ? ", safety against yield " + fixed(safety.get<double>(), 2) : "");
}

/// Figure of a start with the unit that people read, "12.5 N m".
std::string figure_of_start(const Json& row, const char* key) {
  const auto shown = shown_unit(row.at("unit").get<std::string>());
  return fmt::format("{:.4g} {}", row.at(key).get<double>() / shown.one, shown.unit);
}

/// Largest of a start with its unit, and the error where there is one, "105.2 +- 3.4 MPa".
std::string largest_of_start(const Json& row) {
  if (!row.contains("error")) return figure_of_start(row, "value");
  const auto& error = row.at("error");
  return with_error(row.at("value").get<double>(), error.is_number() ? error.get<double>() : INFINITY) +
         " MPa";
}

}  // namespace

FieldTable<SectionRow> section_fields() {
  const FieldTable<SectionRow> normal{
      {"N_max", quantities::force, "largest normal force over the cycle",
       [](const auto& r) { return r.section.by_stress.row(2).abs().maxCoeff(); }}};
  const FieldTable<SectionRow> axis{
      {"deflection_max", quantities::length,
       "of the axis, against the line through the bearings (the clamp; the body's mean motion)",
       [](const auto& r) { return longest(r.section.deflection_m); }},
      {"slope_max", quantities::angle, "rotation of the section, without the angle of shear; likewise",
       [](const auto& r) { return longest(r.section.slope_rad); }},
  };
  FieldTable<SectionRow> peak;
  const std::pair<const char*, const Quantity&> resultants[] = {
      {"Vx", quantities::force},  {"Vy", quantities::force},  {"N", quantities::force},
      {"Mx", quantities::torque}, {"My", quantities::torque}, {"T", quantities::torque}};
  for (Eigen::Index c = 0; c < 6; ++c)
    peak.push_back(at_peak(resultants[c].first, resultants[c].second,
                           [=](const SectionResult& s) { return s.by_stress.row(c); }));
  for (Eigen::Index c = 0; c < 2; ++c)
    peak.push_back(at_peak(c == 0 ? "deflection_x" : "deflection_y", quantities::length,
                           [=](const SectionResult& s) { return s.deflection_m.row(c); }));
  auto fields = plane_fields();
  for (const auto& part :
       {normal, extremes_of_torque("", "", &SectionResult::by_stress),
        extremes_of_torque("_statics", " by statics of the loads alone", &SectionResult::by_statics), axis,
        peak})
    fields = joined(std::move(fields), part);
  return fields;
}

FieldTable<SectionRow> torsion_fields() {
  auto fields = plane_fields();
  fields.push_back({"plain", quantities::flag, "half a diameter or more from both ends of its segment",
                    [](const SectionRow& r) { return r.section.plane.plain; }});
  for (const auto& part :
       {over_the_cycle(
            "torque", quantities::torque, "integral of the stress",
            [](const SectionResult& s) -> Eigen::ArrayXd { return s.by_stress.row(5).transpose(); }),
        over_the_cycle("torsional_stress", quantities::stress, "mean of sigma_theta_z around the rim",
                       [](const SectionResult& s) { return s.torsion_Pa; }),
        over_the_cycle("torsional_stress_beam", quantities::stress, "T r / I_p",
                       [](const SectionResult& s) { return s.beam_torsion_Pa; })})
    fields = joined(std::move(fields), part);
  return fields;
}

FieldTable<SeatMotion> seat_fields() {
  using Field = FieldOf<SeatMotion>;
  return without_csv(FieldTable<SeatMotion>{
      {"z", quantities::length, "of its middle", &SeatMotion::z_m},
      Field("max_deflection", quantities::length, "of the axis, as in `diagrams.csv`", "deflection",
            &SeatMotion::max_deflection_m)
          .digits("{:.4f}"),
      Field("max_slope", quantities::angle, "likewise", "slope", &SeatMotion::max_slope_rad).digits("{:.4f}"),
  });
}

FieldTable<ElementTorsion> element_torque_fields() {
  using Field = FieldOf<ElementTorsion>;
  const FieldTable<ElementTorsion> port{
      {"port", quantities::text, "on the shaft", "at port", [](const auto& e) { return e.port; }}};
  const FieldTable<ElementTorsion> difference{
      Field("largest_difference", as_figure(quantities::torque), "of both, over the cycle", "difference",
            [](const auto& e) { return figure(e.largest_difference_Nm, "N m"); })
          .digits("{:.2g}")};
  auto fields = port;
  for (const auto& part :
       {course_fields("torque", torque_part, "on the shaft, counter-clockwise",
                      {"mean", "amplitude", "largest"}, [](const ElementTorsion& e) { return &e.torque; }),
        course_fields("torque_by_stress", torque_part, "by the stress field", {"", "", "by stress field"},
                      [](const ElementTorsion& e) { return &e.by_stress; }),
        difference,
        course_fields("nominal_stress_at_port", stress_part, "T r / I_p in the port's segment", {},
                      [](const ElementTorsion& e) { return &e.nominal; })})
    fields = joined(std::move(fields), part);
  return without_csv(std::move(fields));
}

FieldTable<ElementTorsion> element_stress_fields() {
  using Field = FieldOf<ElementTorsion>;
  const FieldTable<ElementTorsion> place{
      Field("largest_stress.feature", quantities::text, "of the ring", "where",
            [](const auto& e) { return e.largest ? Json(e.largest->ring.feature) : Json(nullptr); })
          .shown_as(
              [](const Json& row) { return place_of_ring(row.value("largest_stress", Json::object())); })
          .optional(),
      Field("largest_stress.z", quantities::length, "of the ring",
            [](const auto& e) { return e.largest ? number(e.largest->ring.z_m) : Json(nullptr); })
          .optional(),
  };
  const FieldTable<ElementTorsion> factor{
      Field("largest_stress.factor", quantities::ratio, "largest over nominal stress at that instant", "K_ts",
            [](const auto& e) { return e.largest ? number(e.largest->factor) : Json(nullptr); })
          .optional()};
  auto fields = course_fields(
      "largest_stress", stress_part, "torsional stress at the ring stressed most of those next to the port",
      {"static", "oscillating", "largest"},
      [](const ElementTorsion& e) { return e.largest ? &e.largest->stress : nullptr; });
  for (const auto& part :
       {place,
        course_fields("largest_stress.nominal", stress_part, "T r / I_p there", {"", "", "nominal T r/I_p"},
                      [](const ElementTorsion& e) { return e.largest ? &e.largest->nominal : nullptr; }),
        factor})
    fields = joined(std::move(fields), part);
  return without_csv(std::move(fields));
}

FieldTable<StartUpRow> start_up_fields() {
  using Field = FieldOf<StartUpRow>;
  return without_csv(FieldTable<StartUpRow>{
      Field("value", own_unit, "largest over the start; a torque with its sign", "largest",
            [](const auto& r) { return number(r.figure.largest); })
          .shown_as(largest_of_start),
      {"unit", quantities::text, "of both values", &StartUpRow::unit},
      {"time", quantities::time, "from standstill", "at",
       [](const auto& r) { return number(r.figure.time_s); }},
      Field("steady", own_unit, "largest size in steady running", "steady",
            [](const auto& r) { return number(r.figure.steady); })
          .shown_as([](const Json& row) { return figure_of_start(row, "steady"); }),
      {"factor", quantities::ratio, "of both; null: nothing in steady running", "factor",
       [](const auto& r) { return r.figure.steady > 0 ? number_or_none(r.figure.factor()) : Json(nullptr); }},
      Field("feature", quantities::text, "where", "where",
            [](const auto& r) {
              return r.element ? Json(nullptr) : Json(r.peak ? r.peak->feature : r.ring->feature);
            })
          .shown_as(place_of_start)
          .optional(),
      Field("z", quantities::length, "of the ring",
            [](const auto& r) { return r.ring ? number(r.ring->z_m) : Json(nullptr); })
          .optional(),
      Field("port", quantities::text, "on the shaft",
            [](const auto& r) { return r.element ? Json(r.element->port) : Json(nullptr); })
          .optional(),
  });
}

FieldTable<StartUpRow> start_up_peak_fields() {
  return without_csv(FieldTable<StartUpRow>{
      {"place", quantities::text, "kind of surface, as in `zones.csv`",
       [](const auto& r) { return to_string(r.peak->place); }},
      {"position", quantities::position, "body frame", [](const auto& r) { return r.peak->position_m; }},
      {"safety_against_yield", quantities::ratio, "yield strength over it; null: no stress",
       [](const auto& r) { return number_or_none(r.peak->safety); }},
      {"error", own_unit, "numerical, by the share known of that place in steady running; null: not known",
       [](const auto& r) { return number_or_none(r.peak->error_share * r.figure.largest); }},
      {"effect_share", quantities::percentages, "of that stress, by effect",
       [](const auto& r) { return effect_shares_json(r.peak->effects, r.peak->effect_share); }},
  });
}

}  // namespace pipelines

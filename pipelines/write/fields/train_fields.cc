#include "pipelines/write/fields/train_fields.h"

#include <fmt/core.h>

#include <cmath>

namespace pipelines {
namespace {

using summary::Json, summary::number_or_none;

/// Near a natural frequency, or felt; of older results all do.
bool matters(const Json& margin) {
  return std::abs(margin.at("margin").get<double>()) <= near_resonance ||
         margin.value("torque_share", 1.0) >= felt_torque_share;
}

}  // namespace

FieldTable<TrainMode> train_mode_fields() {
  using Field = FieldOf<TrainMode>;
  auto frequency = quantities::turning_frequency;
  frequency.suffix = "";
  return without_csv(FieldTable<TrainMode>{
      {"value", frequency, "in rad/s", "natural frequency", &TrainMode::frequency_rad_s},
      {"unit", quantities::text, "of the value", [](const auto&) { return "rad/s"; }},
      Field("softest", quantities::text, "of its potential energy, on the terminal alone",
            "most of its potential energy", &TrainMode::softest)
          .without_summary()
          .optional(),
  });
}

FieldTable<ElementTorque> train_element_fields() {
  using Field = FieldOf<ElementTorque>;
  return without_csv(FieldTable<ElementTorque>{
      {"mean_torque", quantities::torque, "on the shaft of its first inertia", "mean",
       &ElementTorque::mean_Nm},
      {"largest_torque", quantities::torque, "largest size over the window", "largest",
       &ElementTorque::largest_Nm},
      {"largest_reduced_torque", quantities::torque, "the same on the reference shaft", "on reference",
       &ElementTorque::largest_reduced_Nm},
      Field("largest_shear_stress", quantities::stress, "K_t T r / I_p; 0 where no diameter is given",
            "shear MPa", &ElementTorque::largest_shear_Pa)
          .shown_as([](const Json& row) {
            const double stress_Pa = row.at("largest_shear_stress_Pa").get<double>();
            return stress_Pa > 0 ? fmt::format("{:.4g}", stress_Pa / 1e6) : "-";
          }),
  });
}

FieldTable<LineMargin> margin_fields() {
  using Field = FieldOf<LineMargin>;
  return {
      {"excitation", quantities::text, "name and order, or frequency", "excitation",
       [](const LineMargin& m) { return line_name(m.line); }},
      {"frequency", quantities::turning_frequency, "of the excitation", "frequency",
       [](const LineMargin& m) { return m.line.frequency_rad_s; }},
      {"mode", quantities::count, "with the natural frequency nearest to it", "mode", &LineMargin::mode},
      {"natural_frequency", quantities::turning_frequency, "of that mode", "natural",
       &LineMargin::natural_frequency_rad_s},
      {"margin", quantities::percent, "by which the excitation is above it", "margin", &LineMargin::margin},
      {"damping_ratio", quantities::ratio, "of that mode", &LineMargin::damping_ratio},
      {"torque_share", quantities::percent,
       "the torque's amplitude at this frequency over the element's largest torque, where that is most",
       "of the torque", &LineMargin::torque_share},
      Field("amplification", quantities::ratio, "with the mode's damping; null: infinite", "amplification",
            [](const LineMargin& m) { return number_or_none(m.amplification); })
          .digits("{:.3g}"),
  };
}

Json train_elements_json(const TorsionReport& report) {
  auto json = Json::object();
  for (const auto& torque : report.torques)
    json[torque.element] = summary_row(train_element_fields(), torque);
  return json;
}

Json margins_json(const TorsionReport& report) {
  return summary_rows(margin_fields(), report.margins);
}

ShownRows shown_margins(const Json& margins, bool all) {
  auto rows = Json::array();
  for (const auto& m : margins)
    if (all || rows.empty() || matters(m)) rows.push_back(m);
  return shown_rows(fields_of(margin_fields()), rows, rows.size());
}

std::string margins_left_out(std::size_t n_margins, std::size_t n_shown) {
  if (n_shown == n_margins) return "";
  return fmt::format(
      "and {} more, farther than {:g} % from a natural frequency and below {:g} % of every torque",
      n_margins - n_shown, 100 * near_resonance, 100 * felt_torque_share);
}

std::string line_name(const kinetics::ExcitationLine& line) {
  const std::string of = line.order > 0 ? fmt::format("order {:g}", line.order)
                                        : fmt::format("{:g} Hz", line.frequency_rad_s / (2 * pi));
  return line.excitation.empty() ? of : line.excitation + ", " + of;
}

}  // namespace pipelines

#include "pipelines/report_parts/shaft_torsion_report.h"

#include <fmt/core.h>

#include <cmath>
#include <ostream>

#include "pipelines/analysis/error_text.h"
#include "pipelines/body_stages/shaft_torsion.h"
#include "pipelines/body_stages/start_up_stress.h"
#include "pipelines/channels/load_figures.h"
#include "pipelines/files/csv.h"

namespace pipelines {
namespace {

using Eigen::ArrayXd;
using summary::figure;
using summary::number;
using summary::number_or_none;
using summary::object;

std::string place_text(const std::string& feature, double z_m) {
  return fmt::format("{}, z = {:.1f} mm", feature, 1e3 * z_m);
}

CsvColumn series(std::string name, std::string unit, const ArrayXd& values) {
  return {std::move(name), std::move(unit),
          std::vector<double>(values.data(), values.data() + values.size())};
}

summary::Json course_json(const Course& course, const char* unit) {
  return object({{"mean", number(course.mean)},
                 {"amplitude", number(course.amplitude)},
                 {"largest", number(course.largest)},
                 {"unit", unit}});
}

void print_torques(std::ostream& out, const std::vector<ElementTorsion>& elements) {
  out << fmt::format("\n  {:<24}{:<16}{:>10}{:>12}{:>10}{:>17}{:>13}\n", "torque on the shaft N m", "at port",
                     "mean", "amplitude", "largest", "by stress field", "difference");
  for (const auto& e : elements) {
    const Course& torque = e.torque;
    out << fmt::format("  {:<24}{:<16}{:>10.4g}{:>12.4g}{:>10.4g}{:>17.4g}{:>13.2g}\n", e.element, e.port,
                       torque.mean, torque.amplitude, torque.largest, e.by_stress.largest,
                       e.largest_difference_Nm);
  }
}

void print_stresses(std::ostream& out, const std::vector<ElementTorsion>& elements) {
  out << fmt::format("\n  {:<24}{:>16}{:>10}{:>12}{:>10}{:>17}{:>7}  {}\n", "torsional stress MPa", "",
                     "static", "oscillating", "largest", "nominal T r/I_p", "K_ts", "where");
  for (const auto& e : elements) {
    if (!e.largest) continue;
    const Course& stress = e.largest->stress;
    out << fmt::format("  {:<40}{:>10.3g}{:>12.3g}{:>10.3g}{:>17.3g}{:>7.2f}  {}\n", "largest near " + e.port,
                       stress.mean / 1e6, stress.amplitude / 1e6, stress.largest / 1e6,
                       e.largest->nominal.largest / 1e6, e.largest->factor,
                       place_text(e.largest->ring.feature, e.largest->ring.z_m));
  }
}

summary::Json start_figure(const StartUpFigure& of, const char* unit) {
  auto json = figure(of.largest, unit);
  json["time_s"] = number(of.time_s);
  json["steady"] = number(of.steady);
  json["factor"] = number_or_none(of.steady > 0 ? of.factor() : NAN);
  return json;
}

void print_figure(std::ostream& out, const std::string& name, const StartUpFigure& of, double unit,
                  const std::string& where) {
  out << fmt::format("  {:<40}{:>12.4g}{:>10.4g}{:>12.4g}{:>9}  {}\n", name, of.largest / unit, of.time_s,
                     of.steady / unit, of.steady > 0 ? fixed(of.factor(), 2) : "-", where);
}

}  // namespace

void print_element_torsion(std::ostream& out, const RunReport& report, const BodyAnalysis& analysis) {
  const auto elements = element_torsion(analysis, report.loads, course_of_loads(report.scene, report.loads));
  if (elements.empty()) return;
  print_torques(out, elements);
  print_stresses(out, elements);
}

summary::Json element_torsion_json(const RunReport& report, const BodyAnalysis& analysis) {
  summary::Json json;
  for (const auto& e : element_torsion(analysis, report.loads, course_of_loads(report.scene, report.loads))) {
    auto& entry = json[e.element];
    entry = object({{"port", e.port},
                    {"torque", course_json(e.torque, "N m")},
                    {"torque_by_stress", course_json(e.by_stress, "N m")},
                    {"largest_difference", figure(e.largest_difference_Nm, "N m")},
                    {"nominal_stress_at_port", course_json(e.nominal, "Pa")}});
    if (!e.largest) continue;
    entry["largest_stress"] = course_json(e.largest->stress, "Pa");
    entry["largest_stress"]["feature"] = e.largest->ring.feature;
    entry["largest_stress"]["z_m"] = e.largest->ring.z_m;
    entry["largest_stress"]["nominal"] = course_json(e.largest->nominal, "Pa");
    entry["largest_stress"]["factor"] = number(e.largest->factor);
  }
  return json;
}

void write_element_torsion(const std::filesystem::path& file, const kinetics::LoadHistory& loads,
                           const BodyAnalysis& analysis) {
  const auto elements = element_torsion(analysis, loads);
  if (elements.empty()) return;
  std::vector<CsvColumn> columns{series("time", "s", loads.time_s), series("phi", "rad", loads.phi_rad)};
  for (const auto& e : elements) {
    columns.push_back(series(e.element + ".torque", "N m", e.torque_Nm));
    columns.push_back(series(e.element + ".torque_by_stress", "N m", e.by_stress_Nm));
    columns.push_back(series(e.element + ".nominal_torsional_stress", "Pa", e.nominal_Pa));
    if (e.largest)
      columns.push_back(series(e.element + ".largest_torsional_stress", "Pa", e.largest->stress_Pa));
  }
  write_csv(file, columns);
}

void print_start_up(std::ostream& out, const BodyAnalysis& analysis) {
  if (!analysis.start_up) return;
  const auto& start = *analysis.start_up;
  out << fmt::format("\n  {:<40}{:>12}{:>10}{:>12}{:>9}\n",
                     fmt::format("start-up, {:.4g} s in {} instants", start.time_s[start.time_s.size() - 1],
                                 start.time_s.size()),
                     "largest", "at s", "steady", "factor");
  const std::string error = std::isfinite(start.error_share)
                                ? " +- " + fixed(start.error_share * start.von_mises.largest / 1e6, 1)
                                : ", error not known";
  print_figure(out, "von Mises stress MPa", start.von_mises, 1e6,
               fmt::format("{}{}, safety against yield {}", start.feature, error, fixed(start.safety, 2)));
  if (start.ring)
    print_figure(out, "torsional stress MPa", start.ring->stress, 1e6,
                 place_text(start.ring->feature, start.ring->z_m));
  for (const auto& e : start.elements)
    print_figure(out, "torque of " + e.element + " N m", e.torque, 1, "at " + e.port);
}

summary::Json start_up_json(const BodyAnalysis& analysis) {
  const auto& start = *analysis.start_up;
  auto json = object(
      {{"duration", figure(start.time_s[start.time_s.size() - 1], "s")},
       {"instants", start.time_s.size()},
       {"drive_speed_at_end", figure(start.drive_speed_rad_s[start.drive_speed_rad_s.size() - 1], "rad/s")},
       {"peak_von_mises", start_figure(start.von_mises, "Pa")}});
  auto& peak = json["peak_von_mises"];
  peak["feature"] = start.feature;
  peak["place"] = to_string(start.place);
  peak["position_m"] = start.position_m;
  peak["safety_against_yield"] = number_or_none(start.safety);
  peak["error"] = number_or_none(start.error_share * start.von_mises.largest);
  for (std::size_t e = 0; e < start.effects.size(); ++e)
    peak["effect_share"][start.effects[e]] = number(start.effect_share[e]);
  if (start.ring) {
    auto& torsion = json["torsional_stress"];
    torsion = start_figure(start.ring->stress, "Pa");
    torsion["feature"] = start.ring->feature;
    torsion["z_m"] = start.ring->z_m;
  }
  for (const auto& e : start.elements) {
    json["elements"][e.element] = start_figure(e.torque, "N m");
    json["elements"][e.element]["port"] = e.port;
  }
  return json;
}

void write_start_up(const std::filesystem::path& file, const BodyAnalysis& analysis) {
  const auto& start = *analysis.start_up;
  std::vector<CsvColumn> columns{series("time", "s", start.time_s),
                                 series("drive_angle", "rad", start.drive_angle_rad),
                                 series("drive_speed", "rad/s", start.drive_speed_rad_s)};
  for (const auto& e : start.elements) columns.push_back(series(e.element + ".torque", "N m", e.torque_Nm));
  if (start.ring) columns.push_back(series("torsional_stress", "Pa", start.ring->stress_Pa));
  write_csv(file, columns);
}

}  // namespace pipelines

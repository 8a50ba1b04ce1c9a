#include "pipelines/write/parts/shaft_torsion_report.h"

#include <fmt/core.h>

#include <charconv>
#include <ostream>

#include "pipelines/base/fields/shown_unit.h"
#include "pipelines/judge/stages/shaft_torsion.h"
#include "pipelines/judge/stages/start_up_stress.h"
#include "pipelines/loads/channels/load_figures.h"
#include "pipelines/write/fields/shaft_fields.h"

namespace pipelines {
namespace {

using summary::Json;

CsvColumn series(std::string name, std::string unit, const Eigen::ArrayXd& values) {
  return in_shown_unit(
      {std::move(name), std::move(unit), std::vector<double>(values.data(), values.data() + values.size())});
}

Json section_rows(const FieldTable<SectionRow>& fields, const Judged& analysis) {
  auto rows = Json::array();
  for (const auto& section : analysis.diagrams->sections)
    rows.push_back(whole_row(fields, SectionRow{section, analysis.peak.instant}));
  return rows;
}

/// Nine digits: with all of them a table of each instant is twice as long.
void round_to_digits(CsvColumn& column) {
  for (double& value : std::get<std::vector<double>>(column.cells)) {
    const auto text = fmt::format("{:.9g}", value);
    std::from_chars(text.data(), text.data() + text.size(), value);
  }
}

}  // namespace

ShownRows shown_seats(const Json& seats) {
  return shown_named_rows("seat", fields_of(seat_fields()), seats);
}

Json seats_json(const Diagrams& diagrams) {
  const auto fields = seat_fields();
  Json json;
  for (const auto& seat : diagrams.seats) json[seat.port] = summary_row(fields, seat);
  return json;
}

void write_diagrams(const std::filesystem::path& file, const Judged& analysis) {
  const auto fields = section_fields();
  write_csv(file, csv_columns(fields_of(fields), section_rows(fields, analysis)));
}

void write_torsion(const std::filesystem::path& directory, const kinetics::LoadHistory& loads,
                   const Judged& analysis) {
  const auto fields = torsion_fields();
  write_csv(directory / "torsion.csv", csv_columns(fields_of(fields), section_rows(fields, analysis)));
  const auto& sections = analysis.diagrams->sections;
  std::vector<CsvColumn> cycle{series("time", "s", loads.time_s), series("phi", "rad", loads.phi_rad)};
  for (std::size_t begin = 0; begin < sections.size();) {
    std::size_t end = begin;
    while (end < sections.size() && sections[end].plane.segment == sections[begin].plane.segment) ++end;
    const auto& middle = sections[(begin + end) / 2];
    cycle.push_back(series(middle.plane.segment + ".torque", "N m", middle.by_stress.row(5).transpose()));
    cycle.push_back(series(middle.plane.segment + ".torsional_stress", "Pa", middle.torsion_Pa));
    begin = end;
  }
  for (auto& column : cycle) round_to_digits(column);
  write_csv(directory / "torsion_cycle.csv", cycle);
}

ShownRows shown_element_torques(const Json& elements) {
  return shown_named_rows("element", fields_of(element_torque_fields()), elements);
}

ShownRows shown_element_stresses(const Json& elements) {
  return shown_named_rows("element", fields_of(element_stress_fields()), elements);
}

void print_element_torsion(std::ostream& out, const RunReport& report, const Judged& analysis) {
  const auto elements = element_torsion_json(report, analysis);
  print_rows(out, "torque on the shaft", shown_element_torques(elements));
  print_rows(out, "torsional stress near", shown_element_stresses(elements));
}

Json element_torsion_json(const RunReport& report, const Judged& analysis) {
  const auto fields = joined(element_torque_fields(), element_stress_fields());
  Json json;
  for (const auto& e : element_torsion(analysis, report.loads, course_of_loads(report.scene, report.loads)))
    json[e.element] = summary_row(fields, e);
  return json;
}

void write_element_torsion(const std::filesystem::path& file, const kinetics::LoadHistory& loads,
                           const Judged& analysis) {
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

ShownRows shown_start_up(const Json& start_up) {
  Json rows;
  rows["von Mises stress"] = start_up.at("peak_von_mises");
  if (start_up.contains("torsional_stress")) rows["torsional stress"] = start_up.at("torsional_stress");
  if (start_up.contains("elements"))
    for (const auto& [element, row] : start_up.at("elements").items()) rows["torque of " + element] = row;
  return shown_named_rows("", fields_of(start_up_fields()), rows);
}

void print_start_up(std::ostream& out, const Judged& analysis) {
  if (!analysis.start_up) return;
  const auto& time_s = analysis.start_up->time_s;
  print_rows(out, fmt::format("start-up, {:.4g} s in {} instants", time_s[time_s.size() - 1], time_s.size()),
             shown_start_up(start_up_json(analysis)));
}

Json start_up_json(const Judged& analysis) {
  const auto& start = *analysis.start_up;
  const auto fields = start_up_fields();
  StartUpRow peak{start.von_mises, "Pa"};
  peak.peak = &start;
  auto json = summary::object(
      {{"duration", summary::figure(start.time_s[start.time_s.size() - 1], "s")},
       {"instants", start.time_s.size()},
       {"drive_speed_at_end",
        summary::figure(start.drive_speed_rad_s[start.drive_speed_rad_s.size() - 1], "rad/s")},
       {"peak_von_mises", summary_row(joined(fields, start_up_peak_fields()), peak)}});
  if (start.ring) {
    StartUpRow ring{start.ring->stress, "Pa"};
    ring.ring = &*start.ring;
    json["torsional_stress"] = summary_row(fields, ring);
  }
  for (const auto& e : start.elements) {
    StartUpRow torque{e.torque, "N m"};
    torque.element = &e;
    json["elements"][e.element] = summary_row(fields, torque);
  }
  return json;
}

void write_start_up(const std::filesystem::path& file, const Judged& analysis) {
  const auto& start = *analysis.start_up;
  std::vector<CsvColumn> columns{series("time", "s", start.time_s),
                                 series("drive_angle", "rad", start.drive_angle_rad),
                                 series("drive_speed", "rad/s", start.drive_speed_rad_s)};
  for (const auto& e : start.elements) columns.push_back(series(e.element + ".torque", "N m", e.torque_Nm));
  if (start.ring) columns.push_back(series("torsional_stress", "Pa", start.ring->stress_Pa));
  write_csv(file, columns);
}

}  // namespace pipelines

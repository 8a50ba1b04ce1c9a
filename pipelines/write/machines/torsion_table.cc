#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/fields/shown_unit.h"
#include "pipelines/base/files/csv.h"
#include "pipelines/write/fields/train_fields.h"
#include "pipelines/write/machines/published_torsion.h"

namespace pipelines {
namespace {

using Eigen::Index;
using summary::Json;

constexpr double two_pi = 2 * pi;
const char* const phase_sign =
    "phases, in the scene and in forced.csv as everywhere: amplitude cos(w t - phase), a lag is positive";
constexpr double rpm = two_pi / 60;

const kinetics::DriveTrain& train_of(const Scene& scene) {
  return std::get<kinetics::DriveTrain>(scene.machine);
}

/// The element that holds most of a mode's potential energy.
std::string softest(const kinetics::DriveTrain& train, const kinetics::NaturalModes& modes, Index mode) {
  Index element = 0;
  const double share = modes.potential_share.col(mode).maxCoeff(&element);
  return share > 0 ? fmt::format("{:.0f} % in {}", 100 * share, train.elements[std::size_t(element)].name)
                   : "rigid rotation";
}

/// kinetic + potential + dissipated - work, against its start, over the largest energy.
double energy_miss(const kinetics::Transient& t) {
  const Eigen::ArrayXd sum = t.kinetic_J + t.potential_J + t.dissipated_J - t.work_J;
  const double scale =
      std::max({t.kinetic_J.maxCoeff(), t.potential_J.maxCoeff(), t.work_J.abs().maxCoeff()});
  return scale > 0 ? (sum - sum[0]).abs().maxCoeff() / scale : 0;
}

void print_transient(std::ostream& out, const kinetics::DriveTrain& train, const kinetics::Transient& t) {
  const auto n = t.motion.time_s.size();
  out << fmt::format("\n  transient of {:.6g} s; energy balance {:.1e}\n  {:<24}{:>16}{:>14}{:>16}\n",
                     t.motion.time_s[n - 1], energy_miss(t), "element", "largest N m", "at s",
                     "at the end N m");
  for (std::size_t e = 0; e < train.elements.size(); ++e) {
    const Eigen::ArrayXd torque = t.motion.torque_Nm.row(Index(e)).transpose();
    Index at = 0;
    torque.abs().maxCoeff(&at);
    out << fmt::format("  {:<24}{:>16.5g}{:>14.5g}{:>16.5g}\n", train.elements[e].name, torque[at],
                       t.motion.time_s[at], torque[n - 1]);
  }
}

CsvColumn numbers(std::string name, std::string unit, const Eigen::ArrayXd& values) {
  return {std::move(name), std::move(unit),
          std::vector<double>(values.data(), values.data() + values.size())};
}

/// Prints the margins that matter, or all.
void print_margins(std::ostream& out, const std::vector<LineMargin>& margins, const Json& json, bool all) {
  if (margins.empty()) return;
  const auto rows = shown_margins(json, all);
  print_rows(out, "excitation", rows);
  if (const auto text = margins_left_out(margins.size(), rows.cells.size()); !text.empty())
    out << "    " << text << ": margins.csv, --json, torsion -v\n";
  const bool is_damped =
      std::any_of(margins.begin(), margins.end(), [](const auto& m) { return m.damping_ratio > 0; });
  out << (is_damped ? "    amplification with the damping of the mode\n"
                    : "    amplification without damping: the scene gives none (modal_damping, loss_factor, "
                      "damping)\n");
}

}  // namespace

void print_torsion(std::ostream& out, const Scene& scene, const TorsionReport& report, bool all) {
  const auto& train = train_of(scene);
  out << fmt::format("\n{}: {} inertias, reference shaft {} at {:.6g} rpm\n", scene.title,
                     train.inertias.size(), train.reference_shaft, train.reference_speed_rad_s / rpm);
  constexpr Index shown = 12;
  const auto& w = report.modes.frequency_rad_s;
  auto modes = Json::array();
  for (Index k = 0; k < std::min(shown, w.size()); ++k)
    modes.push_back(whole_row(train_mode_fields(), {w[k], softest(train, report.modes, k)}));
  print_rows(out, "mode", shown_named_rows("mode", fields_of(train_mode_fields()), modes, 0));
  if (w.size() > shown) out << fmt::format("       and {} more (-o DIR writes all)\n", w.size() - shown);
  print_rows(out, "element",
             shown_named_rows("element", fields_of(train_element_fields()), train_elements_json(report)));
  if (report.forced.rigid_acceleration_rad_s2 != 0)
    out << fmt::format("  unbalanced mean torque: the reference shaft gains {:.4g} rad/s2\n",
                       report.forced.rigid_acceleration_rad_s2);

  print_margins(out, report.margins, margins_json(report), all);

  out << fmt::format("\n  crossings from {:.6g} to {:.6g} rpm of the reference shaft\n",
                     report.campbell.speed_rad_s[0] / rpm,
                     report.campbell.speed_rad_s[report.campbell.speed_rad_s.size() - 1] / rpm);
  if (report.campbell.crossings.empty()) out << "    none\n";
  for (const auto& c : report.campbell.crossings)
    out << fmt::format("    {:<34} meets mode {} at {:.6g} rpm\n", line_name(c.line), c.mode,
                       c.speed_rad_s / rpm);
  if (report.transient) print_transient(out, train, *report.transient);
  if (report.published) print_published(out, *report.published);
  out << "\n  " << phase_sign << '\n';
  for (const auto& warning : report.forced.warnings) out << "  warning: " << warning << '\n';
}

std::string torsion_json(const Scene& scene, const TorsionReport& report) {
  Json json;
  json["scene"] = scene.file.filename().string();
  if (!scene.settings.empty()) json["settings"] = scene.settings;
  Json& torsion = json["torsion"];
  for (const double w : report.modes.frequency_rad_s)
    torsion["natural_frequencies"].push_back(summary_row(train_mode_fields(), {w, ""}));
  torsion["elements"] = train_elements_json(report);
  if (!report.margins.empty()) torsion["margins"] = margins_json(report);
  if (report.transient) {
    torsion["transient"]["energy_balance"] = energy_miss(*report.transient);
    for (std::size_t e = 0; e < train_of(scene).elements.size(); ++e)
      torsion["transient"]["largest_torque_Nm"][train_of(scene).elements[e].name] =
          report.transient->motion.torque_Nm.row(Index(e)).abs().maxCoeff();
  }
  torsion["rigid_acceleration_rad_s2"] = report.forced.rigid_acceleration_rad_s2;
  torsion["phases"] = phase_sign;
  if (report.published) torsion["published"] = published_json(*report.published);
  json["warnings"] = report.forced.warnings;
  for (const auto& warning : scene.warnings) json["warnings"].push_back(warning);
  return json.dump(2) + "\n";
}

std::vector<std::string> torsion_files() {
  std::vector<std::string> names{"modes.csv", "forced.csv", "campbell.csv", "transient.csv", "margins.csv"};
  names.insert(names.end(), published_files().begin(), published_files().end());
  return names;
}

void write_torsion_files(const std::filesystem::path& directory, const Scene& scene,
                         const TorsionReport& report) {
  const auto& train = train_of(scene);
  std::vector<CsvColumn> modes{numbers("frequency", "rad/s", report.modes.frequency_rad_s)};
  for (std::size_t i = 0; i < train.inertias.size(); ++i) {
    const auto row = Index(i);
    modes.push_back(numbers(train.inertias[i].name + ".shape", "1", report.modes.shape.row(row)));
    modes.push_back(
        numbers(train.inertias[i].name + ".kinetic_share", "1", report.modes.kinetic_share.row(row)));
  }
  for (std::size_t e = 0; e < train.elements.size(); ++e)
    modes.push_back(numbers(train.elements[e].name + ".potential_share", "1",
                            report.modes.potential_share.row(Index(e))));
  write_csv(directory / "modes.csv", in_shown_units(std::move(modes)));

  std::vector<double> frequency;
  for (const auto& h : report.forced.harmonics) frequency.push_back(h.frequency_rad_s);
  std::vector<CsvColumn> forced{{"frequency", "rad/s", frequency}};
  const auto add = [&](const std::string& name, const std::string& unit, auto&& entry) {
    std::vector<double> amplitude, phase;
    for (const auto& h : report.forced.harmonics) {
      amplitude.push_back(std::abs(entry(h)));
      phase.push_back(0.0 - std::arg(entry(h)));  // no -0
    }
    forced.push_back({name, unit, amplitude});
    forced.push_back({name + ".phase", "rad", phase});
  };
  for (std::size_t i = 0; i < train.inertias.size(); ++i)
    add(train.inertias[i].name + ".angle", "rad", [&](const auto& h) { return h.angle_rad[Index(i)]; });
  for (std::size_t e = 0; e < train.elements.size(); ++e) {
    add(train.elements[e].name + ".torque", "N m", [&](const auto& h) { return h.torque_Nm[Index(e)]; });
    add(train.elements[e].name + ".reduced_torque", "N m",
        [&](const auto& h) { return h.reduced_torque_Nm[Index(e)]; });
  }
  write_csv(directory / "forced.csv", in_shown_units(std::move(forced)));

  const auto& campbell = report.campbell;
  std::vector<CsvColumn> table{numbers("speed", "rad/s", campbell.speed_rad_s)};
  for (std::size_t l = 0; l < campbell.lines.size(); ++l)
    table.push_back(
        numbers(line_name(campbell.lines[l]), "rad/s", campbell.line_frequency_rad_s.row(Index(l))));
  for (Index k = 0; k < campbell.natural_frequency_rad_s.size(); ++k)
    table.push_back(
        numbers("mode " + std::to_string(k + 1), "rad/s",
                Eigen::ArrayXd::Constant(campbell.speed_rad_s.size(), campbell.natural_frequency_rad_s[k])));
  write_csv(directory / "campbell.csv", table);

  if (report.transient) {
    const auto& t = *report.transient;
    std::vector<CsvColumn> columns{numbers("time", "s", t.motion.time_s)};
    for (std::size_t e = 0; e < train.elements.size(); ++e)
      columns.push_back(
          numbers(train.elements[e].name + ".torque", "N m", t.motion.torque_Nm.row(Index(e)).transpose()));
    for (std::size_t i = 0; i < train.inertias.size(); ++i)
      columns.push_back(
          numbers(train.inertias[i].name + ".angle", "rad", t.motion.angle_rad.row(Index(i)).transpose()));
    columns.push_back(numbers("kinetic_energy", "J", t.kinetic_J));
    columns.push_back(numbers("potential_energy", "J", t.potential_J));
    columns.push_back(numbers("work", "J", t.work_J));
    columns.push_back(numbers("dissipated", "J", t.dissipated_J));
    write_csv(directory / "transient.csv", in_shown_units(std::move(columns)));
  }

  if (report.published) write_published(directory, *report.published);

  write_csv(directory / "margins.csv", csv_columns(fields_of(margin_fields()), margins_json(report)));
}

}  // namespace pipelines

#include "pipelines/machines/load_table_reader.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "pipelines/common/constants.h"
#include "pipelines/files/table_file.h"
#include "pipelines/names/name_fault.h"
#include "pipelines/names/nearest_name.h"
#include "pipelines/names/units.h"

namespace pipelines {
namespace {

const std::map<std::string, std::string>& component_units() {
  static const std::map<std::string, std::string> units{
      {"fx", "N"},       {"fy", "N"},    {"fz", "N"},    {"mx", "N m"},    {"my", "N m"},
      {"torque", "N m"}, {"ax", "m/s2"}, {"ay", "m/s2"}, {"az", "rad/s2"}, {"spin", "rad2/s2"}};
  return units;
}

/// Squares of loads up to here, and their sums with arms of metres, stay within the range of numbers.
constexpr double most_load = 1e152;
const Range loads_within = between(-most_load, most_load);

std::string component_list() {
  std::vector<std::string> names;
  for (const auto& [component, unit] : component_units()) names.push_back(component);
  return listed(names);
}

struct LoadName {
  std::string port, component, unit;
};

/// "<port>.<component>"; empty if it is none.
std::optional<LoadName> parse_load(const std::string& name) {
  const auto dot = name.rfind('.');
  if (dot == std::string::npos || dot == 0) return std::nullopt;
  const std::string component = name.substr(dot + 1);
  const std::string unit = unit_of_component(component);
  if (unit.empty() || !name_fault(name.substr(0, dot)).empty()) return std::nullopt;
  return LoadName{name.substr(0, dot), component, unit};
}

std::string not_a_load(const std::string& name) {
  if (std::string fault = cell_fault(name); !fault.empty()) return fault;
  const auto dot = name.rfind('.');
  if (const std::string fault = name_fault(name.substr(0, dot)); dot != std::string::npos && !fault.empty())
    return "the port's name " + fault;
  return "is no load; write \"<port>.<component>\", the component one of " + component_list();
}

/// Stands for what was refused: its effect is known all the same, and needs no second error.
kinetics::TableLoad nothing_of(const std::string& effect) {
  return {effect, "volume", "ax", "m/s2", kinetics::HarmonicCourse{}};
}

/// A column in SI; errors go to the findings, at the column's title.
Eigen::ArrayXd in_si(const TableFile& table, const TableColumn& column, const std::string& si_unit,
                     SceneFindings& findings) {
  Eigen::ArrayXd values =
      Eigen::Map<const Eigen::ArrayXd>(column.values.data(), Eigen::Index(column.values.size()));
  const auto refuse = [&](const std::string& remedy) {
    findings.errors.push_back(
        {table.file.string(), table.title_line, column.column, column.name, column.unit, remedy});
    return values;
  };
  if (column.unit.empty()) return refuse("has no unit; write \"" + column.name + " [" + si_unit + "]\"");
  try {
    Eigen::ArrayXd in_SI = values * to_si("1 " + column.unit, si_unit);
    for (Eigen::Index i = 0; i < in_SI.size(); ++i)
      if (!loads_within.contains(in_SI[i])) {
        findings.errors.push_back({table.file.string(), table.lines[std::size_t(i)], column.column,
                                   column.name, shown(column.values[std::size_t(i)]),
                                   loads_within.rule(in_SI[i], si_unit) + "; check the number"});
        return values;
      }
    return in_SI;
  } catch (const UnitError& error) {
    return refuse(error.what());
  }
}

/// The drive's angle at each row, from a column of time or of angle.
std::optional<Eigen::ArrayXd> angles_of(const TableFile& table, double speed_rad_s, SceneFindings& findings) {
  const TableColumn& column = table.columns.front();
  if (column.name == "angle") return in_si(table, column, "rad", findings);
  if (column.name == "time") return in_si(table, column, "s", findings) * speed_rad_s;
  findings.errors.push_back({table.file.string(), table.title_line, column.column, column.name, "",
                             "the first column must be \"time [s]\" or \"angle [deg]\"; rename or add it"});
  return std::nullopt;
}

void check_ascending(const TableFile& table, const Eigen::ArrayXd& angle_rad, SceneFindings& findings) {
  for (Eigen::Index i = 1; i < angle_rad.size(); ++i)
    if (angle_rad[i] <= angle_rad[i - 1]) {
      const auto& column = table.columns.front();
      findings.errors.push_back({table.file.string(), table.lines[std::size_t(i)], 1, column.name,
                                 shown(column.values[std::size_t(i)]),
                                 "does not ascend; sort the rows and remove repetitions"});
      return;
    }
}

void read_file(SceneTable& entry, const std::filesystem::path& folder, SceneFindings& findings,
               kinetics::LoadTable& loads) {
  const std::string effect = entry.name("effect"), name = entry.text("file");
  entry.finish();
  if (effect.empty() || name.empty()) return;
  TableFile table;
  try {
    table = read_table_file(folder / name);
  } catch (const SceneError& error) {
    findings.errors.insert(findings.errors.end(), error.findings().begin(), error.findings().end());
    loads.loads.push_back(nothing_of(effect));
    return;
  }
  const auto angle_rad = angles_of(table, loads.speed_rad_s, findings);
  if (!angle_rad) {
    loads.loads.push_back(nothing_of(effect));
    return;
  }
  check_ascending(table, *angle_rad, findings);
  if (!table.doubt.empty()) findings.warnings.push_back(table.doubt);
  if (table.columns.size() < 2)
    entry.refuse("file", "has no load; add columns such as \"pulley_seat.fx [N]\"");
  for (std::size_t c = 1; c < table.columns.size(); ++c) {
    const auto& column = table.columns[c];
    const auto load = parse_load(column.name);
    if (!load) {
      findings.errors.push_back(
          {table.file.string(), table.title_line, column.column, column.name, "", not_a_load(column.name)});
      loads.loads.push_back(nothing_of(effect));
      continue;
    }
    loads.loads.push_back({effect, load->port, load->component, load->unit,
                           kinetics::SampledCourse{*angle_rad, in_si(table, column, load->unit, findings)}});
  }
}

std::optional<LoadName> read_load_name(SceneTable& entry) {
  const std::string name = entry.text("load");
  auto load = parse_load(name);
  if (!load && !name.empty() && cell_fault(name).empty()) entry.refuse("load", not_a_load(name));
  return load;
}

void read_harmonic(SceneTable& entry, kinetics::LoadTable& loads) {
  const std::string effect = entry.name("effect");
  const auto load = read_load_name(entry);
  const std::string unit = load ? load->unit : "N";
  kinetics::HarmonicCourse harmonic;
  harmonic.mean = entry.quantity_or("mean", unit, loads_within, 0, "the harmonic alone");
  harmonic.amplitude = entry.quantity("amplitude", unit, loads_within);
  harmonic.order = entry.quantity_or("order", "1", not_negative(1e4), 1, "once per turn of the drive");
  harmonic.phase_rad = entry.quantity_or("phase", "rad", any_angle(), 0, "largest at the first instant");
  entry.finish();
  loads.loads.push_back(load ? kinetics::TableLoad{effect, load->port, load->component, load->unit, harmonic}
                             : nothing_of(effect));
}

void read_constant(SceneTable& entry, kinetics::LoadTable& loads) {
  const std::string effect = entry.name("effect");
  const auto load = read_load_name(entry);
  const double value = entry.quantity("value", load ? load->unit : "N", loads_within);
  entry.finish();
  loads.loads.push_back(load ? kinetics::TableLoad{effect, load->port, load->component, load->unit,
                                                   kinetics::HarmonicCourse{value}}
                             : nothing_of(effect));
}

template <typename Read>
void read_list(SceneTable& machine, const std::string& name, Read&& read) {
  machine.know(name);
  if (!machine.has(name)) return;
  for (SceneTable& entry : machine.tables(name)) read(entry);
}

}  // namespace

std::string SamplesRead::text() const {
  return effect + ": " + std::to_string(n) + " rows over the drive's angle from " + shown(from_deg) + " to " +
         shown(to_deg) + " deg";
}

std::vector<SamplesRead> samples_read(const Machine& machine) {
  std::vector<SamplesRead> all;
  if (const auto* table = std::get_if<kinetics::LoadTable>(&machine))
    for (const auto& load : table->loads) {
      const auto* course = std::get_if<kinetics::SampledCourse>(&load.course);
      if (course == nullptr || course->angle_rad.size() == 0) continue;
      const auto in_deg = [](double angle_rad) { return std::round(angle_rad * 180 / pi * 1e6) / 1e6; };
      const auto& at = course->angle_rad;
      const SamplesRead read{load.effect, std::size_t(at.size()), in_deg(at[0]), in_deg(at[at.size() - 1])};
      const auto is_same = [&](const SamplesRead& other) {
        return other.effect == read.effect && other.n == read.n && other.to_deg == read.to_deg;
      };
      if (std::none_of(all.begin(), all.end(), is_same)) all.push_back(read);
    }
  return all;
}

std::string unit_of_component(const std::string& component) {
  const auto found = component_units().find(component);
  return found == component_units().end() ? "" : found->second;
}

kinetics::LoadTable read_load_table(SceneTable& machine, const std::filesystem::path& folder,
                                    SceneFindings& findings) {
  kinetics::LoadTable loads;
  loads.speed_rad_s = machine.quantity("speed", "rad/s", positive(1e4));
  read_list(machine, "files", [&](SceneTable& entry) { read_file(entry, folder, findings, loads); });
  read_list(machine, "harmonics", [&](SceneTable& entry) { read_harmonic(entry, loads); });
  read_list(machine, "constants", [&](SceneTable& entry) { read_constant(entry, loads); });
  if (!machine.has("files") && !machine.has("harmonics") && !machine.has("constants"))
    machine.refuse_missing("files",
                           "is missing, and so are harmonics and constants; add a table [[machine.files]], "
                           "[[machine.harmonics]] or [[machine.constants]] with a load");
  machine.finish();
  return loads;
}

}  // namespace pipelines

#include "pipelines/loads/channels/load_statistics.h"

#include <algorithm>
#include <cmath>

#include "kinetics/series/harmonics.h"
#include "kinetics/series/load_spectrum.h"
#include "pipelines/base/common/constants.h"
#include "pipelines/base/fields/field_outputs.h"
#include "pipelines/base/fields/shown_unit.h"
#include "pipelines/base/files/csv.h"
#include "pipelines/loads/channels/load_figures.h"

namespace pipelines {
namespace {

using std::filesystem::path;

constexpr int most_order = 12;
constexpr double worth_a_line = 1e-9;

struct StatisticsSeries {
  std::string name, unit;
  Eigen::ArrayXd values;
};

std::vector<StatisticsSeries> series_of(const kinetics::LoadHistory& loads) {
  std::vector<StatisticsSeries> all;
  for (const auto& quantity : loads.quantities)
    if (quantity.has_statistics && quantity.values.isFinite().all())
      all.push_back({quantity.name, quantity.unit, quantity.values});
  for (const auto& resultant : loads.resultants)
    for (const auto& [row, component, unit] :
         {std::tuple{0, ".fx", "N"}, std::tuple{1, ".fy", "N"}, std::tuple{2, ".torque", "N m"}})
      if ((resultant.total.row(row) != 0).any())
        all.push_back({resultant.role + component, unit, resultant.total.row(row).transpose()});
  return all;
}

/// A table that grows row by row: the first columns say which series, and its unit as people read it, in
/// which values are.
struct Rows {
  std::vector<std::string> name, unit;
  std::vector<std::vector<double>> numbers;

  explicit Rows(std::size_t n) : numbers(n) {}
  void add(const StatisticsSeries& series, const std::vector<double>& values) {
    name.push_back(series.name);
    unit.push_back(shown_unit(series.unit).unit);
    for (std::size_t i = 0; i < values.size(); ++i) numbers[i].push_back(values[i]);
  }
  void write(const path& file, const std::vector<std::string>& titles,
             const std::vector<std::string>& units) {
    std::vector<CsvColumn> columns{{"name", "", name}, {"unit", "", unit}};
    for (std::size_t i = 0; i < titles.size(); ++i)
      columns.push_back(in_shown_unit({titles[i], units[i], numbers[i]}));
    write_csv(file, columns);
  }
};

void write_extremes(const path& file, const std::vector<StatisticsSeries>& all,
                    const kinetics::LoadHistory& loads, const std::vector<kinetics::CourseFigures>& course) {
  auto rows = summary::Json::array();
  for (const auto& series : all) {
    auto of = figure_of(series.name, series.unit, series.values, loads.time_s);
    take_course(course, of);
    rows.push_back(whole_row(load_fields(), of));
  }
  write_csv(file, csv_columns(fields_of(load_fields()), rows));
}

/// The angle in (-pi, pi].
double wrapped(double angle_rad) {
  const double rest = std::remainder(angle_rad, 2 * pi);
  return rest > -pi ? rest : pi;
}

/// @param begin_rad  the drive's angle at the first instant, from where a line spectrum counts its own
void write_harmonics(const path& file, const std::vector<StatisticsSeries>& all, int turns,
                     double begin_rad) {
  Rows rows(3);
  for (const auto& series : all) {
    const int n_lines = std::min<int>(most_order * turns, int(series.values.size() / 2));
    const auto spectrum = kinetics::line_spectrum(series.values, turns, n_lines);
    double largest = std::abs(spectrum.mean);
    for (const auto& line : spectrum.lines) largest = std::max(largest, line.amplitude);
    const auto unit = shown_unit(series.unit);
    rows.add(series, {0, unit.value(spectrum.mean), 0});
    for (const auto& line : spectrum.lines)
      if (line.amplitude > worth_a_line * largest)
        rows.add(series,
                 {line.order, unit.value(line.amplitude), wrapped(line.phase_rad + line.order * begin_rad)});
  }
  rows.write(file, {"order", "amplitude", "phase"}, {"", "", "rad"});
}

void write_polar(const path& file, const kinetics::LoadHistory& loads) {
  const auto to_vector = [](const Eigen::ArrayXd& values) {
    return std::vector<double>(values.data(), values.data() + values.size());
  };
  std::vector<CsvColumn> columns{{"time", "s", to_vector(loads.time_s)},
                                 {"phi", "rad", to_vector(loads.phi_rad)}};
  for (const auto& resultant : loads.resultants) {
    if ((resultant.total.topRows<2>() == 0).all()) continue;
    const auto polar =
        kinetics::polar(resultant.total.row(0).transpose(), resultant.total.row(1).transpose());
    columns.push_back({resultant.role + ".magnitude", "N", to_vector(polar.magnitude)});
    columns.push_back({resultant.role + ".direction", "rad", to_vector(polar.direction_rad)});
  }
  write_csv(file, in_shown_units(std::move(columns)));
}

void write_spectra(const path& file, const std::vector<StatisticsSeries>& all, bool repeats) {
  Rows rows(3);
  for (const auto& series : all) {
    const auto unit = shown_unit(series.unit);
    for (const auto& cycle : kinetics::spectrum(repeats ? kinetics::rainflow_repeating(series.values)
                                                        : kinetics::rainflow(series.values)))
      rows.add(series, {unit.value(cycle.range), unit.value(cycle.mean), cycle.count});
  }
  rows.write(file, {"range", "mean", "count"}, {"", "", ""});
}

}  // namespace

void write_statistics(const path& directory, const kinetics::LoadHistory& loads, int turns,
                      const std::vector<kinetics::CourseFigures>& course) {
  const auto all = series_of(loads);
  write_extremes(directory / "statistics.csv", all, loads, course);
  if (turns > 0) write_harmonics(directory / "harmonics.csv", all, turns, loads.phi_rad[0]);
  write_polar(directory / "polar.csv", loads);
  write_spectra(directory / "spectrum.csv", all, turns > 0);
}

}  // namespace pipelines

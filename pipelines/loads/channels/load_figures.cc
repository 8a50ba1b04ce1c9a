#include "pipelines/loads/channels/load_figures.h"

#include <algorithm>
#include <cmath>

#include "pipelines/base/fields/field_outputs.h"
#include "pipelines/scene/whole/machine_kind.h"

namespace pipelines {
namespace {

using summary::Json, summary::number;

/// What rounding leaves of a mean that is none is 0.
std::string mean_of_row(const Json& row, const Field& mean) {
  auto shown = row;
  const double scale = std::max(std::abs(row.at("max").get<double>()), std::abs(row.at("min").get<double>()));
  shown["mean"] = without_rounding(row.at("mean").get<double>(), scale);
  return shown_value(mean, shown);
}

}  // namespace

FieldTable<LoadFigure> load_fields() {
  using Field = FieldOf<LoadFigure>;
  const auto figure = [](const char* key, const char* meaning, double Statistics::*of) {
    return Field(key, quantities::own_unit, meaning, key,
                 [=](const LoadFigure& f) { return number(f.statistics.*of); });
  };
  const auto time = [](const char* key, const char* meaning, double LoadFigure::*at) {
    return Field(key, quantities::time, meaning, at).without_summary();
  };
  const auto mean = figure("mean", "over the whole window", &Statistics::mean);
  return {
      Field("name", quantities::text, "of the quantity, or `<port>.<component>`", &LoadFigure::name)
          .without_summary(),
      {"unit", quantities::unit, "of its figures", "unit", &LoadFigure::unit},
      figure("max", "largest, between the instants too where the machine knows it", &Statistics::max),
      figure("min", "least, likewise", &Statistics::min),
      mean.shown_as([mean](const Json& row) { return mean_of_row(row, mean); }),
      figure("rms", "root mean square over the whole window", &Statistics::rms),
      time("time_of_max", "of the largest", &LoadFigure::time_of_max_s),
      time("time_of_min", "of the least", &LoadFigure::time_of_min_s),
      Field("first", quantities::own_unit, "at the first instant; of sweeps alone", &LoadFigure::first)
          .without_csv()
          .without_summary(),
  };
}

Json loads_json(const std::vector<LoadFigure>& figures) {
  Json json;
  for (const auto& figure : figures) json[figure.name] = summary_row(load_fields(), figure);
  return json;
}

LoadFigure figure_of(const std::string& name, const std::string& unit, const Eigen::ArrayXd& values,
                     const Eigen::ArrayXd& time_s) {
  LoadFigure figure{name, unit, statistics(values), 0, 0, values[0]};
  Eigen::Index at_max = 0, at_min = 0;
  values.maxCoeff(&at_max);
  values.minCoeff(&at_min);
  figure.time_of_max_s = time_s[at_max];
  figure.time_of_min_s = time_s[at_min];
  return figure;
}

const kinetics::CourseFigures* find_course(const std::vector<kinetics::CourseFigures>& course,
                                           const std::string& quantity) {
  const auto found =
      std::find_if(course.begin(), course.end(), [&](const auto& of) { return of.quantity == quantity; });
  return found == course.end() ? nullptr : &*found;
}

std::vector<kinetics::CourseFigures> course_of_loads(const Scene& scene, const kinetics::LoadHistory& loads) {
  const int turns = scene.sampling.turns;
  const auto n = loads.n_instants();
  if (scene.run_up || turns < 1 || n < 4 * turns || n % turns != 0) return {};
  return kind_of(scene.machine).figures_over_the_course(scene, scene.machine, {turns, int(n / turns)}, loads);
}

void take_course(const std::vector<kinetics::CourseFigures>& course, LoadFigure& figure) {
  const auto* of = find_course(course, figure.name);
  if (of == nullptr) return;
  auto& s = figure.statistics;
  if (of->largest > s.max) s.max = of->largest, figure.time_of_max_s = of->time_of_largest_s;
  if (of->least < s.min) s.min = of->least, figure.time_of_min_s = of->time_of_least_s;
  s.mean = of->mean;
  s.rms = of->rms;
}

std::vector<LoadFigure> load_figures(const Scene& scene, const kinetics::LoadHistory& loads) {
  std::vector<LoadFigure> figures;
  const auto course = course_of_loads(scene, loads);
  for (const auto& quantity : loads.quantities) {
    if (!quantity.has_statistics) continue;
    figures.push_back(figure_of(quantity.name, quantity.unit, quantity.values, loads.time_s));
    take_course(course, figures.back());
  }
  if (kind_of(scene.machine).has_samples())
    for_each_component(loads, [&](const std::string& name, const std::string& unit, const auto& values) {
      figures.push_back(figure_of(name, unit, values, loads.time_s));
    });
  return figures;
}

}  // namespace pipelines

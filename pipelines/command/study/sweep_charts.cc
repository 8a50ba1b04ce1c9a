#include "pipelines/command/study/sweep_charts.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>

#include "pipelines/base/common/process_limits.h"
#include "pipelines/base/fields/shown_unit.h"
#include "pipelines/command/study/sweep_table.h"
#include "pipelines/study/variations/figure_words.h"
#include "pipelines/write/drawing/chart.h"

namespace pipelines {
namespace {

/// A curve per figure over one key: of a grid, for all values of the other keys (up to six curves); of other
/// designs the points where this key was varied, as marks.
LineChart line_chart(const std::string& title, const SweepPlan& plan, const std::vector<SweepRow>& rows,
                     const std::vector<std::string>& figures, std::size_t k, SweepDesign design) {
  LineChart chart;
  chart.title = title;
  const auto& variation = plan.variations[k];
  chart.x = {with_unit(key_in_words(variation.short_key()), variation.unit),
             variation.range && variation.range->is_logarithmic};
  const auto unit = shown_unit(unit_of(rows, figures.front())).unit;
  chart.y.title = figures.size() == 1 ? with_unit(figure_in_words(figures.front()), unit) : unit;
  constexpr std::size_t most_curves = 6;
  for (const auto& figure : figures) {
    const double one = shown_unit(unit_of(rows, figure)).one;
    std::map<std::vector<std::string>, std::size_t> curves;  // by the other keys' values
    for (std::size_t p = 0; p < rows.size(); ++p) {
      const double x = plan.points[p].numbers[k], y = rows[p].figure(figure) / one;
      if (std::isnan(x) || std::isnan(y)) continue;
      std::vector<std::string> others;
      if (design == SweepDesign::grid)
        for (std::size_t other = 0; other < plan.variations.size(); ++other)
          if (other != k) others.push_back(plan.points[p].values[other]);
      auto curve = curves.find(others);
      if (curve == curves.end()) {
        if (chart.curves.size() >= most_curves) continue;
        std::string name = figure_in_words(figure);
        for (const auto& value : others) name += ", " + value;
        curve = curves.emplace(others, chart.curves.size()).first;
        chart.curves.push_back({name, {}, {}, {}, design != SweepDesign::latin_hypercube});
      }
      auto& drawn = chart.curves[curve->second];
      drawn.x.push_back(x);
      drawn.y.push_back(y);
      if (const double error = rows[p].figure(figure + ".error") / one; !std::isnan(error))
        drawn.error.push_back(error);
    }
  }
  if (chart.curves.size() == 1) chart.curves.front().name.clear();  // the axis says it
  return chart;
}

HeatMap heat_map(const std::string& title, const SweepPlan& plan, const std::vector<SweepRow>& rows,
                 const std::string& figure) {
  HeatMap map;
  const auto& along = plan.variations[1];
  const auto& up = plan.variations[0];
  const auto shown = shown_unit(unit_of(rows, figure));
  map.figure_title = with_unit(figure_in_words(figure), shown.unit);
  map.title = title + ": " + map.figure_title;
  map.x_title = with_unit(key_in_words(along.short_key()), along.unit);
  map.y_title = with_unit(key_in_words(up.short_key()), up.unit);
  const auto labels = [](const Variation& variation) {
    std::vector<std::string> texts;
    for (const double number : variation.numbers) texts.push_back(fmt::format("{:.4g}", number));
    return texts.empty() ? variation.values : texts;
  };
  map.x_values = labels(along);
  map.y_values = labels(up);
  for (const auto& row : rows) map.figures.push_back(row.figure(figure) / shown.one);
  return map;
}

}  // namespace

std::vector<std::string> draw_charts(const std::filesystem::path& directory, const std::string& title,
                                     const SweepPlan& plan, const std::vector<SweepRow>& rows,
                                     const std::vector<std::string>& figures, SweepDesign design) {
  std::vector<std::string> files;
  const auto draw = [&](const auto& chart, const std::string& name) {
    if (!write_chart(chart, directory / name)) {
      std::cerr << "no chart: " << why_nothing_draws() << "; sweep.csv has the figures\n";
      return;
    }
    files.push_back(name + ".png");
    files.push_back(name + ".svg");
  };
  if (figures.empty()) return files;
  const bool is_map = design == SweepDesign::grid && plan.variations.size() == 2 &&
                      plan.variations[0].values.size() > 1 && plan.variations[1].values.size() > 1;
  if (is_map)
    for (std::size_t f = 0; f < std::min<std::size_t>(2, figures.size()); ++f)
      draw(heat_map(title, plan, rows, figures[f]), f == 0 ? "map" : "map_" + std::to_string(f + 1));
  std::vector<std::vector<std::string>> by_unit;  // one axis, one unit
  for (const auto& figure : figures) {
    const auto own = std::find_if(by_unit.begin(), by_unit.end(), [&](const auto& others) {
      return unit_of(rows, others.front()) == unit_of(rows, figure);
    });
    own == by_unit.end() ? by_unit.push_back({figure}) : own->push_back(figure);
  }
  int n_charts = 0;
  for (std::size_t k = 0; k < plan.variations.size(); ++k) {
    if (!plan.variations[k].is_numeric()) continue;
    for (const auto& of_unit : by_unit) {
      const auto chart = line_chart(title, plan, rows, of_unit, k, design);
      if (chart.curves.empty()) continue;
      ++n_charts;
      draw(chart, n_charts == 1 ? "chart" : "chart_" + std::to_string(n_charts));
    }
  }
  return files;
}

}  // namespace pipelines

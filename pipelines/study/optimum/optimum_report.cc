#include "pipelines/study/optimum/optimum_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "pipelines/base/fields/field_outputs.h"
#include "pipelines/base/fields/json_values.h"
#include "pipelines/base/fields/shown_unit.h"

namespace pipelines {
namespace {

using summary::Json;

constexpr const char* algorithm = "COBYLA of NLopt";
/// A bound limits the optimum where no more than this is left of it, as a share.
constexpr double share_left = 0.02;
/// An end of a range limits it where the optimum is no farther away than this share of the range.
constexpr double share_of_range = 2e-3;

bool is_life(const std::string& figure) {
  const std::string end = ".life";
  return figure.size() > end.size() && figure.compare(figure.size() - end.size(), end.size(), end) == 0;
}

const SweepRow& best_row(const Optimum& optimum) {
  return optimum.rows[optimum.best];
}

double lacks(const OptimumRequest& request, const Optimum& optimum, std::size_t bound) {
  return shortfall(best_row(optimum), request.bounds[bound], optimum.bounds_si[bound]);
}

bool limits(const OptimumRequest& request, const Optimum& optimum, std::size_t bound) {
  return lacks(request, optimum, bound) > -share_left;
}

/// "lower end", "upper end"; empty: neither.
std::string end_that_limits(const Optimum& optimum, std::size_t v) {
  const auto& range = *optimum.plan.variations[v].range;
  const double low = std::min(range.first, range.last), high = std::max(range.first, range.last);
  const double number = optimum.plan.points[optimum.best].numbers[v];
  const double near = share_of_range * (high - low);
  return number - low <= near ? "lower end" : high - number <= near ? "upper end" : "";
}

/// A bound of four digits that a value keeps.
double kept_in_four_digits(double value, bool is_least) {
  if (value == 0 || !std::isfinite(value)) return value;
  const double step = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 3);
  constexpr double rounding = 1e-9;
  return (is_least ? std::floor(value / step + rounding) : std::ceil(value / step - rounding)) * step;
}

void print_keys(std::ostream& out, const OptimumRequest& request, const Optimum& optimum) {
  ShownRows table{{"key", "start", "optimum", "range", ""}, {}};
  if (!optimum.is_kept) table.titles[2] = "nearest";
  for (std::size_t v = 0; v < request.variations.size(); ++v) {
    const auto& variation = request.variations[v];
    const auto end = end_that_limits(optimum, v);
    table.cells.push_back({variation.short_key(), optimum.plan.points.front().values[v],
                           optimum.plan.points[optimum.best].values[v],
                           fmt::format("{:g} to {:g}", variation.range->first, variation.range->last),
                           end.empty() ? "" : end + " limits"});
  }
  print_first_rows(out, "key", table);
}

/// What an optimisation does with a figure: "least", ">= 3.5, limits".
std::string role_of(const OptimumRequest& request, const Optimum& optimum, const std::string& figure) {
  std::string role = figure != request.goal ? "" : request.maximises ? "largest" : "least";
  for (std::size_t b = 0; b < request.bounds.size(); ++b) {
    const auto& bound = request.bounds[b];
    if (bound.figure != figure) continue;
    role += fmt::format("{}{} {}{}", role.empty() ? "" : ", ", bound.is_least ? ">=" : "<=", bound.quantity,
                        lacks(request, optimum, b) > 0 ? ", not kept"
                        : limits(request, optimum, b)  ? ", limits"
                                                       : "");
  }
  return role;
}

void print_figures(std::ostream& out, const OptimumRequest& request, const Optimum& optimum) {
  ShownRows table{{"figure", "start", "optimum", ""}, {}};
  if (!optimum.is_kept) table.titles[2] = "nearest";
  const auto& start = optimum.rows.front();
  for (const auto& figure : request.figures())
    table.cells.push_back({figure, start.refused.empty() ? figure_text(start, figure) : "refused",
                           figure_text(best_row(optimum), figure), role_of(request, optimum, figure)});
  print_rows(out, "figure", table);
}

void print_sensitivities(std::ostream& out, const OptimumRequest& request, const Optimum& optimum) {
  ShownRows table{{"change by one unit of a key"}, {}};
  for (const auto& figure : request.figures()) table.titles.push_back(figure);
  for (std::size_t v = 0; v < request.variations.size(); ++v) {
    const auto& variation = request.variations[v];
    auto& cells = table.cells.emplace_back(
        1, variation.short_key() + (variation.unit.empty() ? "" : ", by 1 " + variation.unit));
    for (const auto& figure : request.figures()) {
      const auto shown = shown_unit(unit_of_figure(best_row(optimum), figure));
      const auto change = optimum.sensitivity(figure, v);
      cells.push_back(
          change ? fmt::format("{:+.3g}{}", *change / shown.one, shown.unit.empty() ? "" : " " + shown.unit)
                 : "-");
    }
  }
  print_rows(out, table.titles.front(), table);
}

Json keys_json(const OptimumRequest& request, const Optimum& optimum) {
  Json json = Json::object();
  for (std::size_t v = 0; v < request.variations.size(); ++v) {
    const auto& variation = request.variations[v];
    json[variation.key] = summary::object({{"value", optimum.plan.points[optimum.best].numbers[v]},
                                           {"start", optimum.plan.points.front().numbers[v]},
                                           {"from", variation.range->first},
                                           {"to", variation.range->last},
                                           {"unit", variation.unit},
                                           {"limits", !end_that_limits(optimum, v).empty()}});
  }
  return json;
}

Json bounds_json(const OptimumRequest& request, const Optimum& optimum) {
  Json json = Json::array();
  for (std::size_t b = 0; b < request.bounds.size(); ++b) {
    const auto& bound = request.bounds[b];
    json.push_back(summary::object({{"text", bound.text},
                                    {"figure", bound.figure},
                                    {"bound", optimum.bounds_si[b]},
                                    {"assured", summary::number_or_none(assured(best_row(optimum), bound))},
                                    {"is_kept", lacks(request, optimum, b) <= 0},
                                    {"limits", limits(request, optimum, b)}}));
  }
  return json;
}

}  // namespace

std::string figure_text(const SweepRow& row, const std::string& figure) {
  const auto shown = shown_unit(unit_of_figure(row, figure));
  const double value = row.figure(figure) / shown.one, error = stated_error(row, figure) / shown.one;
  const std::string unit = shown.unit.empty() ? "" : " " + shown.unit;
  if (std::isnan(value)) return "-";
  if (std::isinf(value)) return is_life(figure) ? "endures" : "no limit";
  if (std::isinf(error)) return fmt::format("{:.4g} +- ?{}", value, unit);
  return error == 0 ? fmt::format("{:.4g}{}", value, unit)
                    : fmt::format("{:.4g} +- {:.2g}{}", value, error, unit);
}

void print_optimum(std::ostream& out, const OptimumRequest& request, const Optimum& optimum) {
  print_keys(out, request, optimum);
  print_figures(out, request, optimum);
  if (optimum.is_kept) print_sensitivities(out, request, optimum);
  const auto n_sharper = std::count(optimum.levels.begin(), optimum.levels.end(), 1);
  const auto first_sharper =
      std::find(optimum.levels.begin(), optimum.levels.end(), 1) - optimum.levels.begin();
  out << fmt::format("\n  {} points by {}{}{}\n", optimum.rows.size(), algorithm,
                     n_sharper > 0
                         ? fmt::format(", {} of them solved to {}", n_sharper,
                                       optimum.plan.points[std::size_t(first_sharper)].values.back())
                         : "",
                     optimum.has_converged ? "" : "; the evaluations are used up: --evaluations gives more");
}

std::string why_not_kept(const OptimumRequest& request, const Optimum& optimum) {
  std::size_t worst = 0;
  for (std::size_t b = 0; b < request.bounds.size(); ++b)
    if (lacks(request, optimum, b) > lacks(request, optimum, worst)) worst = b;
  const auto& bound = request.bounds[worst];
  const auto shown = shown_unit(unit_of_figure(best_row(optimum), bound.figure));
  std::string keys;
  for (std::size_t v = 0; v < request.variations.size(); ++v)
    keys += (v == 0 ? "" : ", ") + request.variations[v].short_key() + " = " +
            optimum.plan.points[optimum.best].values[v];
  return fmt::format(
      "--keep {}: none of {} points keeps it{}; the nearest has {}, so that {} {:.4g}{} can be kept, at {}",
      bound.text, optimum.rows.size(),
      optimum.has_converged ? "" : ", and the evaluations are used up: --evaluations gives more",
      figure_text(best_row(optimum), bound.figure), bound.is_least ? ">=" : "<=",
      kept_in_four_digits(assured(best_row(optimum), bound) / shown.one, bound.is_least),
      shown.unit.empty() ? "" : " " + shown.unit, keys);
}

std::string optimum_json(const OptimumRequest& request, const Optimum& optimum) {
  Json json = summary::object({{"algorithm", algorithm},
                               {"goal", request.goal},
                               {"maximises", request.maximises},
                               {"is_kept", optimum.is_kept},
                               {"has_converged", optimum.has_converged},
                               {"evaluations", optimum.rows.size()},
                               {"point", optimum.best + 1},
                               {"keys", keys_json(request, optimum)},
                               {"figures", Json::object()},
                               {"bounds", bounds_json(request, optimum)},
                               {"sensitivities", Json::object()}});
  for (const auto& figure : request.figures()) {
    const auto& row = best_row(optimum);
    json["figures"][figure] =
        summary::object({{"value", summary::number_or_none(row.figure(figure))},
                         {"error", summary::number_or_none(stated_error(row, figure))},
                         {"start", summary::number_or_none(optimum.rows.front().figure(figure))},
                         {"unit", unit_of_figure(row, figure)}});
    if (!optimum.is_kept) continue;
    for (std::size_t v = 0; v < request.variations.size(); ++v) {
      const auto change = optimum.sensitivity(figure, v);
      json["sensitivities"][figure][request.variations[v].key] = change ? Json(*change) : Json(nullptr);
    }
  }
  return json.dump(2) + "\n";
}

}  // namespace pipelines

#include "pipelines/study/comparison/comparison.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace pipelines {
namespace {

/// Results of one scene on one machine have the same bits; on another one rounding differs.
constexpr double rounding_of_runs = 1e-12;

/// "12", "0.34", "1.2e+03": two digits, whole numbers whole.
std::string percent_text(double share) {
  const double percent = 100 * std::abs(share);
  return percent < 9.95 || percent >= 9.5e4 ? fmt::format("{:.2g}", percent) : fmt::format("{:.0f}", percent);
}

double squared_distance(const RunFigure& a, const std::optional<std::array<double, 3>>& b) {
  if (!a.position_m || !b) return 0;
  double sum = 0;
  for (std::size_t d = 0; d < 3; ++d) sum += std::pow((*a.position_m)[d] - (*b)[d], 2);
  return sum;
}

/// Rows that grow run by run, with the place of the first run that has the figure.
class FigureMatcher {
public:
  explicit FigureMatcher(std::size_t n_runs) : n_runs_(n_runs) {}

  void add(std::size_t run, const std::vector<RunFigure>& figures) {
    std::vector<bool> is_taken(rows_.size(), false);
    for (const auto& figure : figures) {
      const auto at = nearest(figure, is_taken);
      if (at == rows_.size()) {
        rows_.push_back(
            {figure.group, figure.name, figure.unit, std::vector<std::optional<FigureValue>>(n_runs_), {}});
        positions_.push_back(figure.position_m);
        is_taken.push_back(false);
      }
      rows_[at].values[run] = figure.value;
      is_taken[at] = true;
    }
  }

  std::vector<ComparedFigure> take() { return std::move(rows_); }

private:
  /// The free row of that name whose place is nearest; the number of rows if there is none.
  std::size_t nearest(const RunFigure& figure, const std::vector<bool>& is_taken) const {
    std::size_t found = rows_.size();
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (!is_taken[i] && rows_[i].name == figure.name && rows_[i].unit == figure.unit &&
          (found == rows_.size() ||
           squared_distance(figure, positions_[i]) < squared_distance(figure, positions_[found])))
        found = i;
    return found;
  }

  std::size_t n_runs_;
  std::vector<ComparedFigure> rows_;
  std::vector<std::optional<std::array<double, 3>>> positions_;
};

std::vector<ComparedKey> differing_keys(const std::vector<ComparedRun>& runs) {
  std::set<std::string> names;
  for (const auto& run : runs)
    for (const auto& [key, text] : run.keys) names.insert(key);
  std::vector<ComparedKey> keys;
  for (const auto& name : names) {
    ComparedKey key{name, {}};
    for (const auto& run : runs) {
      const auto found = run.keys.find(name);
      key.texts.push_back(found == run.keys.end() ? "" : found->second);
    }
    if (std::set<std::string>(key.texts.begin(), key.texts.end()).size() > 1) keys.push_back(std::move(key));
  }
  return keys;
}

}  // namespace

std::string Difference::text() const {
  if (is_none) return "the same";
  const std::string which = absolute < 0 ? "smaller" : "larger";
  if (!is_stated)
    return which + (relative ? " by " + percent_text(*relative) + " %" : "") + ", without a stated error";
  if (!is_told) return "no difference that the errors allow to tell";
  if (!relative) return which;
  const double below = std::abs(*relative - *least), above = std::abs(*most - *relative);
  const auto by = which + " by " + percent_text(*relative);
  if (std::max(below, above) <= 1e-9 * std::abs(*relative)) return by + " %";
  if (!std::isfinite(*most) || !std::isfinite(*least) ||
      std::max(below, above) > 1.2 * std::min(below, above))
    return by + fmt::format(" % ({} to {})", percent_text(absolute < 0 ? *most : *least),
                            std::isfinite(absolute < 0 ? *least : *most)
                                ? percent_text(absolute < 0 ? *least : *most)
                                : "any");
  return by + " +- " + percent_text(std::max(below, above)) + " %";
}

Difference difference(const FigureValue& a, const FigureValue& b) {
  Difference result;
  result.absolute = b.value - a.value;
  const double scale = std::max(std::abs(a.value), std::abs(b.value));
  const auto is_bounded = [](const FigureValue& figure) {
    return std::isfinite(figure.least) || std::isfinite(figure.most);
  };
  result.is_stated = is_bounded(a) && is_bounded(b);
  result.is_none = std::abs(result.absolute) <= rounding_of_runs * scale;
  result.is_told = !result.is_none && (b.least > a.most || b.most < a.least);
  if (a.value == 0) return result;
  result.relative = result.absolute / std::abs(a.value);
  result.least = (b.least - a.most) / std::abs(a.value);
  result.most = (b.most - a.least) / std::abs(a.value);
  return result;
}

Comparison compare_runs(std::vector<ComparedRun> runs) {
  Comparison comparison;
  FigureMatcher matcher(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) matcher.add(i, runs[i].figures);
  comparison.figures = matcher.take();
  for (auto& figure : comparison.figures)
    for (const auto& value : figure.values)
      figure.from_first.push_back(figure.values.front() && value
                                      ? std::optional(difference(*figure.values.front(), *value))
                                      : std::nullopt);
  std::stable_sort(comparison.figures.begin(), comparison.figures.end(),
                   [](const auto& a, const auto& b) { return a.group < b.group; });
  comparison.keys = differing_keys(runs);
  comparison.runs = std::move(runs);
  return comparison;
}

}  // namespace pipelines

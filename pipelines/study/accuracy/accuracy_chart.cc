#include "pipelines/study/accuracy/accuracy_chart.h"

#include <fmt/core.h>
#include <vtkProperty2D.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "pipelines/base/common/constants.h"
#include "pipelines/study/accuracy/accuracy_report.h"
#include "pipelines/write/drawing/offscreen_window.h"
#include "pipelines/write/drawing/picture_lines.h"
#include "pipelines/write/drawing/picture_parts.h"

namespace pipelines {
namespace {

// Pixels.
constexpr int width = 1500, height = 950, chart_font = 22, small_font = 18;
constexpr double left = 130, right = 1130, bottom = 110, top = 800, disc_radius = 8;

/// Told apart by hue and by lightness (the first six after Okabe and Ito).
const std::vector<Colour> colours{{0, 114, 178},  {213, 94, 0},  {0, 158, 115},   {204, 121, 167},
                                  {86, 180, 233}, {230, 159, 0}, {110, 110, 110}, {125, 75, 30}};
const Colour pale{225, 225, 225}, frontier_grey{190, 190, 190};

/// A logarithmic axis over whole decades, or parts of one where the values need less.
struct Axis {
  double first = 0, last = 1;  ///< logarithms
  double begin = 0, end = 1;   ///< pixels

  double at(double value) const {
    const double share = (std::log10(value) - first) / (last - first);
    return begin + std::clamp(share, 0.0, 1.0) * (end - begin);
  }
  /// 1, 2 and 5 times powers of ten inside.
  std::vector<double> ticks() const {
    std::vector<double> result;
    for (int decade = int(std::floor(first)); decade <= int(std::ceil(last)); ++decade)
      for (const int step : {1, 2, 5}) {
        const double value = step * std::pow(10, decade);
        if (std::log10(value) >= first - 1e-9 && std::log10(value) <= last + 1e-9) result.push_back(value);
      }
    return result;
  }
};

Axis axis_over(const std::vector<double>& values, double begin, double end) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double low = std::log10(*least), high = std::log10(*most), room = 0.08 * std::max(0.5, high - low);
  return {low - room, high + room, begin, end};
}

std::vector<Pixel> polygon(double x, double y, double radius, int corners, double turned) {
  std::vector<Pixel> result;
  for (int i = 0; i < corners; ++i) {
    const double angle = turned + 2 * pi * i / corners;
    result.push_back({x + radius * std::cos(angle), y + radius * std::sin(angle)});
  }
  return result;
}

class Chart {
public:
  Chart(const AccuracyStudy& study, vtkRenderer* renderer) : study_(study), renderer_(renderer) {
    std::vector<double> seconds, errors{100 * study.tolerance};
    for (const auto& row : study.rows) {
      if (row.seconds > 0) seconds.push_back(row.seconds);
      for (const double error_Pa : {row.errors.total_Pa(), row.true_error_Pa})
        if (percent(error_Pa) > smallest_percent && error_Pa >= study.reference_error_Pa)
          errors.push_back(percent(error_Pa));
      if (std::find(rungs_.begin(), rungs_.end(), row.model) == rungs_.end()) rungs_.push_back(row.model);
    }
    if (study.reference_error_Pa > 0) errors.push_back(percent(study.reference_error_Pa) / 2.5);
    if (seconds.empty()) throw std::invalid_argument("no run with a time: nothing to draw");
    x_ = axis_over(seconds, left, right);
    y_ = axis_over(errors, bottom, top);
  }

  void draw(const std::string& title) {
    words(title, chart_font + 4, left, height - 60);
    words(fmt::format("{} of the {}; reference {:.2f} MPa ({})", study_.quantity, study_.body,
                      study_.reference_Pa / 1e6, study_.reference),
          small_font, left, height - 95);
    draw_axes();
    draw_what_is_not_told();
    draw_tolerance();
    draw_frontier();
    for (std::size_t i = 0; i < rungs_.size(); ++i) draw_model(rungs_[i], colours[i % colours.size()]);
    draw_chosen();
    draw_legend();
    words(machine_and_versions(), 14, 20, 12);
  }

private:
  static constexpr double smallest_percent = 1e-3;

  double percent(double error_Pa) const {
    return study_.reference_Pa > 0 ? 100 * error_Pa / study_.reference_Pa : 0;
  }
  /// Errors that round to nothing lie on the axis.
  double y_of(double error_Pa) const { return y_.at(std::max(percent(error_Pa), smallest_percent)); }
  double shown_y(const AccuracyRow& row) const {
    return y_of(row.is_reference ? row.errors.total_Pa() : row.true_error_Pa);
  }

  vtkTextActor* words(const std::string& text, int size, double x, double y) {
    return add_words(renderer_, text, size, x, y);
  }

  void draw_axes() {
    Drawing grid, frame;
    for (const double value : x_.ticks()) {
      grid.line(x_.at(value), bottom, x_.at(value), top);
      words(fmt::format("{:g}", value), small_font, x_.at(value), bottom - 32)
          ->GetTextProperty()
          ->SetJustificationToCentered();
    }
    for (const double value : y_.ticks()) {
      grid.line(left, y_.at(value), right, y_.at(value));
      words(fmt::format("{:g} %", value), small_font, left - 12, y_.at(value) - 7)
          ->GetTextProperty()
          ->SetJustificationToRight();
    }
    grid.put(renderer_, pale, 1);
    frame.line(left, bottom, right, bottom);
    frame.line(left, bottom, left, top);
    frame.put(renderer_, ink, 2);
    words("seconds", chart_font, 0.5 * (left + right) - 40, bottom - 70);
    words("error of the stress", chart_font, left - 100, top + 20);
  }

  /// Height below which errors are less than what the reference knows of itself; the axis: it knows all.
  double told_from_y() const {
    return study_.reference_error_Pa > 0 ? y_of(study_.reference_error_Pa) : bottom;
  }

  void draw_what_is_not_told() {
    const double height_told = told_from_y() - bottom;
    if (height_told <= 0) return;
    Drawing hatching, border;
    constexpr double apart = 14;
    for (double x = left - height_told; x < right; x += apart) {
      const double from = std::max(left, x), to = std::min(right, x + height_told);
      hatching.line(from, bottom + (from - x), to, bottom + (to - x));
    }
    hatching.put(renderer_, frontier_grey, 1);
    border.line(left, told_from_y(), right, told_from_y());
    border.put(renderer_, ink, 1);
    auto* text = words(fmt::format("not told: less than the reference's own error of {:.2g} %",
                                   percent(study_.reference_error_Pa)),
                       small_font, left + 10, bottom + 6);
    text->GetTextProperty()->SetBackgroundColor(1, 1, 1);
    text->GetTextProperty()->SetBackgroundOpacity(1);
  }

  void draw_tolerance() {
    Drawing line;
    const double y = y_.at(100 * study_.tolerance);
    for (double x = left; x < right; x += 24) line.line(x, y, x + 12, y);
    line.put(renderer_, ink, 1.5);
    words(fmt::format("{:g} % wanted", 100 * study_.tolerance), small_font,
          free_x(y - disc_radius, y + 30 + disc_radius, 120), y + 8);
  }

  /// Left end of a width where no mark, bar or curve lies between two heights: as far to the right as there
  /// is room, else at the right end.
  double free_x(double low, double high, double wide) const {
    const auto is_crossed = [&](double from) {
      const auto meets = [&](double x, double y, double other_x, double other_y) {
        const double first = std::clamp(y, low, high), last = std::clamp(other_y, low, high);
        if (std::max(y, other_y) < low || std::min(y, other_y) > high) return false;
        const double slope = y == other_y ? 0 : (other_x - x) / (other_y - y);
        const double begin = x + slope * (first - y), end = y == other_y ? other_x : x + slope * (last - y);
        return std::max(begin, end) > from - disc_radius && std::min(begin, end) < from + wide + disc_radius;
      };
      std::map<std::string, const AccuracyRow*> before;
      for (const auto& row : study_.rows) {
        const double x = x_.at(row.seconds), y = shown_y(row);
        if (meets(x, y, x, y_of(row.errors.total_Pa()))) return true;
        const auto*& last = before[row.model];
        if (last && meets(x_.at(last->seconds), shown_y(*last), x, y)) return true;
        last = &row;
      }
      return false;
    };
    const double furthest = right - wide - 10;
    for (double x = furthest; x > left; x -= 10)
      if (!is_crossed(x)) return x;
    return furthest;
  }

  void draw_frontier() {
    Drawing line;
    const AccuracyRow* before = nullptr;
    for (const auto& row : study_.rows) {
      if (!row.on_frontier) continue;
      if (before) {
        const double y = std::max(shown_y(row), told_from_y());
        line.line(x_.at(before->seconds), shown_y(*before), x_.at(row.seconds), shown_y(*before));
        line.line(x_.at(row.seconds), shown_y(*before), x_.at(row.seconds), y);
      }
      before = &row;
    }
    line.put(renderer_, frontier_grey, 7);
  }

  void draw_model(const std::string& model, const Colour& colour) {
    Drawing curve, bars, marks;
    const AccuracyRow* before = nullptr;
    for (const auto& row : study_.rows) {
      if (row.model != model) continue;
      const double x = x_.at(row.seconds), y = shown_y(row), estimate = y_of(row.errors.total_Pa());
      if (before) curve.line(x_.at(before->seconds), shown_y(*before), x, y);
      bars.line(x, y, x, estimate);
      bars.line(x - 6, estimate, x + 6, estimate);
      marks.area(row.is_reference ? polygon(x, y, 1.4 * disc_radius, 4, pi / 4)
                                  : polygon(x, y, disc_radius, 24, 0));
      before = &row;
    }
    curve.put(renderer_, colour, 2.5);
    bars.put(renderer_, colour, 1.2);
    marks.put(renderer_, colour, 1);
  }

  void draw_chosen() {
    if (!study_.chosen) return;
    const auto& row = study_.rows[*study_.chosen];
    Drawing ring;
    const auto corners = polygon(x_.at(row.seconds), shown_y(row), 2 * disc_radius, 32, 0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto& next = corners[(i + 1) % corners.size()];
      ring.line(corners[i][0], corners[i][1], next[0], next[1]);
    }
    ring.put(renderer_, ink, 2.5);
  }

  void draw_legend() {
    const double x = right + 40;
    double y = top - 20;
    const auto entry = [&](const std::string& text) {
      words(text, small_font, x + 50, y - 7);
      y -= 36;
    };
    for (std::size_t i = 0; i < rungs_.size(); ++i) {
      Drawing mark;
      mark.area(polygon(x + 20, y, disc_radius, 24, 0));
      mark.put(renderer_, colours[i % colours.size()], 1);
      entry(rungs_[i]);
    }
    y -= 20;
    Drawing bar, line, ring, square;
    bar.area(polygon(x + 20, y, disc_radius, 24, 0));
    bar.line(x + 20, y, x + 20, y + 16);
    bar.line(x + 14, y + 16, x + 26, y + 16);
    bar.put(renderer_, ink, 1.5);
    entry("error, bar to its estimate");
    line.line(x + 4, y, x + 36, y);
    line.put(renderer_, frontier_grey, 7);
    entry("efficient frontier");
    const auto corners = polygon(x + 20, y, 1.5 * disc_radius, 32, 0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto& next = corners[(i + 1) % corners.size()];
      ring.line(corners[i][0], corners[i][1], next[0], next[1]);
    }
    ring.put(renderer_, ink, 2.5);
    entry("chosen for what is wanted");
    square.area(polygon(x + 20, y, 1.4 * disc_radius, 4, pi / 4));
    square.put(renderer_, ink, 1);
    entry("reference, at its estimate");
    y -= 20;
    const auto& sentence = study_.next_factor_of_two;
    for (std::size_t begin = 0; begin < sentence.size();) {  // lines of up to 34 characters
      std::size_t end = std::min(sentence.size(), begin + 34);
      if (end < sentence.size()) end = sentence.rfind(' ', end);
      words(sentence.substr(begin, end - begin), small_font, x, y - 7);
      y -= 28;
      begin = end + 1;
    }
  }

  const AccuracyStudy& study_;
  vtkRenderer* renderer_;
  std::vector<std::string> rungs_;
  Axis x_, y_;
};

}  // namespace

bool write_accuracy_chart(const AccuracyStudy& study, const std::string& title,
                          const std::filesystem::path& png) {
  const auto window = make_offscreen_window();
  if (!window) return false;
  window->SetSize(width, height);
  Chart(study, add_renderer(window.get(), 0, 0, 1, 1)).draw(title);
  write_png(window.get(), png);
  return true;
}

}  // namespace pipelines

#include "tests/benchmarks/solvers/solver_plot.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace measure {

namespace {

struct Point {
  double n_dofs, value;
};

struct Series {
  std::string name, colour;
  bool dashed = false;
  std::vector<Point> points;
};

/// One panel of logarithmic axes.
class Panel {
public:
  Panel(double left, std::string title, const std::vector<Series>& series)
      : left_(left), title_(std::move(title)), series_(series) {
    for (const auto& s : series)
      for (const auto& p : s.points) {
        low_.n_dofs = std::min(low_.n_dofs, p.n_dofs), high_.n_dofs = std::max(high_.n_dofs, p.n_dofs);
        low_.value = std::min(low_.value, p.value), high_.value = std::max(high_.value, p.value);
      }
    low_ = {low_.n_dofs / 1.5, low_.value / 1.5};
    high_ = {high_.n_dofs * 1.5, high_.value * 1.5};
  }

  void draw(std::ostream& out) const {
    out << "<text x='" << left_ << "' y='20' font-weight='bold'>" << title_ << "</text>\n";
    out << "<rect x='" << left_ << "' y='" << top << "' width='" << width << "' height='" << height
        << "' fill='none' stroke='#888'/>\n";
    for (const double tick : ticks(low_.n_dofs, high_.n_dofs))
      out << "<line x1='" << x(tick) << "' x2='" << x(tick) << "' y1='" << top << "' y2='" << top + height
          << "' stroke='#ddd'/><text text-anchor='middle' x='" << x(tick) << "' y='" << top + height + 16
          << "'>" << tick << "</text>\n";
    for (const double tick : ticks(low_.value, high_.value))
      out << "<line x1='" << left_ << "' x2='" << left_ + width << "' y1='" << y(tick) << "' y2='" << y(tick)
          << "' stroke='#ddd'/><text text-anchor='end' x='" << left_ - 4 << "' y='" << y(tick) + 4 << "'>"
          << tick << "</text>\n";
    double line = top + 18;
    for (const auto& s : series_) {
      out << "<polyline fill='none' stroke='" << s.colour << "'"
          << (s.dashed ? " stroke-dasharray='5 4'" : " stroke-width='2'") << " points='";
      for (const auto& p : s.points) out << x(p.n_dofs) << ',' << y(p.value) << ' ';
      out << "'/>\n";
      if (!s.dashed)
        for (const auto& p : s.points)
          out << "<circle cx='" << x(p.n_dofs) << "' cy='" << y(p.value) << "' r='3.5' fill='" << s.colour
              << "'/>\n";
      out << "<text x='" << left_ + 10 << "' y='" << line << "' fill='" << s.colour << "'>" << s.name
          << "</text>\n";
      line += 16;
    }
  }

private:
  static constexpr double top = 30, width = 340, height = 300;
  /// 1, 2 and 5 times powers of ten.
  static std::vector<double> ticks(double low, double high) {
    std::vector<double> result;
    for (double decade = std::pow(10, std::floor(std::log10(low))); decade < high; decade *= 10)
      for (const double digit : {1, 2, 5})
        if (digit * decade >= low && digit * decade <= high) result.push_back(digit * decade);
    return result;
  }
  static double share(double value, double low, double high) {
    return std::log(value / low) / std::log(high / low);
  }
  double x(double n_dofs) const { return left_ + width * share(n_dofs, low_.n_dofs, high_.n_dofs); }
  double y(double value) const { return top + height * (1 - share(value, low_.value, high_.value)); }

  double left_;
  std::string title_;
  const std::vector<Series>& series_;
  Point low_{1e300, 1e300}, high_{0, 0};
};

/// @param of  the figure of a solver that is drawn
template <typename Figure>
std::vector<Series> make_series(const std::vector<SolverRow>& rows, const Figure& of) {
  Series iterative{"iterative", "#1f5fa8", false, {}}, direct{"direct", "#b3412e", false, {}},
      linear{"in proportion to the unknowns", "#777", true, {}};
  for (const auto& row : rows) {
    const double n = 1e-3 * double(row.n_dofs);
    iterative.points.push_back({n, of(row.iterative)});
    if (row.direct) direct.points.push_back({n, of(*row.direct)});
  }
  const auto& through = iterative.points[std::min<std::size_t>(1, rows.size() - 1)];
  for (const auto& p : iterative.points)
    linear.points.push_back({p.n_dofs, through.value * p.n_dofs / through.n_dofs});
  return {iterative, direct, linear};
}

}  // namespace

void write_solver_plot(const std::filesystem::path& svg, const std::vector<SolverRow>& rows) {
  if (rows.empty()) return;
  const auto seconds = make_series(rows, [](const SolverFigures& f) { return f.cpu_s; });
  const auto memory = make_series(rows, [](const SolverFigures& f) { return 1e-9 * f.bytes; });
  if (svg.has_parent_path()) std::filesystem::create_directories(svg.parent_path());
  std::ofstream out(svg);
  out << "<svg xmlns='http://www.w3.org/2000/svg' width='860' height='380' font-family='sans-serif' "
         "font-size='12'>\n<rect width='860' height='380' fill='white'/>\n";
  Panel(60, "CPU seconds, 12 load cases", seconds).draw(out);
  Panel(490, "largest resident memory, GB", memory).draw(out);
  out << "<text text-anchor='middle' x='430' y='372'>thousand unknowns</text>\n</svg>\n";
  if (!out) throw std::runtime_error(svg.string() + ": cannot be written");
}

}  // namespace measure

// Draws the rows of the hard cases: hard_chart ROWS CHART.svg. One line per case on a logarithmic axis of
// relative error: the naive way, ours, and the bound.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

struct Row {
  std::string family, name;
  bool has_naive = false;
  double naive = 0, ours = 0, bound = 0;
};

std::vector<Row> read_rows(const char* file) {
  std::ifstream in(file);
  std::vector<Row> rows;
  for (std::string line; std::getline(in, line);) {
    std::vector<std::string> cells;
    std::istringstream text(line);
    for (std::string cell; std::getline(text, cell, '\t');) cells.push_back(cell);
    if (cells.size() != 7) throw std::runtime_error(std::string(file) + ": seven columns expected: " + line);
    const auto number = [&](std::size_t i) { return std::strtod(cells[i].c_str(), nullptr); };
    rows.push_back({cells[0], cells[1], cells[4] != "-", number(4), number(5), number(6)});
  }
  return rows;
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : std::string(1, c);
  return result;
}

class Chart {
public:
  explicit Chart(std::ostream& out) : out_(out) {}

  void draw(const std::vector<Row>& rows) {
    double y = top;
    for (std::size_t i = 0; i < rows.size(); ++i) y += height_of(rows, i);
    const double bottom = y + 6, height = bottom + 40;
    out_ << "<svg xmlns='http://www.w3.org/2000/svg' width='" << width << "' height='" << height
         << "' font-family='sans-serif' font-size='11'>\n<rect width='" << width << "' height='" << height
         << "' fill='white'/>\n";
    legend();
    for (int decade = least_decade; decade <= most_decade; decade += 2) {
      const double x = place(std::pow(10, decade));
      vertical(x, bottom, "#ddd");
      text(x, bottom + 14, decade == 0 ? "1" : "1e" + std::to_string(decade), "middle");
    }
    vertical(beyond, bottom, "#ddd");
    text(beyond, bottom + 14, "no number", "middle");
    vertical(nothing, bottom, "#ddd");
    text(nothing, bottom + 14, "0", "middle");
    text((left + right) / 2, bottom + 32, "relative error", "middle");
    y = top;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (i == 0 || rows[i].family != rows[i - 1].family) {
        y += family_height;
        out_ << "<text x='10' y='" << y << "' font-weight='bold'>" << escaped(rows[i].family) << "</text>\n";
      }
      y += row_height;
      line(rows[i], y);
    }
    out_ << "</svg>\n";
  }

private:
  static constexpr double top = 34, row_height = 16, family_height = 22, width = 1200, left = 590,
                          right = 1080, nothing = 560, beyond = 1150;
  static constexpr int least_decade = -18, most_decade = 10;
  static constexpr const char *naive_colour = "#b3412e", *our_colour = "#1f5fa8";

  static double height_of(const std::vector<Row>& rows, std::size_t i) {
    return row_height + (i == 0 || rows[i].family != rows[i - 1].family ? family_height : 0);
  }
  /// Zero, and what is no number, have places of their own.
  static double place(double error) {
    if (!std::isfinite(error)) return beyond;
    if (error == 0) return nothing;
    const double share = (std::log10(error) - least_decade) / (most_decade - least_decade);
    return left + (right - left) * std::clamp(share, 0.0, 1.0);
  }
  void text(double x, double y, const std::string& words, const char* anchor) {
    out_ << "<text text-anchor='" << anchor << "' x='" << x << "' y='" << y << "'>" << escaped(words)
         << "</text>\n";
  }
  void vertical(double x, double bottom, const char* colour) {
    out_ << "<line x1='" << x << "' x2='" << x << "' y1='" << top << "' y2='" << bottom << "' stroke='"
         << colour << "'/>\n";
  }
  void cross(double x, double y) {
    out_ << "<path d='M" << x - 4 << ' ' << y - 4 << "l8 8m0 -8l-8 8' stroke='" << naive_colour
         << "' stroke-width='2'/>\n";
  }
  void dot(double x, double y) {
    out_ << "<circle cx='" << x << "' cy='" << y << "' r='4' fill='" << our_colour << "'/>\n";
  }
  void bar(double x, double y) {
    out_ << "<line x1='" << x << "' x2='" << x << "' y1='" << y - 6 << "' y2='" << y + 6
         << "' stroke='#333' stroke-width='2'/>\n";
  }
  void legend() {
    dot(nothing, 16), text(nothing + 10, 20, "ours", "start");
    bar(nothing + 70, 16), text(nothing + 80, 20, "bound", "start");
    cross(nothing + 150, 16), text(nothing + 160, 20, "naive", "start");
  }
  void line(const Row& row, double y) {
    const double middle = y - 4;
    text(nothing - 14, y, row.name, "end");
    out_ << "<line x1='" << nothing << "' x2='" << beyond << "' y1='" << middle << "' y2='" << middle
         << "' stroke='#eee'/>\n";
    bar(place(row.bound), middle);
    if (row.has_naive) cross(place(row.naive), middle);
    dot(place(row.ours), middle);
  }

  std::ostream& out_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "hard_chart ROWS CHART.svg\n";
    return 2;
  }
  try {
    const auto rows = read_rows(argv[1]);
    std::ofstream out(argv[2]);
    Chart(out).draw(rows);
    if (!out.flush()) throw std::runtime_error(std::string(argv[2]) + ": cannot be written");
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}

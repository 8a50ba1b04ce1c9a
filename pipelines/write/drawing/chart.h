/// Charts of a few curves, or of one figure over two keys, by VTK's charts.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pipelines {

struct ChartAxis {
  std::string title;
  bool is_logarithmic = false;
  std::vector<std::string> names{};  ///< names of the places 1, 2, 3 ...: shown there in place of numbers
};

/// One curve; x ascending or not, as it is to be joined.
struct ChartCurve {
  std::string name;
  std::vector<double> x, y;
  std::vector<double> error;  ///< error of y, drawn as a band; empty: none
  bool is_joined = true;      ///< else marks alone
  bool has_marks = true;      ///< at the points of a joined curve of up to 100
  bool has_stems = false;     ///< lines from zero up to the marks of one that is not joined
};

/// Adds a curve; one that lies on another joins its name instead, since it would hide it.
void add_or_join(std::vector<ChartCurve>& curves, ChartCurve curve);

/// A part of the plane.
struct ChartWindow {
  std::array<double, 2> x{}, y{};
};

struct LineChart {
  std::string title;
  ChartAxis x, y;
  std::vector<ChartCurve> curves;
  /// One unit is as long along x as along y, and both axes have zero in the middle.
  bool has_equal_scales = false;
  /// Both axes begin at zero and have room behind the largest; nothing is negative.
  bool is_from_zero = false;
  /// Shown whole with equal scales, and more beside it: the legend stands on its right.
  std::optional<ChartWindow> window{};
};

/// A figure at every pair of values.
struct HeatMap {
  std::string title;
  std::string x_title, y_title, figure_title;
  std::vector<std::string> x_values, y_values;  ///< as text, at equal distances
  std::vector<double> figures;                  ///< x fastest; NaN: nothing is known there
};

/// Writes NAME.png and NAME.svg. Curves that are joined have their names at their right ends, others in a
/// legend.
/// @param file  without its extension
/// @return false if the machine offers no EGL
/// @throws FileError naming the file if it cannot be written
bool write_chart(const LineChart& chart, const std::filesystem::path& file);
bool write_chart(const HeatMap& chart, const std::filesystem::path& file);

}  // namespace pipelines

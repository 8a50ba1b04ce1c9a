/// Charts, read back: what is drawn where, and an SVG beside each picture.
#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "pipelines/write/drawing/chart.h"
#include "tests/unit/pipelines/examples/results_directory.h"

using namespace pipelines;
using results_test::Directory;

namespace {

using Rgb = std::array<int, 3>;
constexpr Rgb first_colour{0, 114, 178}, second_colour{213, 94, 0};

class PictureOfChart {
public:
  explicit PictureOfChart(const std::filesystem::path& png) {
    reader_->SetFileName(png.c_str());
    reader_->Update();
    image_ = reader_->GetOutput();
  }
  int width() const { return image_->GetDimensions()[0]; }
  int height() const { return image_->GetDimensions()[1]; }
  Rgb at(int x, int y) const {
    Rgb colour{};
    for (int c = 0; c < 3; ++c) colour[std::size_t(c)] = int(image_->GetScalarComponentAsDouble(x, y, 0, c));
    return colour;
  }
  /// Pixels of a colour left of half the width, where no legend is; and their mean height.
  std::pair<int, double> area_of(const Rgb& colour) const {
    int n = 0;
    double sum = 0;
    for (int y = 0; y < height(); ++y)
      for (int x = 0; x < width() / 2; ++x) {
        const auto found = at(x, y);
        bool same = true;
        for (std::size_t c = 0; c < 3; ++c) same = same && std::abs(found[c] - colour[c]) < 12;
        n += same;
        sum += same ? y : 0;
      }
    return {n, n > 0 ? sum / n : 0};
  }

private:
  vtkNew<vtkPNGReader> reader_;
  vtkImageData* image_ = nullptr;
};

std::string text_of_chart(const std::filesystem::path& svg) {
  std::ifstream in(svg, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace

// One curve at 1 and one at 3, over the left half: each has its pixels, the second lies above the first.
TEST(Charts, ShowEachCurveAtItsHeight) {
  const Directory directory;
  LineChart chart;
  chart.title = "Two levels";
  chart.x.title = "x";
  chart.y.title = "y";
  chart.curves.push_back({"low", {0, 1, 2, 3}, {1, 1, 1, 1}, {}, true});
  chart.curves.push_back({"high", {0, 1, 2, 3}, {3, 3, 3, 3}, {}, true});
  chart.curves.push_back({"single", {1}, {2}, {0.5}, true});
  ASSERT_TRUE(write_chart(chart, directory / "chart"));
  const PictureOfChart picture(directory / "chart.png");
  const auto [n_low, y_low] = picture.area_of(first_colour);
  const auto [n_high, y_high] = picture.area_of(second_colour);
  EXPECT_GT(n_low, 300);
  EXPECT_GT(n_high, 300);
  EXPECT_GT(y_high, y_low + 0.5 * picture.height());
  const auto svg = text_of_chart(directory / "chart.svg");
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

// No legend to look up: right of the plot each name stands in its curve's colour at its curve's height, and
// those of curves that end together make room.
TEST(Charts, NameCurvesAtTheirEnds) {
  const Directory directory;
  LineChart chart;
  chart.curves.push_back({"low", {0, 1, 2}, {1, 1, 1}, {}, true});
  chart.curves.push_back({"high", {0, 1, 2}, {3, 3, 3}, {}, true});
  chart.curves.push_back({"as high", {0, 1, 2}, {2, 2.5, 2.99}, {}, true});
  ASSERT_TRUE(write_chart(chart, directory / "chart"));
  const PictureOfChart picture(directory / "chart.png");
  const auto height_of_name = [&](const Rgb& colour) {
    int n = 0;
    double sum = 0;
    for (int y = 0; y < picture.height(); ++y)
      for (int x = picture.width() - 110; x < picture.width(); ++x) {
        const auto found = picture.at(x, y);
        bool is_own = true;
        for (std::size_t c = 0; c < 3; ++c) is_own = is_own && std::abs(found[c] - colour[c]) < 40;
        n += is_own;
        sum += is_own ? y : 0;
      }
    EXPECT_GT(n, 20);
    return sum / std::max(n, 1);
  };
  const double low = height_of_name(first_colour), high = height_of_name(second_colour),
               as_high = height_of_name({0, 158, 115});
  EXPECT_NEAR(low, picture.area_of(first_colour).second, 12);
  EXPECT_NEAR(high, picture.area_of(second_colour).second, 40);
  EXPECT_GT(std::abs(high - as_high), 15) << "they do not cover each other";
}

// The curve of a port "x" took the place of the numbers along x: an internal error ended all charts.
TEST(Charts, ShowACurveNamedAsAnAxis) {
  const Directory directory;
  LineChart chart;
  chart.curves.push_back({"x", {0, 1, 2, 3}, {1, 1, 1, 1}, {}, true});
  ChartCurve stems{"y", {1, 3}, {900, 150}, {}, false};
  stems.has_stems = true;
  chart.curves.push_back(stems);
  ASSERT_TRUE(write_chart(chart, directory / "chart"));
  const PictureOfChart picture(directory / "chart.png");
  EXPECT_GT(picture.area_of(first_colour).first, 300);
  EXPECT_GT(picture.area_of(second_colour).first, 300);
}

// Two points of a sweep, as the refusal of a third leaves them: the band of the error was missing, though the
// legend named it.
TEST(Charts, ShowTheErrorOfTwoPoints) {
  const Directory directory;
  const auto pale_pixels = [&](const std::vector<double>& error) {
    LineChart chart;
    chart.curves.push_back({"stress", {0, 1}, {2, 2}, error, true});
    chart.curves.push_back({"frame", {0, 1}, {0, 4}, {}, true});
    EXPECT_TRUE(write_chart(chart, directory / "chart"));
    return PictureOfChart(directory / "chart.png").area_of({205, 227, 240}).first;
  };
  EXPECT_LT(pale_pixels({}), 100);
  EXPECT_GT(pale_pixels({1, 1}), 50000);
}

// Of two excitations at 50 Hz only the second was to be seen.
TEST(Charts, CurvesThatLieOnEachOtherShareAName) {
  std::vector<ChartCurve> curves;
  add_or_join(curves, {"motor", {0, 1}, {50, 50}, {}, true});
  add_or_join(curves, {"peeling", {0, 1}, {50, 50}, {}, true});
  add_or_join(curves, {"order 1", {0, 1}, {0, 50}, {}, true});
  ASSERT_EQ(curves.size(), 2U);
  EXPECT_EQ(curves[0].name, "motor, peeling");
  EXPECT_EQ(curves[1].name, "order 1");
}

// Two harmonics were two dots in the corners of the chart.
TEST(Charts, ShowHarmonicsFromZero) {
  const Directory directory;
  LineChart chart;
  ChartCurve harmonics{"rod", {1, 3}, {900, 150}, {}, false};
  harmonics.has_stems = true;
  chart.is_from_zero = true;
  chart.curves.push_back(harmonics);
  ASSERT_TRUE(write_chart(chart, directory / "chart"));
  const PictureOfChart picture(directory / "chart.png");
  const auto [n, height] = picture.area_of(first_colour);  // of order 1: on the left
  EXPECT_GT(n, picture.height());
  EXPECT_GT(height, 0.2 * picture.height());
  EXPECT_LT(height, 0.7 * picture.height());
}

// Inertias by name, not 1, 1.2, 1.4 ...: the places have room on both sides, so the middle of the first is
// right of the axis, and below the axis words stand there alone.
TEST(Charts, ShowNamesOfPlaces) {
  const Directory directory;
  LineChart chart;
  chart.x.names = {"motor", "pulley", "disc"};
  chart.curves.push_back({"mode", {1, 2, 3}, {0, 1, 0}, {}, true});
  ASSERT_TRUE(write_chart(chart, directory / "chart"));
  const PictureOfChart named(directory / "chart.png");
  chart.x.names.clear();
  ASSERT_TRUE(write_chart(chart, directory / "numbers"));
  const PictureOfChart numbered(directory / "numbers.png");
  const auto leftmost = [](const PictureOfChart& picture) {
    for (int x = 0; x < picture.width(); ++x)
      for (int y = 0; y < picture.height(); ++y)
        if (picture.at(x, y) == first_colour) return x;
    return picture.width();
  };
  EXPECT_GT(leftmost(named), leftmost(numbered) + named.width() / 8);
}

// Cells from dark to light, the one without a figure grey; x runs fastest.
TEST(Charts, ShowAMapFromDarkToLight) {
  const Directory directory;
  HeatMap map;
  map.title = "Map";
  map.x_values = {"a", "b"};
  map.y_values = {"1", "2"};
  map.figures = {0, 1, std::nan(""), 0.5};
  ASSERT_TRUE(write_chart(map, directory / "map"));
  const PictureOfChart picture(directory / "map.png");
  const auto cell = [&](double x, double y) {
    return picture.at(int(x * picture.width()), int(y * picture.height()));
  };
  const auto lightness = [](const Rgb& c) { return c[0] + c[1] + c[2]; };
  EXPECT_LT(lightness(cell(0.25, 0.25)), 200);  // 0: dark
  EXPECT_GT(lightness(cell(0.7, 0.25)), 450);   // 1: yellow
  const auto none = cell(0.25, 0.75);
  EXPECT_NEAR(none[0], 230, 5);
  EXPECT_EQ(none[0], none[1]);
  EXPECT_NEAR(cell(0.7, 0.75)[1], 0.567 * 255, 12);  // the middle of the scale
}

/// Charts, read back: what is drawn where, and an SVG beside each picture.
#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "pipelines/pictures/chart.h"
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

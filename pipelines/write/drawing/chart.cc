#include "pipelines/write/drawing/chart.h"

#include <vtkAxis.h>
#include <vtkChartHistogram2D.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkColorLegend.h>
#include <vtkColorTransferFunction.h>
#include <vtkContext2D.h>
#include <vtkContextActor.h>
#include <vtkContextItem.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkPlot.h>
#include <vtkPlotArea.h>
#include <vtkPlotHistogram2D.h>
#include <vtkPlotPoints.h>
#include <vtkPointData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSVGExporter.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/write/drawing/offscreen_window.h"
#include "pipelines/write/drawing/picture_parts.h"

namespace pipelines {
namespace {

constexpr int chart_width = 1200, chart_height = 800, title_size = 22, label_size = 18;

/// Colours after Okabe and Ito: told apart by hue and by lightness.
constexpr std::array<std::array<unsigned char, 3>, 8> curve_colours{{{0, 114, 178},
                                                                     {213, 94, 0},
                                                                     {0, 158, 115},
                                                                     {204, 121, 167},
                                                                     {86, 180, 233},
                                                                     {110, 110, 110},
                                                                     {0, 0, 0},
                                                                     {230, 159, 0}}};

void style(vtkAxis* axis, const ChartAxis& wanted) {
  axis->SetTitle(wanted.title);
  axis->SetLogScale(wanted.is_logarithmic);
  plain(axis->GetTitleProperties(), label_size);
  plain(axis->GetLabelProperties(), label_size - 2);
}

void style(vtkChart* chart, const std::string& title) {
  chart->SetTitle(title);
  plain(chart->GetTitleProperties(), title_size);
}

/// @param name  no other column's, which would be replaced
void add_column(vtkTable* table, const char* name, const std::vector<double>& values) {
  vtkNew<vtkDoubleArray> column;
  column->SetName(name);
  for (const double value : values) column->InsertNextValue(value);
  table->AddColumn(column);
}

void write_svg(vtkRenderWindow* window, const std::filesystem::path& svg) {
  AtomicFile file(svg);
  vtkNew<vtkSVGExporter> exporter;
  exporter->SetRenderWindow(window);
  exporter->SetFileName(file.temporary().c_str());
  exporter->Write();
  file.commit("</svg>\n");  // the library does not tell that the disk was full
}

/// Names of curves beside their right ends, each in its colour, moved apart.
class CurveLabels : public vtkContextItem {
public:
  static CurveLabels* New();
  vtkTypeMacro(CurveLabels, vtkContextItem);

  struct Label {
    std::string text;
    std::array<unsigned char, 3> colour{};
    double x = 0, end_y = 0, y = 0;  ///< end of the curve, and where the words go [pixels]
  };

  /// @param left       left end of the words
  /// @param low, high  what is free for them
  void place(std::vector<Label> labels, double left, double low, double high) {
    labels_ = std::move(labels);
    left_ = left;
    std::sort(labels_.begin(), labels_.end(), [](const auto& a, const auto& b) { return a.end_y < b.end_y; });
    const double apart = 1.25 * label_size;
    for (std::size_t i = 0; i < labels_.size(); ++i)
      labels_[i].y = std::max(labels_[i].end_y, i > 0 ? labels_[i - 1].y + apart : low);
    double most = high;
    for (auto label = labels_.rbegin(); label != labels_.rend(); ++label, most -= apart)
      label->y = std::min(label->y, most);
  }

  bool Paint(vtkContext2D* painter) override {
    vtkNew<vtkTextProperty> words;
    plain(words, label_size - 2);
    words->SetVerticalJustificationToCentered();
    for (const auto& [text, colour, x, end_y, y] : labels_) {
      painter->GetPen()->SetColor(colour[0], colour[1], colour[2], 255);
      painter->GetPen()->SetLineType(vtkPen::SOLID_LINE);
      painter->GetPen()->SetWidth(1);
      painter->DrawLine(float(x + 4), float(end_y), float(left_ - 4), float(y));
      words->SetColor(colour[0] / 255., colour[1] / 255., colour[2] / 255.);
      painter->ApplyTextProp(words);
      painter->DrawString(float(left_), float(y), text);
    }
    return true;
  }

protected:
  CurveLabels() = default;

private:
  std::vector<Label> labels_;
  double left_ = 0;
};
vtkStandardNewMacro(CurveLabels);

/// Room that the names of curves need beside them; 0: a legend says them.
int width_of_labels(const LineChart& chart) {
  constexpr std::size_t most_labels = 12, most_letters = 44;
  std::size_t longest = 0;
  for (const auto& curve : chart.curves) {
    const bool is_line = curve.is_joined && curve.x.size() > 1;
    if (!is_line || curve.name.size() > most_letters) return 0;
    longest = std::max(longest, curve.name.size());
  }
  const bool has_other_legend = chart.has_equal_scales || chart.window || chart.curves.size() > most_labels;
  return has_other_legend ? 0 : 40 + int(longest) * (label_size - 2) * 6 / 10;
}

/// Where a chart's axis shows a value [pixels].
double pixel_at(vtkAxis* axis, double value, int d) {
  const double shown = axis->GetLogScaleActive() ? std::log10(value) : value;
  const double share = (shown - axis->GetMinimum()) / (axis->GetMaximum() - axis->GetMinimum());
  return axis->GetPoint1()[d] + share * (axis->GetPoint2()[d] - axis->GetPoint1()[d]);
}

void place_labels(vtkChartXY* chart, const std::vector<ChartCurve>& curves, CurveLabels* items) {
  auto *const x = chart->GetAxis(vtkAxis::BOTTOM), *const y = chart->GetAxis(vtkAxis::LEFT);
  std::vector<CurveLabels::Label> labels;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const auto& own = curves[i];
    const auto last = std::size_t(std::max_element(own.x.begin(), own.x.end()) - own.x.begin());
    labels.push_back({own.name, curve_colours[i % curve_colours.size()], pixel_at(x, own.x[last], 0),
                      pixel_at(y, own.y[last], 1), 0});
  }
  items->place(std::move(labels), x->GetPoint2()[0] + 24, y->GetPoint1()[1], y->GetPoint2()[1]);
}

/// Draws one chart.
/// @param fit  what is left to set once the chart is laid out
bool draw(vtkChart* chart, const std::filesystem::path& file, int width = chart_width,
          const std::function<void()>& fit = {}, vtkContextItem* beside = nullptr) {
  const auto window = make_offscreen_window();
  if (!window) return false;
  window->SetSize(width, chart_height);
  window->SetMultiSamples(0);  // else letters have dashes below them
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(chart);
  if (beside) actor->GetScene()->AddItem(beside);
  auto* const renderer = add_renderer(window.get(), 0, 0, 1, 1);
  renderer->AddActor(actor);
  actor->GetScene()->SetRenderer(renderer);
  if (fit) {
    window->Render();
    fit();
  }
  auto png = file, svg = file;
  write_png(window.get(), png += ".png");
  write_svg(window.get(), svg += ".svg");
  return true;
}

/// The band between y less its error and y plus its error, then the curve.
void add_curve(vtkChartXY* chart, const ChartCurve& curve, std::size_t i) {
  const auto& colour = curve_colours[i % curve_colours.size()];
  vtkNew<vtkTable> table;
  add_column(table, "x", curve.x);
  add_column(table, "y", curve.y);
  const bool is_line = curve.is_joined && curve.x.size() > 1;
  if (curve.error.size() == curve.y.size() && is_line) {
    std::vector<double> x, low, high;
    const auto enter = [&](double at_x, double y, double error) {
      x.push_back(at_x);
      low.push_back(y - error);
      high.push_back(y + error);
    };
    for (std::size_t k = 0; k < curve.y.size(); ++k) enter(curve.x[k], curve.y[k], curve.error[k]);
    // VTK draws no area between two places alone.
    if (x.size() == 2) enter(curve.x[1], curve.y[1], curve.error[1]);
    vtkNew<vtkTable> bounds;
    add_column(bounds, "x", x);
    add_column(bounds, "low", low);
    add_column(bounds, "high", high);
    auto* const band = vtkPlotArea::SafeDownCast(chart->AddPlot(vtkChart::AREA));
    band->SetInputData(bounds);
    band->SetInputArray(0, "x");
    band->SetInputArray(1, "low");
    band->SetInputArray(2, "high");
    band->SetColor(colour[0], colour[1], colour[2], 50);
    band->SetLegendVisibility(false);
  }
  if (curve.has_stems) {
    std::vector<double> x, y;
    for (std::size_t k = 0; k < curve.x.size(); ++k)
      for (const double height : {0.0, curve.y[k], 0.0}) {
        x.push_back(curve.x[k]);
        y.push_back(height);
      }
    vtkNew<vtkTable> path;
    add_column(path, "x", x);
    add_column(path, "y", y);
    auto* const stems = chart->AddPlot(vtkChart::LINE);
    stems->SetInputData(path, 0, 1);
    stems->SetColor(colour[0], colour[1], colour[2], 255);
    stems->SetWidth(2);
    stems->SetLegendVisibility(false);
  }
  auto* const plot = chart->AddPlot(is_line ? vtkChart::LINE : vtkChart::POINTS);
  plot->SetInputData(table, 0, 1);
  plot->SetLabel(curve.name);
  plot->SetColor(colour[0], colour[1], colour[2], 255);
  plot->SetWidth(curve.x.size() > 200 ? 1.5F : 2.5F);
  auto* const points = vtkPlotPoints::SafeDownCast(plot);
  const bool is_plain = is_line && (curve.x.size() > 100 || !curve.has_marks);
  points->SetMarkerStyle(is_plain ? vtkPlotPoints::NONE : vtkPlotPoints::CIRCLE);
  if (i >= curve_colours.size() && is_plain) plot->GetPen()->SetLineType(vtkPen::DASH_LINE);
  points->SetMarkerSize(8);
}

void set_range(vtkAxis* axis, double from, double to) {
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetRange(from, to);
}

/// Ranges that show the window left of a third of the width, with equal scales.
void fit_window(vtkChartXY* chart, const ChartWindow& window) {
  constexpr double share_of_legend = 0.34;
  auto *const x = chart->GetAxis(vtkAxis::BOTTOM), *const y = chart->GetAxis(vtkAxis::LEFT);
  const double width_px = x->GetPoint2()[0] - x->GetPoint1()[0];
  const double height_px = y->GetPoint2()[1] - y->GetPoint1()[1];
  const double units_per_px = std::max((window.x[1] - window.x[0]) / ((1 - share_of_legend) * width_px),
                                       (window.y[1] - window.y[0]) / height_px);
  const double middle_x = (window.x[0] + window.x[1]) / 2, middle_y = (window.y[0] + window.y[1]) / 2;
  const double least_x = middle_x - 0.5 * (1 - share_of_legend) * width_px * units_per_px;
  set_range(x, least_x, least_x + width_px * units_per_px);
  set_range(y, middle_y - 0.5 * height_px * units_per_px, middle_y + 0.5 * height_px * units_per_px);
}

/// @param first  place of the first label; the others follow at distances of 1
void put_labels(vtkAxis* axis, const ChartAxis& wanted, const std::vector<std::string>& labels,
                double first) {
  style(axis, wanted);
  constexpr std::size_t most_labels = 12;
  const std::size_t step = (labels.size() + most_labels - 1) / most_labels;
  vtkNew<vtkDoubleArray> places;
  vtkNew<vtkStringArray> texts;
  for (std::size_t i = 0; i < labels.size(); i += step) {
    places->InsertNextValue(double(i) + first);
    texts->InsertNextValue(labels[i]);
  }
  axis->SetCustomTickPositions(places, texts);
  set_range(axis, first - 0.5, first - 0.5 + double(labels.size()));
}

}  // namespace

void add_or_join(std::vector<ChartCurve>& curves, ChartCurve curve) {
  for (auto& other : curves)
    if (other.x == curve.x && other.y == curve.y) {
      other.name += ", " + curve.name;
      return;
    }
  curves.push_back(std::move(curve));
}

bool write_chart(const LineChart& chart, const std::filesystem::path& file) {
  vtkNew<vtkChartXY> xy;
  style(xy, chart.title);
  for (std::size_t i = 0; i < chart.curves.size(); ++i) add_curve(xy, chart.curves[i], i);
  if (chart.x.names.empty())
    style(xy->GetAxis(vtkAxis::BOTTOM), chart.x);
  else
    put_labels(xy->GetAxis(vtkAxis::BOTTOM), chart.x, chart.x.names, 1);
  auto up = chart.y;
  if (std::any_of(chart.curves.begin(), chart.curves.end(),
                  [](const auto& curve) { return !curve.error.empty(); }))
    up.title += "; bands: stated error";
  style(xy->GetAxis(vtkAxis::LEFT), up);
  xy->SetShowLegend(std::any_of(chart.curves.begin(), chart.curves.end(),
                                [](const auto& curve) { return !curve.name.empty(); }));
  plain(xy->GetLegend()->GetLabelProperties(), label_size - 2);
  xy->GetLegend()->SetInline(chart.has_equal_scales || chart.window.has_value());
  if (chart.window) return draw(xy, file, chart_width, [&] { fit_window(xy, *chart.window); });
  if (chart.is_from_zero) {
    const auto up_to = [&](vtkAxis* axis, std::vector<double> ChartCurve::*values) {
      double most = 0;
      for (const auto& curve : chart.curves)
        for (const double value : curve.*values) most = std::max(most, value);
      set_range(axis, 0, most > 0 ? 1.1 * most : 1);
    };
    up_to(xy->GetAxis(vtkAxis::BOTTOM), &ChartCurve::x);
    up_to(xy->GetAxis(vtkAxis::LEFT), &ChartCurve::y);
  }
  if (const int room = width_of_labels(chart); room > 0 && xy->GetShowLegend()) {
    xy->SetShowLegend(false);
    xy->SetAutoSize(false);
    xy->SetSize(vtkRectf(0, 0, float(chart_width - room), float(chart_height)));
    vtkNew<CurveLabels> labels;
    return draw(
        xy, file, chart_width, [&] { place_labels(xy, chart.curves, labels); }, labels);
  }
  if (!chart.has_equal_scales) return draw(xy, file);
  double most = 0;
  for (const auto& curve : chart.curves)
    for (const auto* values : {&curve.x, &curve.y})
      for (const double value : *values) most = std::max(most, std::abs(value));
  for (const int side : {vtkAxis::BOTTOM, vtkAxis::LEFT})
    set_range(xy->GetAxis(side), -1.1 * most, 1.1 * most);
  return draw(xy, file, chart_height);
}

bool write_chart(const HeatMap& chart, const std::filesystem::path& file) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const double figure : chart.figures)
    if (std::isfinite(figure)) {
      least = std::min(least, figure);
      most = std::max(most, figure);
    }
  if (!(least <= most)) least = most = 0;
  if (least == most) most = least + std::max(1e-300, std::abs(least));
  vtkNew<vtkImageData> image;
  image->SetDimensions(int(chart.x_values.size()), int(chart.y_values.size()), 1);
  image->SetOrigin(0, 0, 0);
  vtkNew<vtkDoubleArray> values;
  values->SetName(chart.figure_title.c_str());
  for (const double figure : chart.figures) values->InsertNextValue(figure);
  image->GetPointData()->SetScalars(values);
  vtkNew<vtkColorTransferFunction> colours;  // colours of even lightness steps: dark blue, green, yellow
  const std::array<std::array<double, 3>, 5> stops{{{0.267, 0.005, 0.329},
                                                    {0.230, 0.322, 0.546},
                                                    {0.128, 0.567, 0.551},
                                                    {0.369, 0.789, 0.383},
                                                    {0.993, 0.906, 0.144}}};
  for (std::size_t i = 0; i < stops.size(); ++i)
    colours->AddRGBPoint(least + (most - least) * double(i) / double(stops.size() - 1), stops[i][0],
                         stops[i][1], stops[i][2]);
  colours->SetNanColor(0.9, 0.9, 0.9);
  colours->Build();
  vtkNew<vtkChartHistogram2D> map;
  style(map, chart.title);
  map->SetInputData(image);
  map->SetTransferFunction(colours);
  put_labels(map->GetAxis(vtkAxis::BOTTOM), {chart.x_title}, chart.x_values, 0.5);
  put_labels(map->GetAxis(vtkAxis::LEFT), {chart.y_title}, chart.y_values, 0.5);
  style(map->GetAxis(vtkAxis::RIGHT), {chart.figure_title, false});
  return draw(map, file);
}

}  // namespace pipelines

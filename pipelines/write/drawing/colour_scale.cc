#include "pipelines/write/drawing/colour_scale.h"

#include <fmt/core.h>
#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>

#include "pipelines/write/drawing/picture_lines.h"

namespace pipelines {
namespace {

constexpr std::array<Colour, 9> light_to_dark{{{244, 241, 228},
                                               {255, 237, 160},
                                               {254, 217, 118},
                                               {254, 178, 76},
                                               {253, 141, 60},
                                               {252, 78, 42},
                                               {227, 26, 28},
                                               {189, 0, 38},
                                               {122, 0, 34}}};

}  // namespace

std::shared_ptr<vtkLookupTable> colours_over(const std::array<double, 2>& range) {
  constexpr int n = 256;
  const auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(n);
  for (int i = 0; i < n; ++i) {
    const double at = double(i) / (n - 1) * (light_to_dark.size() - 1);
    const auto below = std::min(std::size_t(at), light_to_dark.size() - 2);
    std::array<double, 3> rgb{};
    for (std::size_t c = 0; c < 3; ++c)
      rgb[c] = (light_to_dark[below][c] +
                (at - double(below)) * (light_to_dark[below + 1][c] - light_to_dark[below][c])) /
               255;
    table->SetTableValue(i, rgb[0], rgb[1], rgb[2]);
  }
  table->SetTableRange(range[0], range[1]);
  return {table.Get(), [table](vtkLookupTable*) {}};  // the deleter holds VTK's own reference
}

void add_colour_bar(vtkRenderer* renderer, vtkLookupTable* colours, const ColourBar& bar) {
  const double from = colours->GetTableRange()[0], to = colours->GetTableRange()[1];
  const double right = bar.left + bar.width, top = bar.bottom + bar.height;
  const auto y_of = [&](double value) {
    return bar.bottom + std::clamp((value - from) / (to - from), 0.0, 1.0) * bar.height;
  };
  constexpr int n_strips = 128;
  for (int i = 0; i < n_strips; ++i) {
    const double low = bar.bottom + i * bar.height / n_strips, high = low + bar.height / n_strips;
    Drawing strip;
    strip.area({{bar.left, low}, {right, low}, {right, high}, {bar.left, high}});
    const auto* rgb = colours->MapValue(from + (i + 0.5) / n_strips * (to - from));
    strip.put(renderer, {rgb[0], rgb[1], rgb[2]}, 1);
  }
  const double tick = 0.4 * bar.font_size;
  const auto number = [&](double value) {
    return add_words(renderer, fmt::format("{:.4g}", value), bar.font_size, right + 2 * tick,
                     y_of(value) - 0.35 * bar.font_size);
  };
  Drawing ticks, peak;
  for (const double* side : {&bar.left, &right}) ticks.line(*side, bar.bottom, *side, top);
  for (const double end : {bar.bottom, top}) ticks.line(bar.left, end, right, end);
  const double of_a_number = 1.6 * bar.font_size / bar.height;  // share of the bar
  const double step = round_below(2 * (to - from) * std::max(0.1, of_a_number));
  for (double value = step * std::ceil(from / step - 1e-9); value <= to + 1e-9 * step; value += step) {
    if (std::abs(y_of(value) - y_of(bar.peak)) < 1.4 * bar.font_size) continue;
    ticks.line(right, y_of(value), right + tick, y_of(value));
    number(std::abs(value) < 1e-9 * step ? 0 : value);
  }
  ticks.put(renderer, ink, 1.5);
  peak.line(bar.left - tick, y_of(bar.peak), right + 1.5 * tick, y_of(bar.peak));
  peak.put(renderer, ink, 3);
  auto* words = number(bar.peak);
  words->SetInput(fmt::format("{:.4g} {}", bar.peak, bar.unit).c_str());
  words->GetTextProperty()->SetBold(true);
}

}  // namespace pipelines

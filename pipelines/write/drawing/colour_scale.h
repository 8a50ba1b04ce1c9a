/// The colours of a field, and the bar that tells what they stand for.
#pragma once

#include <array>
#include <memory>
#include <string>

#include "pipelines/write/drawing/picture_surface.h"

class vtkLookupTable;
class vtkRenderer;

namespace pipelines {

/// From light to dark, so that they read without hue, and shape shows where the field is small: those of
/// report.html.
std::shared_ptr<vtkLookupTable> colours_over(const std::array<double, 2>& range);

struct ColourBar {
  double left = 0, bottom = 0, width = 0, height = 0;  ///< pixels of the renderer
  std::string unit;
  double peak = 0;  ///< marked at its height
  int font_size = 0;
};

/// The colours with numbers at round steps and at the peak.
void add_colour_bar(vtkRenderer* renderer, vtkLookupTable* colours, const ColourBar& bar);

}  // namespace pipelines

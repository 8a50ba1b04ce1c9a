/// Lines, areas, words and the scale over a picture, in pixels of their renderer.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "pipelines/write/drawing/picture_surface.h"

class vtkRenderer;
class vtkTextActor;

namespace pipelines {

inline constexpr Colour ink{40, 40, 40};

using Pixel = std::array<double, 2>;

/// Lines and areas of one colour.
class Drawing {
public:
  void line(double x0, double y0, double x1, double y1) { lines_.push_back({{x0, y0}, {x1, y1}}); }
  void area(std::vector<Pixel> corners) { areas_.push_back(std::move(corners)); }
  void put(vtkRenderer* renderer, const Colour& colour, double line_width) const;

private:
  std::vector<std::vector<Pixel>> lines_, areas_;
};

/// @return belongs to the renderer
vtkTextActor* add_words(vtkRenderer* renderer, const std::string& words, int size, double x, double y);

/// The largest of 1, 2 or 5 times a power of ten that is no larger; of a positive number.
double round_below(double at_most);

/// A bar of a round length with its length in mm beside it; true in the plane of the picture.
/// @param x, y       of its left end
/// @param at_most    its length [pixels]
/// @return where the words end
double add_scale_bar(vtkRenderer* renderer, double x, double y, double at_most, double m_per_pixel,
                     int font_size);

}  // namespace pipelines

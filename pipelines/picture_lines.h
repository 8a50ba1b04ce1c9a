/// Lines, areas, words and the scale over a picture, in pixels of their renderer.
#pragma once

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <array>
#include <string>
#include <vector>

#include "pipelines/picture_surface.h"

class vtkCellArray;
class vtkPoints;
class vtkRenderer;
class vtkTextActor;

namespace pipelines {

inline constexpr Colour ink{40, 40, 40};

/// Of one colour.
class Drawing {
public:
  Drawing();
  ~Drawing();
  void line(double x0, double y0, double x1, double y1);
  void area(const std::vector<std::array<double, 2>>& corners);
  void put(vtkRenderer* renderer, const Colour& colour, double line_width) const;

private:
  void add(double x, double y, vtkCellArray* cells);
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> lines_, areas_;
};

vtkSmartPointer<vtkTextActor> words_at(vtkRenderer* renderer, const std::string& words, int size, double x,
                                       double y);

/// A bar of a round length with its length in mm beside it; true in the plane of the picture.
/// @param x, y       of its left end
/// @param at_most    its length [pixels]
/// @return where the words end
double add_scale_bar(vtkRenderer* renderer, double x, double y, double at_most, double m_per_pixel,
                     int font_size);

}  // namespace pipelines

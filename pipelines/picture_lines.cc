#include "pipelines/picture_lines.h"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>

#include <cmath>
#include <cstdio>

#include "pipelines/picture_parts.h"

namespace pipelines {
namespace {

/// 1, 2 or 5 times a power of ten.
double round_length(double at_most) {
  const double decade = std::pow(10, std::floor(std::log10(at_most)));
  return decade * (at_most >= 5 * decade ? 5 : at_most >= 2 * decade ? 2 : 1);
}

}  // namespace

Drawing::Drawing() = default;
Drawing::~Drawing() = default;

void Drawing::line(double x0, double y0, double x1, double y1) {
  lines_->InsertNextCell(2);
  add(x0, y0, lines_);
  add(x1, y1, lines_);
}

void Drawing::area(const std::vector<std::array<double, 2>>& corners) {
  areas_->InsertNextCell(int(corners.size()));
  for (const auto& corner : corners) add(corner[0], corner[1], areas_);
}

void Drawing::put(vtkRenderer* renderer, const Colour& colour, double line_width) const {
  vtkNew<vtkPolyData> data;
  data->SetPoints(points_);
  data->SetLines(lines_);
  data->SetPolys(areas_);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colour[0] / 255., colour[1] / 255., colour[2] / 255.);
  actor->GetProperty()->SetLineWidth(float(line_width));
  renderer->AddActor2D(actor);
}

void Drawing::add(double x, double y, vtkCellArray* cells) {
  cells->InsertCellPoint(points_->InsertNextPoint(x, y, 0));
}

vtkSmartPointer<vtkTextActor> words_at(vtkRenderer* renderer, const std::string& words, int size, double x,
                                       double y) {
  auto text = text_at(words, size, 0, 0);
  text->GetPositionCoordinate()->SetCoordinateSystemToViewport();
  text->GetPositionCoordinate()->SetValue(x, y);
  renderer->AddActor2D(text);
  return text;
}

double add_scale_bar(vtkRenderer* renderer, double x, double y, double at_most, double m_per_pixel,
                     int font_size) {
  const double length_m = round_length(at_most * m_per_pixel), right = x + length_m / m_per_pixel;
  Drawing bar;
  bar.line(x, y, right, y);
  bar.line(x, y - 6, x, y + 6);
  bar.line(right, y - 6, right, y + 6);
  bar.put(renderer, ink, 2);
  char words[40];
  std::snprintf(words, sizeof words, "%g mm", length_m * 1e3);
  const auto text = words_at(renderer, words, font_size, right + 12, y - 7);
  double box[4];
  text->GetBoundingBox(renderer, box);
  return right + 12 + box[1] - box[0];
}

}  // namespace pipelines

#include "pipelines/write/drawing/picture_lines.h"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <cmath>
#include <cstdio>

#include "pipelines/write/drawing/picture_parts.h"

namespace pipelines {
namespace {

vtkSmartPointer<vtkCellArray> cells_of(const std::vector<std::vector<Pixel>>& shapes, vtkPoints* points) {
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  for (const auto& shape : shapes) {
    cells->InsertNextCell(int(shape.size()));
    for (const auto& corner : shape) cells->InsertCellPoint(points->InsertNextPoint(corner[0], corner[1], 0));
  }
  return cells;
}

}  // namespace

void Drawing::put(vtkRenderer* renderer, const Colour& colour, double line_width) const {
  vtkNew<vtkPoints> points;
  vtkNew<vtkPolyData> data;
  data->SetLines(cells_of(lines_, points));
  data->SetPolys(cells_of(areas_, points));
  data->SetPoints(points);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colour[0] / 255., colour[1] / 255., colour[2] / 255.);
  actor->GetProperty()->SetLineWidth(float(line_width));
  renderer->AddActor2D(actor);
}

vtkTextActor* add_words(vtkRenderer* renderer, const std::string& words, int size, double x, double y) {
  auto* text = add_text(renderer, words, size, 0, 0);
  text->GetPositionCoordinate()->SetCoordinateSystemToViewport();
  text->GetPositionCoordinate()->SetValue(x, y);
  return text;
}

double round_below(double at_most) {
  const double decade = std::pow(10, std::floor(std::log10(at_most)));
  return decade * (at_most >= 5 * decade ? 5 : at_most >= 2 * decade ? 2 : 1);
}

double add_scale_bar(vtkRenderer* renderer, double x, double y, double at_most, double m_per_pixel,
                     int font_size) {
  const double length_m = round_below(at_most * m_per_pixel), right = x + length_m / m_per_pixel;
  Drawing bar;
  bar.line(x, y, right, y);
  bar.line(x, y - 6, x, y + 6);
  bar.line(right, y - 6, right, y + 6);
  bar.put(renderer, ink, 2);
  char words[40];
  std::snprintf(words, sizeof words, "%g mm", length_m * 1e3);
  auto* text = add_words(renderer, words, font_size, right + 12, y - 7);
  double box[4];
  text->GetBoundingBox(renderer, box);
  return right + 12 + box[1] - box[0];
}

}  // namespace pipelines

#include "pipelines/write/drawing/picture_parts.h"

#include <vtkActor.h>
#include <vtkAxesActor.h>
#include <vtkCamera.h>
#include <vtkCaptionActor2D.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/disk/open_directory.h"
#include "pipelines/base/files/atomic_file.h"

namespace pipelines {

void plain(vtkTextProperty* text, int size) {
  text->SetFontFamilyToArial();
  text->SetFontSize(size);
  text->SetColor(0.1, 0.1, 0.1);
  text->BoldOff();
  text->ItalicOff();
  text->ShadowOff();
  text->SetLineSpacing(1.4);
}

vtkTextActor* add_text(vtkRenderer* renderer, const std::string& words, int size, double x, double y) {
  vtkNew<vtkTextActor> text;
  text->SetInput(words.c_str());
  plain(text->GetTextProperty(), size);
  text->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  text->GetPositionCoordinate()->SetValue(x, y);
  renderer->AddActor2D(text);
  return text;
}

void add_lines(vtkRenderer* renderer, vtkPolyData* lines, double grey, double opacity) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(lines);
  mapper->ScalarVisibilityOff();
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyLineOffsetParameters(0, -4);
  vtkNew<vtkActor> actor;
  actor->GetProperty()->SetColor(grey, grey, grey);
  actor->GetProperty()->SetOpacity(opacity);
  actor->GetProperty()->SetLineWidth(1);
  actor->GetProperty()->LightingOff();
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
}

vtkRenderer* add_renderer(vtkRenderWindow* window, double left, double bottom, double right, double top) {
  vtkNew<vtkRenderer> renderer;
  renderer->SetViewport(left, bottom, right, top);
  renderer->SetBackground(1, 1, 1);
  window->AddRenderer(renderer);
  return renderer;
}

void look(vtkRenderer* renderer, const View& view, const Frame& frame, double width_over_height,
          double all_depth) {
  auto* camera = renderer->GetActiveCamera();
  const std::array<Vector, 3> axes = view.axes();
  Vector eye = frame.centre;
  for (std::size_t d = 0; d < 3; ++d) eye[d] += 2 * frame.half_depth * axes[2][d];
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(frame.centre.data());
  camera->SetPosition(eye.data());
  camera->SetViewUp(axes[1].data());
  camera->SetParallelScale(std::max(frame.half_height, frame.half_width / width_over_height));
  camera->SetClippingRange(0.95 * frame.half_depth, 2 * frame.half_depth + all_depth);
}

void add_triad(vtkRenderer* renderer, vtkRenderer* like) {
  vtkNew<vtkAxesActor> axes;
  axes->SetShaftTypeToCylinder();
  axes->SetCylinderRadius(0.04);
  axes->SetConeRadius(0.3);
  axes->SetXAxisLabelText("x");
  axes->SetYAxisLabelText("y");
  axes->SetZAxisLabelText("z");
  for (auto* caption :
       {axes->GetXAxisCaptionActor2D(), axes->GetYAxisCaptionActor2D(), axes->GetZAxisCaptionActor2D()}) {
    plain(caption->GetCaptionTextProperty(), 20);
    caption->GetTextActor()->SetTextScaleModeToNone();
  }
  renderer->AddActor(axes);
  auto* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  const double* forward = like->GetActiveCamera()->GetDirectionOfProjection();
  camera->SetFocalPoint(0, 0, 0);
  camera->SetPosition(-5 * forward[0], -5 * forward[1], -5 * forward[2]);
  camera->SetViewUp(like->GetActiveCamera()->GetViewUp());
  camera->SetParallelScale(1.4);
  camera->SetClippingRange(0.1, 10);
}

void write_png(vtkRenderWindow* window, const std::filesystem::path& png) {
  window->Render();
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->SetInputBufferTypeToRGB();
  image->ReadFrontBufferOff();
  image->ShouldRerenderOff();
  AtomicFile file(png);
  vtkNew<vtkPNGWriter> writer;
  writer->SetCompressionLevel(6);  // 9 takes longer for 5 % fewer bytes
  writer->SetFileName(file.temporary().c_str());
  writer->SetInputConnection(image->GetOutputPort());
  writer->Write();
  if (writer->GetErrorCode() != 0)
    throw FileError(shown(png) + ": cannot be written; check the directory and the free space");
  file.commit(std::string_view("\0\0\0\0IEND\xAE\x42\x60\x82", 12));
}

}  // namespace pipelines

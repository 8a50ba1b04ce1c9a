#include "pipelines/write/pictures/port_views.h"

#include <vtkActor.h>
#include <vtkCellData.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

#include "pipelines/base/common/constants.h"
#include "pipelines/write/drawing/offscreen_window.h"
#include "pipelines/write/drawing/picture_parts.h"

namespace pipelines {
namespace {

constexpr double degree = pi / 180;

/// The view from `near` turned towards `right`, then raised.
View turned(const Vector& near, const Vector& right, double turn, double raise) {
  Vector up, eye;
  vtkMath::Cross(near.data(), right.data(), up.data());
  for (std::size_t d = 0; d < 3; ++d)
    eye[d] =
        std::cos(raise) * (std::cos(turn) * near[d] + std::sin(turn) * right[d]) + std::sin(raise) * up[d];
  return {eye, up};
}

const PortShape& shape_of(const PortBody& body, const PortView& view) {
  return view.cut ? body.half : body.whole;
}

vtkSmartPointer<vtkActor> surface_actor(vtkPolyData* surface, const char* colours) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface);
  auto actor = vtkSmartPointer<vtkActor>::New();
  if (colours) {
    mapper->SetScalarModeToUseCellFieldData();
    mapper->SelectColorArray(colours);
    mapper->SetColorModeToDirectScalars();
  } else {
    mapper->ScalarVisibilityOff();
  }
  actor->SetMapper(mapper);
  actor->GetProperty()->SetAmbient(0.45);
  actor->GetProperty()->SetDiffuse(0.6);
  return actor;
}

/// What a pair of views shows, of each port the share of the best view of it.
double worth(const std::vector<std::vector<double>>& shares, std::size_t a, std::size_t b, double* least) {
  double sum = 0;
  *least = 1;
  for (std::size_t p = 0; p < shares[a].size(); ++p) {
    const double share = std::max(shares[a][p], shares[b][p]);
    sum += share;
    *least = std::min(*least, share);
  }
  return sum;
}

}  // namespace

std::vector<PortView> possible_views(const double* bounds, const std::optional<CutPlane>& cut) {
  std::vector<PortView> views;
  if (is_long(bounds)) {
    const Vector near = cut ? cut->normal : Vector{-1, 0, 0}, right{0, 0, 1};
    views.push_back({"seen from the right", turned(near, right, 25 * degree, 14 * degree)});
    views.push_back({"seen from the left", turned(near, right, -25 * degree, 14 * degree)});
    if (cut)
      views.push_back({"cut open through its axis", turned(near, right, 20 * degree, 10 * degree), true});
    return views;
  }
  const Vector up{0, 1, 0};
  views.push_back({"seen from the front", {{-0.55, 0.4, 0.8}, up}});
  views.push_back({"seen from the front, below", {{-0.55, -0.45, 0.8}, up}});
  views.push_back({"seen from behind", {{0.55, 0.4, -0.8}, up}});
  views.push_back({"seen from behind, below", {{0.55, -0.45, -0.8}, up}});
  if (cut) {
    // The plane contains z; its other direction runs to the right.
    const Vector z{0, 0, 1};
    Vector right;
    vtkMath::Cross(cut->normal.data(), z.data(), right.data());
    views.push_back(
        {"cut open through its axes", turned(cut->normal, right, 18 * degree, -35 * degree), true});
  }
  return views;
}

void add_body(vtkRenderer* renderer, const PortBody& body, const PortView& view, bool ids) {
  const auto& shape = shape_of(body, view);
  const auto surface = surface_actor(shape.surface.get(), ids ? port_arrays::id : port_arrays::colour);
  renderer->AddActor(surface);
  if (ids) surface->GetProperty()->LightingOff();
  if (view.cut) {
    const auto face = surface_actor(body.face.get(), nullptr);
    if (ids)
      face->GetProperty()->SetColor(0, 1. / 255, 0);
    else
      face->GetProperty()->SetColor(0.58, 0.58, 0.58);
    face->GetProperty()->LightingOff();
    renderer->AddActor(face);
  }
  if (!ids) add_lines(renderer, shape.edges.get(), 0.2, 0.22);
}

Frame frame_of(const PortBody& body, const PortView& view) {
  return frame_of(shape_of(body, view).surface.get(), view.view);
}

std::vector<SeenPort> see_ports(const PortBody& body, const PortView& view, const Frame& frame, int width,
                                int height) {
  const auto window = make_offscreen_window();
  if (!window) return {};
  window->SetSize(width, height);
  window->SetMultiSamples(0);
  auto* renderer = add_renderer(window.get(), 0, 0, 1, 1);
  add_body(renderer, body, view, true);
  look(renderer, view.view, frame, double(width) / height, 4 * frame.half_depth);
  window->Render();
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetPixelData(0, 0, width - 1, height - 1, 0, pixels);

  PortPixels ports{width, height, {}};
  ports.port.reserve(std::size_t(width) * std::size_t(height));
  for (vtkIdType i = 0; i < vtkIdType(width) * height; ++i) {
    const unsigned char* rgb = pixels->GetPointer(3 * i);
    ports.port.push_back(rgb[1] == 1 ? std::size_t(rgb[0]) * 256 + rgb[2] : 0);
  }
  return seen_ports(ports, body.ports.size());
}

std::vector<PortView> choose_views(const PortBody& body, const std::vector<PortView>& possible) {
  std::vector<std::vector<double>> shares;
  std::vector<double> most(body.ports.size(), 1);
  for (const auto& view : possible) {
    const auto seen = see_ports(body, view, frame_of(body, view), 600, 400);
    if (seen.size() != body.ports.size()) return {};
    shares.emplace_back();
    for (std::size_t p = 0; p < seen.size(); ++p) {
      shares.back().push_back(double(seen[p].n_pixels));
      most[p] = std::max(most[p], shares.back().back());
    }
  }
  for (auto& of_view : shares)
    for (std::size_t p = 0; p < of_view.size(); ++p) of_view[p] /= most[p];

  double least = 0;
  constexpr double well = 0.3;
  for (std::size_t a = 0; a < possible.size(); ++a) {
    worth(shares, a, a, &least);
    if (least >= well) return {possible[a]};
  }
  std::size_t best_a = 0, best_b = 0;
  double best = -1;
  for (std::size_t a = 0; a < possible.size(); ++a)
    for (std::size_t b = a + 1; b < possible.size(); ++b)
      if (const double sum = worth(shares, a, b, &least) + (least >= well ? 100 : 0); sum > best + 0.05) {
        best = sum;
        best_a = a;
        best_b = b;
      }
  return {possible[best_a], possible[best_b]};
}

}  // namespace pipelines

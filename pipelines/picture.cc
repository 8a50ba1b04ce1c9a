#include "pipelines/picture.h"

#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkColorTransferFunction.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty.h>
#include <vtkProperty2D.h>
#include <vtkRegularPolygonSource.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

#include "pipelines/offscreen_window.h"
#include "pipelines/picture_parts.h"
#include "pipelines/picture_surface.h"

namespace pipelines {
namespace {

/// Viridis, the colour map of matplotlib: even steps in lightness, legible in grey and to the colour-blind.
vtkSmartPointer<vtkLookupTable> colours(const std::array<double, 2>& range) {
  constexpr std::array<std::array<double, 3>, 11> viridis = {{{0.267004, 0.004874, 0.329415},
                                                              {0.282623, 0.140926, 0.457517},
                                                              {0.253935, 0.265254, 0.529983},
                                                              {0.206756, 0.371758, 0.553117},
                                                              {0.163625, 0.471133, 0.558148},
                                                              {0.127568, 0.566949, 0.550556},
                                                              {0.134692, 0.658636, 0.517649},
                                                              {0.266941, 0.748751, 0.440573},
                                                              {0.477504, 0.821444, 0.318195},
                                                              {0.741388, 0.873449, 0.149561},
                                                              {0.993248, 0.906157, 0.143936}}};
  vtkNew<vtkColorTransferFunction> between;
  between->SetColorSpaceToLab();
  for (std::size_t i = 0; i < viridis.size(); ++i)
    between->AddRGBPoint(static_cast<double>(i) / (viridis.size() - 1), viridis[i][0], viridis[i][1],
                         viridis[i][2]);
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(256);
  for (int i = 0; i < 256; ++i) {
    const double* rgb = between->GetColor(i / 255.);
    table->SetTableValue(i, rgb[0], rgb[1], rgb[2]);
  }
  table->SetTableRange(range[0], range[1]);
  return table;
}

vtkSmartPointer<vtkActor> actor_of(vtkPolyData* data, vtkLookupTable* table) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetLookupTable(table);
  mapper->UseLookupTableScalarRangeOn();
  mapper->InterpolateScalarsBeforeMappingOn();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->GetProperty()->SetAmbient(0.35);
  actor->GetProperty()->SetDiffuse(0.7);
  actor->GetProperty()->SetSpecular(0.08);
  actor->GetProperty()->SetSpecularPower(30);
  actor->SetMapper(mapper);
  return actor;
}

/// A ring around a place of the body that keeps its size in pixels.
vtkSmartPointer<vtkActor2D> ring_at(const Vector& at, double radius) {
  vtkNew<vtkRegularPolygonSource> circle;
  circle->SetNumberOfSides(48);
  circle->SetRadius(radius);
  circle->GeneratePolygonOff();
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputConnection(circle->GetOutputPort());
  auto ring = vtkSmartPointer<vtkActor2D>::New();
  ring->SetMapper(mapper);
  ring->GetPositionCoordinate()->SetCoordinateSystemToWorld();
  ring->GetPositionCoordinate()->SetValue(at[0], at[1], at[2]);
  ring->GetProperty()->SetColor(0.85, 0.1, 0.1);
  ring->GetProperty()->SetLineWidth(3);
  return ring;
}

vtkSmartPointer<vtkScalarBarActor> colour_bar(vtkLookupTable* table, const std::string& unit, int font_size) {
  auto bar = vtkSmartPointer<vtkScalarBarActor>::New();
  bar->SetLookupTable(table);
  bar->SetTitle(unit.c_str());
  bar->SetNumberOfLabels(6);
  bar->SetLabelFormat("%.4g");
  bar->UnconstrainedFontSizeOn();
  plain(bar->GetTitleTextProperty(), font_size);
  plain(bar->GetLabelTextProperty(), font_size);
  bar->SetVerticalTitleSeparation(font_size / 2);
  bar->SetTextPad(font_size / 3);
  bar->SetBarRatio(0.35);
  bar->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  bar->GetPositionCoordinate()->SetValue(0.12, 0.06);
  bar->SetWidth(0.3);
  bar->SetHeight(0.68);
  return bar;
}

}  // namespace

bool write_picture(const std::filesystem::path& vtu, const std::string& field, const std::string& title,
                   const std::string& unit, const std::filesystem::path& png, const PictureOptions& options) {
  const auto window = make_offscreen_window();
  if (!window) return false;

  const auto faces = boundary_faces(vtu, field, options.scale);
  const auto surface = smooth_surface(faces.get(), options.subdivisions);
  const auto edge_lines = curved_edges(faces.get());
  const SurfacePeak peak = peak_of(faces.get(), surface.get());
  const View view = view_of(surface->GetBounds(), peak.normal);
  const double lowest = surface->GetPointData()->GetScalars()->GetRange()[0];
  const double from = std::min(0., lowest);
  const auto table =
      colours(options.range.value_or(std::array<double, 2>{from, peak.value > from ? peak.value : from + 1}));
  const auto body = actor_of(surface.get(), table);
  const auto edges = line_actor(edge_lines.get(), 0.25, 1);

  window->SetSize(options.width, options.height);
  window->SetMultiSamples(4);
  const double split = 0.48, head = 0.07, detail_width = 0.72, gap = 0.02;
  const int font_size = std::max(10, options.height / 45);
  const auto add = [&](double left, double bottom, double right, double top) {
    return add_renderer(window.get(), left, bottom, right, top);
  };
  add(0, 0, 1, 1);  // white where the others leave gaps
  const auto heading = add(0, 1 - head, 1, 1), whole = add(0, split, 1, 1 - head),
             detail = add(gap, gap, detail_width, split - gap), legend = add(detail_width, 0, 1, split);

  Frame all = frame_of(surface.get(), view);
  for (const auto& [renderer, show_edges] : {std::pair(whole, false), std::pair(detail, options.edges)}) {
    renderer->AddActor(body);
    if (show_edges) renderer->AddActor(edges);
  }
  whole->AddActor(ring_at(peak.at, font_size));
  all.half_width *= 1.06;
  all.half_height *= 1.1;
  const double pixel_ratio = double(options.width) / options.height;
  look(whole, view, all, pixel_ratio / (1 - head - split), 4 * all.half_depth);
  const double extent = std::max({all.half_width, all.half_height, all.half_depth});
  const double half_detail = std::clamp(options.detail, 1e-3, 1.) * extent;
  look(detail, view, {peak.at, half_detail, 0, half_detail},
       pixel_ratio * (detail_width - gap) / (split - 2 * gap), 4 * extent);

  add_triad(add(1 - 0.13, gap, 1, gap + 0.22), whole);

  heading->AddActor2D(text_at(title, font_size * 4 / 3, 0.02, 0.25));
  char words[200];
  std::snprintf(words, sizeof(words), "maximum %.4g %s\nat x = %.1f, y = %.1f, z = %.1f mm", peak.value,
                unit.c_str(), 1e3 * peak.at[0], 1e3 * peak.at[1], 1e3 * peak.at[2]);
  legend->AddActor2D(text_at(words, font_size, 0.12, 0.8));
  legend->AddActor2D(colour_bar(table, unit, font_size));
  write_png(window.get(), png);
  return true;
}

}  // namespace pipelines

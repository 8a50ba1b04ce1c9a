#include "pipelines/write/pictures/picture.h"

#include <fmt/core.h>
#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkClipPolyData.h>
#include <vtkCoordinate.h>
#include <vtkDataObject.h>
#include <vtkFloatArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkNonMergingPointLocator.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty.h>
#include <vtkProperty2D.h>
#include <vtkRegularPolygonSource.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "pipelines/base/common/constants.h"
#include "pipelines/write/drawing/colour_scale.h"
#include "pipelines/write/drawing/cut_surface.h"
#include "pipelines/write/drawing/note_boxes.h"
#include "pipelines/write/drawing/offscreen_window.h"
#include "pipelines/write/drawing/picture_lines.h"
#include "pipelines/write/drawing/picture_parts.h"
#include "pipelines/write/drawing/picture_surface.h"

namespace pipelines {
namespace {

constexpr Colour governing_blue{0, 90, 181};
constexpr std::array<double, 2> hatching{0.85, 0.55};  // grey of its stripes

vtkSmartPointer<vtkActor> actor_of(vtkPolyData* data, vtkLookupTable* table) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetLookupTable(table);
  mapper->UseLookupTableScalarRangeOn();
  mapper->InterpolateScalarsBeforeMappingOn();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->GetProperty()->SetAmbient(0.5);
  actor->GetProperty()->SetDiffuse(0.55);
  actor->GetProperty()->SetSpecular(0.08);
  actor->GetProperty()->SetSpecularPower(30);
  actor->SetMapper(mapper);
  return actor;
}

vtkSmartPointer<vtkActor> plain_actor(vtkPolyData* data, double grey) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(grey, grey, grey);
  return actor;
}

/// Stripes across x + y + z, which show on the faces of most bodies.
/// @param width  width of a light and a dark one together
vtkSmartPointer<vtkActor> hatched_actor(vtkPolyData* data, double width) {
  vtkNew<vtkFloatArray> along;
  double least = std::numeric_limits<double>::max(), most = std::numeric_limits<double>::lowest();
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
    const double* x = data->GetPoint(i);
    along->InsertNextValue(float((x[0] + x[1] + x[2]) / (std::sqrt(3.0) * width)));
    least = std::min(least, double(along->GetValue(i)));
    most = std::max(most, double(along->GetValue(i)));
  }
  constexpr int most_stripes = 1024;
  const int n = std::clamp(int(std::ceil(most - least)), 1, most_stripes);
  vtkNew<vtkLookupTable> stripes;
  stripes->SetNumberOfTableValues(2 * n);
  for (int i = 0; i < 2 * n; ++i) {
    const double grey = hatching[std::size_t(i % 2)];
    stripes->SetTableValue(i, grey, grey, grey);
  }
  stripes->SetTableRange(least, least + n);
  vtkNew<vtkPolyData> striped;
  striped->ShallowCopy(data);
  striped->GetPointData()->SetScalars(along);
  return actor_of(striped, stripes);
}

/// Adds a ring around a place of the body that keeps its size in pixels, between two white ones.
void add_ring(vtkRenderer* renderer, const Vector& at, double radius, const Colour& colour) {
  constexpr double apart = 3;  // of one on another only one would show
  for (const double beside : {-apart, 0.0, apart}) {
    const Colour own = beside == 0 ? colour : Colour{255, 255, 255};
    vtkNew<vtkRegularPolygonSource> circle;
    circle->SetNumberOfSides(48);
    circle->SetRadius(radius + beside);
    circle->GeneratePolygonOff();
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputConnection(circle->GetOutputPort());
    vtkNew<vtkActor2D> ring;
    ring->SetMapper(mapper);
    ring->GetPositionCoordinate()->SetCoordinateSystemToWorld();
    ring->GetPositionCoordinate()->SetValue(at[0], at[1], at[2]);
    ring->GetProperty()->SetColor(own[0] / 255., own[1] / 255., own[2] / 255.);
    ring->GetProperty()->SetLineWidth(beside == 0 ? 3.5F : 2.F);
    renderer->AddActor2D(ring);
  }
}

/// Some of the triangles of a surface, over its points.
vtkSmartPointer<vtkPolyData> triangles_of(vtkPolyData* surface, vtkCellArray* triangles) {
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(surface->GetPoints());
  result->SetPolys(triangles);
  result->GetPointData()->ShallowCopy(surface->GetPointData());
  return result;
}

/// A surface in parts: coloured where the field counts, hatched where it does not.
struct SurfaceParts {
  std::vector<vtkSmartPointer<vtkPolyData>> coloured, hatched;
};

/// Triangles on the border between both are cut along it.
SurfaceParts parts_of(vtkPolyData* surface) {
  auto* within = surface->GetPointData()->GetArray(border_array);
  vtkNew<vtkCellArray> coloured, hatched, between;
  for (vtkIdType c = 0; c < surface->GetPolys()->GetNumberOfCells(); ++c) {
    vtkIdType n = 0;
    const vtkIdType* points = nullptr;
    surface->GetPolys()->GetCellAtId(c, n, points);
    const auto n_excluded =
        std::count_if(points, points + n, [&](vtkIdType i) { return within->GetComponent(i, 0) > 0; });
    (n_excluded == 0 ? coloured : n_excluded == n ? hatched : between)->InsertNextCell(n, points);
  }
  SurfaceParts parts{{triangles_of(surface, coloured)}, {}};
  if (hatched->GetNumberOfCells() > 0) parts.hatched = {triangles_of(surface, hatched)};
  if (between->GetNumberOfCells() == 0) return parts;
  const auto border = triangles_of(surface, between);
  const std::string shown = border->GetPointData()->GetScalars()->GetName();
  border->GetPointData()->SetActiveScalars(border_array);  // vtkClipPolyData looks at the active ones only
  vtkNew<vtkClipPolyData> clip;
  clip->SetInputData(border);
  clip->SetLocator(vtkNew<vtkNonMergingPointLocator>());  // merging takes long where cells crowd
  clip->SetValue(0);
  clip->InsideOutOn();
  clip->GenerateClippedOutputOn();
  clip->Update();
  clip->GetOutput()->GetPointData()->SetActiveScalars(shown.c_str());
  parts.coloured.push_back(clip->GetOutput());
  parts.hatched.push_back(clip->GetClippedOutput());
  return parts;
}

/// The surface that is drawn, and where it is cut.
struct Drawn {
  std::shared_ptr<vtkPolyData> surface, edges, section;
};

/// @param stripe  width of the hatching
void add_drawn(vtkRenderer* renderer, const Drawn& drawn, const SurfaceParts& parts, vtkLookupTable* table,
               double stripe, bool with_edges) {
  for (const auto& part : parts.coloured) renderer->AddActor(actor_of(part, table));
  for (const auto& part : parts.hatched)
    if (part->GetNumberOfPoints() > 0) renderer->AddActor(hatched_actor(part, stripe));
  if (drawn.section) renderer->AddActor(plain_actor(drawn.section.get(), 0.58));
  if (with_edges) add_lines(renderer, drawn.edges.get(), 0.25, 1);
}

/// Places of the parts of a picture, in shares of it: left, bottom, right, top.
struct Layout {
  using Place = std::array<double, 4>;
  Place whole, detail, legend;
};
constexpr double head = 0.07, gap = 0.02;
constexpr Layout one_above_the_other = {{0, 0.48, 1, 1 - head}, {gap, gap, 0.72, 0.46}, {0.72, 0, 1, 0.48}};
constexpr Layout side_by_side = {
    {0, gap, 0.5, 1 - head}, {0.5, 0.46, 1 - gap, 1 - head}, {0.5, 0, 0.78, 0.46}};

double width_over_height(const Layout::Place& place, const PictureOptions& options) {
  return (place[2] - place[0]) * options.width / ((place[3] - place[1]) * options.height);
}

constexpr double single_precision = 1e-6;  // m: what VTK's filters leave of places on bodies of a few metres

double distance(const Vector& a, const Vector& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// How often faces are cut into four to look round: where they are many, each is small in the picture, and
/// drawing without a graphics card takes its time for each triangle.
int pieces_of(vtkIdType n_faces, int wanted) {
  constexpr double most_triangles = 1.2e5;
  int pieces = std::clamp(wanted, 0, 5);
  while (pieces > 1 && 2 * double(n_faces) * std::pow(4, pieces) > most_triangles) --pieces;
  return pieces;
}

/// Pixel where a renderer whose camera is set shows a place.
Pixel pixel_of(vtkRenderer* renderer, const Vector& at) {
  vtkNew<vtkCoordinate> place;
  place->SetCoordinateSystemToWorld();
  place->SetValue(at[0], at[1], at[2]);
  const int* pixel = place->GetComputedViewportValue(renderer);
  return {double(pixel[0]), double(pixel[1])};
}

/// Words in boxes beside the places that a renderer shows, in front of all; a line leads from a box that had
/// to make room to its place.
/// @param width, height  of the renderer in pixels
void add_notes(vtkRenderer* renderer, const std::vector<PictureMark>& notes, double width, double height,
               int font_size) {
  std::vector<vtkTextActor*> texts;
  std::vector<Pixel> places;
  std::vector<NoteBox> boxes;
  for (const auto& note : notes) {
    const auto place = pixel_of(renderer, note.at_m);
    if (place[0] < 0 || place[0] > width || place[1] < 0 || place[1] > height) continue;
    auto* text = add_words(renderer, note.text, font_size, place[0], place[1]);
    text->GetTextProperty()->SetBold(true);
    text->GetTextProperty()->SetBackgroundColor(1, 1, 1);
    text->GetTextProperty()->SetBackgroundOpacity(0.7);
    double box[4];
    text->GetBoundingBox(renderer, box);
    texts.push_back(text);
    places.push_back(place);
    boxes.push_back({place[0] + font_size, place[1] + font_size, box[1] - box[0], box[3] - box[2]});
  }
  const auto moved = moved_apart(boxes, 0.3 * font_size, width, height);
  Drawing leaders;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    texts[i]->GetPositionCoordinate()->SetValue(moved[i].left, moved[i].bottom);
    leaders.line(places[i][0], places[i][1],
                 std::clamp(places[i][0], moved[i].left, moved[i].left + moved[i].width),
                 std::clamp(places[i][1], moved[i].bottom, moved[i].bottom + moved[i].height));
  }
  leaders.put(renderer, ink, 1.5);
}

/// Lines of the legend from above, each entry with its sign before it.
class Legend {
public:
  Legend(vtkRenderer* renderer, double width, double height, int font_size)
      : renderer_(renderer), x_(0.12 * width), y_(0.95 * height), font_size_(font_size) {}

  void add(const std::string& words) {
    auto* text = add_words(renderer_, words, font_size_, x_, y_);
    text->GetTextProperty()->SetVerticalJustificationToTop();
    y_ -= (1.35 + 1.4 * double(std::count(words.begin(), words.end(), '\n'))) * font_size_;
  }
  void add_ringed(const std::string& words, const Colour& colour) {
    Drawing ring;
    const double radius = 0.4 * font_size_;
    const auto at = [&](int i) {
      return Pixel{sign_x() + radius * std::cos(i * pi / 12), sign_y() + radius * std::sin(i * pi / 12)};
    };
    for (int i = 0; i < 24; ++i) ring.line(at(i)[0], at(i)[1], at(i + 1)[0], at(i + 1)[1]);
    ring.put(renderer_, colour, 3.5);
    add(words);
  }
  void add_hatched(const std::string& words) {
    const double half = 0.45 * font_size_;
    for (int i = 0; i < 4; ++i) {
      Drawing stripe;
      const double left = sign_x() - half + i * half / 2, right = left + half / 2;
      stripe.area({{left, sign_y() - half},
                   {right, sign_y() - half},
                   {right, sign_y() + half},
                   {left, sign_y() + half}});
      const auto grey = static_cast<unsigned char>(255 * hatching[std::size_t(i % 2)]);
      stripe.put(renderer_, {grey, grey, grey}, 1);
    }
    add(words);
  }
  /// Where the next line would begin.
  double y() const { return y_; }
  double x() const { return x_; }

private:
  double sign_x() const { return x_ - font_size_; }
  double sign_y() const { return y_ - 0.5 * font_size_; }

  vtkRenderer* renderer_;
  double x_, y_;
  int font_size_;
};

/// What is ringed, and what is hatched; below it the colours.
void add_legend(Legend legend, vtkRenderer* renderer, vtkLookupTable* colours, ColourBar bar,
                const SurfacePeak& peak, const PictureOptions& options, bool some_excluded) {
  const auto place = [](const Vector& at) {
    return fmt::format("at x = {:.1f}, y = {:.1f}, z = {:.1f} mm", 1e3 * at[0], 1e3 * at[1], 1e3 * at[2]);
  };
  const auto largest = fmt::format("{:.4g} {}", peak.value, bar.unit);
  if (!options.mark) legend.add_ringed("maximum " + largest + '\n' + place(peak.at), governing_blue);
  if (options.mark) legend.add_ringed(options.mark->text + '\n' + place(options.mark->at_m), governing_blue);
  if (options.mark && distance(options.mark->at_m, peak.at) > single_precision)
    legend.add_ringed("largest in colour: " + largest + '\n' + place(peak.at), ink);
  if (!options.notes.empty()) legend.add("boxes: " + options.notes_are);
  if (some_excluded)
    legend.add_hatched(options.excluded_is.empty() ? "beside a sharp edge" : options.excluded_is);
  bar.left = legend.x();
  bar.bottom = 1.2 * bar.font_size;
  bar.height = legend.y() - 1.5 * bar.font_size - bar.bottom;
  add_colour_bar(renderer, colours, bar);
}

}  // namespace

bool write_picture(const std::filesystem::path& vtu, const std::string& field, const std::string& title,
                   const std::string& unit, const std::filesystem::path& png, const PictureOptions& options) {
  const auto window = make_offscreen_window();
  if (!window) return false;

  const auto faces = boundary_faces(vtu, field, options.scale, options.excluded, options.beyond);
  const int pieces = pieces_of(faces->GetNumberOfCells(), options.subdivisions);
  Drawn drawn{smooth_surface(faces.get(), pieces), {}, {}};
  const SurfacePeak peak = peak_of(faces.get(), drawn.surface.get());
  const Vector shown = options.mark ? options.mark->at_m : peak.at;
  const double* bounds = faces->GetBounds();
  const SurfaceView seen = view_of_place(drawn.surface.get(), shown, normal_at(drawn.surface.get(), shown));
  const View& view = seen.view;
  const double lowest = drawn.surface->GetPointData()->GetScalars()->GetRange()[0];
  const double from = std::min(0., lowest);
  const auto table = colours_over(
      options.range.value_or(std::array<double, 2>{from, peak.value > from ? peak.value : from + 1}));
  const bool some_excluded = drawn.surface->GetPointData()->GetArray(border_array)->GetRange()[1] > 0;
  Frame all = frame_of(drawn.surface.get(), view);
  all.half_width *= 1.06;
  all.half_height *= 1.1;
  const double extent = std::max({all.half_width, all.half_height, all.half_depth});
  const double half_detail = std::clamp(options.detail, 1e-3, 1.) * extent;
  const Layout& layout = is_long(bounds) ? one_above_the_other : side_by_side;
  constexpr double least_pixels = 6;  // between two lines of the mesh
  drawn.edges =
      curved_edges(faces.get(), 1 << pieces,
                   least_pixels * 2 * half_detail / ((layout.detail[3] - layout.detail[1]) * options.height));
  if (seen.cut)
    drawn = {clipped(drawn.surface.get(), *seen.cut), clipped(drawn.edges.get(), *seen.cut),
             section(faces.get(), pieces, *seen.cut)};

  window->SetSize(options.width, options.height);
  window->SetMultiSamples(4);
  const int font_size = std::max(10, options.height / 45);
  const auto add = [&](const Layout::Place& at) {
    return add_renderer(window.get(), at[0], at[1], at[2], at[3]);
  };
  add({0, 0, 1, 1});  // white where the others leave gaps
  auto *heading = add({0, 1 - head, 1, 1}), *whole = add(layout.whole), *detail = add(layout.detail),
       *legend = add(layout.legend);

  const auto parts = parts_of(drawn.surface.get());
  constexpr double stripes_across_whole = 80, stripes_across_detail = 50;
  add_drawn(whole, drawn, parts, table.get(), 2 * extent / stripes_across_whole, false);
  add_drawn(detail, drawn, parts, table.get(), 2 * half_detail / stripes_across_detail, options.edges);
  for (auto* renderer : {whole, detail}) {
    if (distance(shown, peak.at) > single_precision) add_ring(renderer, peak.at, 0.7 * font_size, ink);
    add_ring(renderer, shown, font_size, governing_blue);
  }
  look(whole, view, all, width_over_height(layout.whole, options), 4 * all.half_depth);
  look(detail, view, {shown, half_detail, 0, half_detail}, width_over_height(layout.detail, options),
       4 * extent);
  const double whole_width = (layout.whole[2] - layout.whole[0]) * options.width;
  const double m_per_pixel =
      std::max(2 * all.half_width / whole_width,
               2 * all.half_height * width_over_height(layout.whole, options) / whole_width);
  add_scale_bar(whole, 0.02 * options.width, font_size, 0.1 * options.width, m_per_pixel, font_size);

  const auto note = [&](vtkRenderer* renderer, const Layout::Place& place) {
    add_notes(renderer, options.notes, (place[2] - place[0]) * options.width,
              (place[3] - place[1]) * options.height, font_size * 4 / 5);
  };
  note(whole, layout.whole);
  note(detail, layout.detail);

  add_triad(add({1 - 0.13, gap, 1, gap + 0.22}), whole);

  add_text(heading, title, font_size * 4 / 3, 0.02, 0.25);
  const double legend_width = (layout.legend[2] - layout.legend[0]) * options.width,
               legend_height = (layout.legend[3] - layout.legend[1]) * options.height;
  ColourBar bar;
  bar.width = 1.5 * font_size;
  bar.unit = unit;
  bar.peak = peak.value;
  bar.font_size = font_size;
  add_legend(Legend(legend, legend_width, legend_height, font_size), legend, table.get(), bar, peak, options,
             some_excluded);
  write_png(window.get(), png);
  return true;
}

}  // namespace pipelines

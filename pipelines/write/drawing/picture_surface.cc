#include "pipelines/write/drawing/picture_surface.h"

#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkFloatArray.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridGeometryFilter.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "pipelines/base/common/errors.h"

namespace pipelines {
namespace {

Vector operator+(const Vector& a, const Vector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Vector operator*(double s, const Vector& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double length(const Vector& a) {
  return std::sqrt(dot(a, a));
}
Vector unit_of(const Vector& a) {
  return (1 / length(a)) * a;
}

/// The deleter holds VTK's own reference.
template <class Object>
std::shared_ptr<Object> shared(const vtkSmartPointer<Object>& object) {
  return {object.Get(), [object](Object*) {}};
}

/// Reads from the arrays at the nodes these alone; names that the file does not have are none.
void read_only(const std::set<std::string>& names, vtkXMLUnstructuredGridReader& reader) {
  reader.UpdateInformation();
  for (int i = 0; i < reader.GetNumberOfPointArrays(); ++i) {
    const char* name = reader.GetPointArrayName(i);
    reader.SetPointArrayStatus(name, names.count(name) > 0 ? 1 : 0);
  }
}

/// Leaves out faces between cells of unlike size, which VTK takes for the surface: they have a point inside.
void keep_surface(vtkUnstructuredGrid& faces, vtkDataArray& on_surface) {
  vtkNew<vtkCellArray> kept;
  std::vector<int> types;
  for (vtkIdType f = 0; f < faces.GetNumberOfCells(); ++f) {
    vtkIdList* points = faces.GetCell(f)->GetPointIds();
    bool is_outside = true;
    for (vtkIdType i = 0; i < points->GetNumberOfIds(); ++i)
      is_outside = is_outside && on_surface.GetComponent(points->GetId(i), 0) != 0;
    if (!is_outside) continue;
    kept->InsertNextCell(points);
    types.push_back(faces.GetCellType(f));
  }
  faces.SetCells(types.data(), kept);
}

/// Shorter one of a quadrilateral's two mean lengths of opposite edges; a triangle's shortest edge.
double shorter_side_m(vtkUnstructuredGrid* faces, vtkCell* face) {
  std::array<double, 4> length_m{};
  const int n = std::min(face->GetNumberOfEdges(), 4);
  for (int e = 0; e < n; ++e) {
    vtkCell* edge = face->GetEdge(e);
    Vector a{}, b{};
    faces->GetPoint(edge->GetPointId(0), a.data());
    faces->GetPoint(edge->GetPointId(1), b.data());
    length_m[std::size_t(e)] = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  }
  return n == 4 ? std::min(length_m[0] + length_m[2], length_m[1] + length_m[3]) / 2
                : *std::min_element(length_m.begin(), length_m.begin() + n);
}

}  // namespace

std::shared_ptr<vtkUnstructuredGrid> boundary_faces(const std::filesystem::path& vtu,
                                                    const std::string& field, double scale,
                                                    const std::string& excluded, const std::string& beyond) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  if (!reader->CanReadFile(vtu.c_str())) throw FileError(vtu.string() + ": is no VTU file that can be read");
  reader->SetFileName(vtu.c_str());
  read_only({field, excluded, beyond, on_surface_array}, *reader);
  vtkNew<vtkUnstructuredGridGeometryFilter> geometry;
  geometry->SetInputConnection(reader->GetOutputPort());
  geometry->Update();
  auto* grid = vtkUnstructuredGrid::SafeDownCast(geometry->GetOutput());
  if (auto* on_surface = grid->GetPointData()->GetArray(on_surface_array)) keep_surface(*grid, *on_surface);
  auto* values = grid->GetPointData()->GetArray(field.c_str());
  if (!values || values->GetNumberOfComponents() != 1 || values->GetNumberOfTuples() == 0)
    throw FileError(vtu.string() + ": has no nodal field \"" + field + "\" of one component");
  vtkNew<vtkFloatArray> shown;
  shown->SetName("shown");
  shown->SetNumberOfTuples(values->GetNumberOfTuples());
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
    shown->SetValue(i, static_cast<float>(scale * values->GetComponent(i, 0)));
  auto* marks = excluded.empty() ? nullptr : grid->GetPointData()->GetArray(excluded.c_str());
  vtkNew<vtkFloatArray> marked;
  marked->SetName(excluded_array);
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
    marked->InsertNextValue(marks && marks->GetComponent(i, 0) != 0 ? 1 : 0);
  auto* distances = beyond.empty() ? nullptr : grid->GetPointData()->GetArray(beyond.c_str());
  vtkNew<vtkFloatArray> within;
  within->SetName(border_array);
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
    within->InsertNextValue(distances ? static_cast<float>(-distances->GetComponent(i, 0))
                                      : marked->GetValue(i) - 0.5F);
  auto faces = vtkSmartPointer<vtkUnstructuredGrid>::New();
  faces->CopyStructure(grid);
  faces->GetPointData()->SetScalars(shown);
  faces->GetPointData()->AddArray(marked);
  faces->GetPointData()->AddArray(within);
  return shared(faces);
}

std::shared_ptr<vtkPolyData> smooth_surface(vtkUnstructuredGrid* faces, int subdivisions) {
  vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputData(faces);
  surface->SetNonlinearSubdivisionLevel(std::clamp(subdivisions, 0, 5));
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(surface->GetOutputPort());
  normals->SetFeatureAngle(30);
  // Faces of cells are seen from outside. VTK's own orientation wants a closed surface, and where small faces
  // meet large ones this one is in pieces.
  normals->ConsistencyOff();
  normals->Update();
  return shared(vtkSmartPointer<vtkPolyData>(normals->GetOutput()));
}

std::shared_ptr<vtkPolyData> curved_edges(vtkUnstructuredGrid* faces, int n_pieces, double least_side_m) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  std::set<std::pair<vtkIdType, vtkIdType>> drawn;
  for (vtkIdType f = 0; f < faces->GetNumberOfCells(); ++f) {
    if (shorter_side_m(faces, faces->GetCell(f)) < least_side_m) continue;
    for (int e = 0; e < faces->GetCell(f)->GetNumberOfEdges(); ++e) {
      vtkCell* edge = faces->GetCell(f)->GetEdge(e);
      const auto ends = std::minmax({edge->GetPointId(0), edge->GetPointId(1)});
      if (!drawn.insert(ends).second) continue;
      lines->InsertNextCell(n_pieces + 1);
      for (int i = 0; i <= n_pieces; ++i) {
        int sub = 0;
        double parametric[3] = {double(i) / n_pieces, 0, 0}, x[3], weights[3];
        edge->EvaluateLocation(sub, parametric, x, weights);
        lines->InsertCellPoint(points->InsertNextPoint(x));
      }
    }
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  result->SetLines(lines);
  return shared(result);
}

SurfacePeak peak_of(vtkUnstructuredGrid* faces, vtkPolyData* surface) {
  auto* values = faces->GetPointData()->GetScalars();
  auto* excluded = faces->GetPointData()->GetArray(excluded_array);
  SurfacePeak peak;
  peak.value = -std::numeric_limits<double>::infinity();
  for (vtkIdType f = 0; f < faces->GetNumberOfCells(); ++f) {
    vtkIdList* nodes = faces->GetCell(f)->GetPointIds();
    for (vtkIdType i = 0; i < nodes->GetNumberOfIds(); ++i)
      if (const double value = values->GetComponent(nodes->GetId(i), 0);
          value > peak.value && excluded->GetComponent(nodes->GetId(i), 0) == 0) {
        peak.value = value;
        faces->GetPoint(nodes->GetId(i), peak.at.data());
      }
  }
  peak.normal = normal_at(surface, peak.at);
  return peak;
}

Vector normal_at(vtkPolyData* surface, const Vector& at) {
  Vector x = at, normal{};
  const vtkIdType nearest = surface->FindPoint(x.data());
  surface->GetPointData()->GetNormals()->GetTuple(nearest, normal.data());
  return normal;
}

std::array<Vector, 3> View::axes() const {
  std::array<Vector, 3> result;
  const Vector eye = unit_of(towards_eye);
  vtkMath::Cross(up.data(), eye.data(), result[0].data());
  result[0] = unit_of(result[0]);
  vtkMath::Cross(eye.data(), result[0].data(), result[1].data());
  result[2] = eye;
  return result;
}

bool is_long(const double* bounds) {
  return bounds[5] - bounds[4] > 1.6 * std::max(bounds[1] - bounds[0], bounds[3] - bounds[2]);
}

Vector near_side(const double* bounds, const Vector& normal) {
  Vector near = normal;
  near[is_long(bounds) ? 2 : 1] = 0;
  if (length(near) > 0.1) return unit_of(near);
  return is_long(bounds) ? Vector{-1, 0, 0} : unit_of({-0.55, 0, 0.8});  // the place faces along the axis
}

std::vector<View> views_of(const double* bounds, const Vector& normal) {
  const Vector up{0, 1, 0};
  Vector near = near_side(bounds, normal), right;
  if (is_long(bounds)) near = {normal[0] > 0.1 ? 1.0 : -1.0, 0, 0};
  vtkMath::Cross(up.data(), near.data(), right.data());
  // First 30 degrees round towards the right, or the left if the place faces it, and from above, or from
  // below if the place faces down: 20 degrees, or 55 where it is on the top or the bottom.
  constexpr double degree = vtkMath::Pi() / 180;
  const double turn = std::copysign(30 * degree, dot(normal, right) < -0.3 ? -1 : 1);
  const double height = is_long(bounds) && std::abs(normal[1]) > 0.6 ? 55 : 20;
  const double tilt = std::copysign(height * degree, normal[1] < -0.3 ? -1 : 1);
  std::vector<View> views;
  for (const double raise : {tilt, -tilt})
    for (const double side : {turn, -turn})
      views.push_back(
          {std::cos(raise) * (std::cos(side) * near + std::sin(side) * right) + std::sin(raise) * up, up});
  return views;
}

Frame frame_of(vtkPolyData* surface, const View& view) {
  const std::array<Vector, 3> axes = view.axes();
  std::array<double, 3> low, high;
  low.fill(std::numeric_limits<double>::max());
  high.fill(std::numeric_limits<double>::lowest());
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i) {
    Vector x;
    surface->GetPoint(i, x.data());
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], dot(axes[d], x));
      high[d] = std::max(high[d], dot(axes[d], x));
    }
  }
  Frame frame;
  for (std::size_t d = 0; d < 3; ++d) frame.centre = frame.centre + 0.5 * (low[d] + high[d]) * axes[d];
  frame.half_width = 0.5 * (high[0] - low[0]);
  frame.half_height = 0.5 * (high[1] - low[1]);
  frame.half_depth = 0.5 * (high[2] - low[2]);
  return frame;
}

}  // namespace pipelines

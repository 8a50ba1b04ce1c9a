#include "pipelines/write/drawing/cut_surface.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkClipClosedSurface.h>
#include <vtkClipPolyData.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkNew.h>
#include <vtkNonMergingPointLocator.h>
#include <vtkPlane.h>
#include <vtkPlaneCollection.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStaticCellLocator.h>
#include <vtkUnstructuredGrid.h>

namespace pipelines {
namespace {

vtkSmartPointer<vtkPlane> plane_of(const CutPlane& cut) {
  auto plane = vtkSmartPointer<vtkPlane>::New();
  plane->SetNormal(cut.normal.data());
  plane->SetOrigin(cut.point.data());
  plane->Push(1e-5);  // whole edges of a symmetric mesh lie on the plane meant: 10 um beside it, none
  return plane;
}

}  // namespace

std::shared_ptr<vtkPolyData> clipped(vtkPolyData* data, const CutPlane& cut) {
  vtkNew<vtkClipPolyData> clip;
  clip->SetInputData(data);
  clip->SetLocator(vtkNew<vtkNonMergingPointLocator>());  // merging takes long where cells crowd
  clip->SetClipFunction(plane_of(cut));
  clip->InsideOutOn();
  clip->Update();
  const vtkSmartPointer<vtkPolyData> result = clip->GetOutput();
  return {result.Get(), [result](vtkPolyData*) {}};
}

std::shared_ptr<vtkPolyData> section(vtkUnstructuredGrid* faces, int subdivisions, const CutPlane& cut) {
  vtkNew<vtkDataSetSurfaceFilter> closed;  // without normals, which part the faces at sharp edges
  closed->SetInputData(faces);
  closed->SetNonlinearSubdivisionLevel(subdivisions);
  const auto kept = plane_of(cut);  // vtkClipClosedSurface keeps the side of the normal
  kept->SetNormal(-cut.normal[0], -cut.normal[1], -cut.normal[2]);
  vtkNew<vtkPlaneCollection> planes;
  planes->AddItem(kept);
  vtkNew<vtkClipClosedSurface> clip;
  clip->SetInputConnection(closed->GetOutputPort());
  clip->SetClippingPlanes(planes);
  clip->SetScalarModeToLabels();
  clip->Update();
  auto* all = clip->GetOutput();
  auto* labels = all->GetCellData()->GetScalars();
  vtkNew<vtkCellArray> faces_of_cut;
  for (vtkIdType c = 0; c < all->GetNumberOfCells(); ++c)
    if (labels->GetComponent(c, 0) > 0) faces_of_cut->InsertNextCell(all->GetCell(c));
  const auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(all->GetPoints());
  result->SetPolys(faces_of_cut);
  return {result.Get(), [result](vtkPolyData*) {}};
}

SurfaceView view_of_place(vtkPolyData* surface, const Vector& place, const Vector& normal) {
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(surface);
  locator->BuildLocator();
  const double size = surface->GetLength();
  SurfaceView first;
  for (const View& view : views_of(surface->GetBounds(), normal)) {
    const Vector eye = view.axes()[2];
    Vector from, to;
    for (std::size_t d = 0; d < 3; ++d) {
      from[d] = place[d] + 1e-3 * size * normal[d];
      to[d] = from[d] + 2 * size * eye[d];
    }
    double share = 0, hit[3], parametric[3];
    int sub = 0;
    if (!locator->IntersectWithLine(from.data(), to.data(), 0, share, hit, parametric, sub))
      return {view, {}};
    if (first.cut) continue;
    first = {view, CutPlane{{}, near_side(surface->GetBounds(), normal)}};
    for (std::size_t d = 0; d < 3; ++d) first.cut->point[d] = 0.5 * (place[d] + hit[d]);
  }
  return first;
}

}  // namespace pipelines

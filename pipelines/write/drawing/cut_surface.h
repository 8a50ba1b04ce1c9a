/// Bodies cut open by a plane.
#pragma once

#include <memory>
#include <optional>

#include "pipelines/write/drawing/picture_surface.h"

namespace pipelines {

/// What lies on the side of the normal is taken away.
struct CutPlane {
  Vector point{}, normal{};
};

/// What the plane leaves of a surface or of lines, with its fields.
std::shared_ptr<vtkPolyData> clipped(vtkPolyData* data, const CutPlane& cut);

/// The section of the body that the faces enclose.
/// @param subdivisions  subdivisions of the faces, as in smooth_surface
std::shared_ptr<vtkPolyData> section(vtkUnstructuredGrid* faces, int subdivisions, const CutPlane& cut);

/// How a place on the surface is looked at.
struct SurfaceView {
  View view;
  std::optional<CutPlane> cut;  ///< where something hides the place from all sides tried: half way to it
};

/// The first of views_of from which the place is seen; else the first of all, of the body cut open.
/// @param normal  normal of the surface there, outward
SurfaceView view_of_place(vtkPolyData* surface, const Vector& place, const Vector& normal);

}  // namespace pipelines

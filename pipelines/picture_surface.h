/// What a picture shows: the surface of a body with a field on it, and how to look at it.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>

class vtkPolyData;
class vtkUnstructuredGrid;

namespace pipelines {

using Vector = std::array<double, 3>;

/// The boundary faces of the cells with their quadratic shape; the field times `scale` is the active scalars.
/// @throws std::runtime_error naming the file if it cannot be read or has no such field of one component at
///         its nodes
std::shared_ptr<vtkUnstructuredGrid> boundary_faces(const std::filesystem::path& vtu,
                                                    const std::string& field, double scale);

/// The faces in 4^subdivisions pieces each, with outward normals; sharp edges stay sharp.
std::shared_ptr<vtkPolyData> smooth_surface(vtkUnstructuredGrid* faces, int subdivisions);

/// The edges of the faces, each once, as polylines along their quadratic shape.
std::shared_ptr<vtkPolyData> curved_edges(vtkUnstructuredGrid* faces);

/// The node on the surface where the field is largest, and the direction from which that place is seen.
struct SurfacePeak {
  double value = 0;
  Vector at{}, normal{};
};

/// @param faces    of boundary_faces: the nodes at which the field is known, not what lies between them
/// @param surface  the same faces from smooth_surface, for the normal
SurfacePeak peak_of(vtkUnstructuredGrid* faces, vtkPolyData* surface);

/// The eye's frame: the body's longest extent runs to the right, the peak is on the near side.
struct View {
  Vector towards_eye{}, up{};

  /// Right, up and towards the eye in the picture; orthonormal.
  std::array<Vector, 3> axes() const;
};

/// @param bounds  of the body: x, y, z from and to
/// @param normal  outward, at the peak
View view_of(const double* bounds, const Vector& normal);

/// A rectangle in the plane of the picture, at the depth of `centre`.
struct Frame {
  Vector centre{};
  double half_width = 0, half_height = 0, half_depth = 0;
};

/// The smallest frame round all points.
Frame frame_of(vtkPolyData* surface, const View& view);

}  // namespace pipelines

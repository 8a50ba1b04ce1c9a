/// What a picture shows: the surface of a body with a field on it, and how to look at it.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

class vtkPolyData;
class vtkUnstructuredGrid;

namespace pipelines {

using Vector = std::array<double, 3>;
using Colour = std::array<unsigned char, 3>;  ///< red, green, blue

/// The point array that says where the field has no converged value: 1 there, 0 elsewhere.
inline constexpr const char* excluded_array = "excluded";
/// The point array that is positive where the field has no converged value, between the nodes too: its zero
/// is the border.
inline constexpr const char* border_array = "within the border";
/// The nodal field of the file that is 1 on the surface of the body; files may have none.
inline constexpr const char* on_surface_array = "on the surface";

/// The boundary faces of the cells with their quadratic shape; the field times `scale` is the active scalars.
/// @param excluded  a field of the file that is not 0 where the other counts for nothing; empty or absent:
/// nowhere
/// @param beyond    a field of the file that is negative where the other counts for nothing, such as the
/// distance from a border; empty or absent: what lies half way between nodes that count and others
/// @throws FileError naming the file if it cannot be read or has no such field of one component at
///         its nodes
std::shared_ptr<vtkUnstructuredGrid> boundary_faces(const std::filesystem::path& vtu,
                                                    const std::string& field, double scale,
                                                    const std::string& excluded,
                                                    const std::string& beyond = "");

/// The faces in 4^subdivisions pieces each, with outward normals; sharp edges stay sharp.
std::shared_ptr<vtkPolyData> smooth_surface(vtkUnstructuredGrid* faces, int subdivisions);

/// The edges of the faces, each once, as polylines of n_pieces along their quadratic shape.
/// @param least_side_m  edges of narrower faces alone are left out: they would hide the colours between them
std::shared_ptr<vtkPolyData> curved_edges(vtkUnstructuredGrid* faces, int n_pieces, double least_side_m = 0);

/// The node on the surface, and not excluded, where the field is largest, and the direction from which that
/// place is seen.
struct SurfacePeak {
  double value = 0;
  Vector at{}, normal{};
};

/// @param faces    faces of boundary_faces: the nodes at which the field is known, not what lies between them
/// @param surface  the same faces from smooth_surface, for the normal
SurfacePeak peak_of(vtkUnstructuredGrid* faces, vtkPolyData* surface);

/// Outward, at the point of the surface that is nearest.
Vector normal_at(vtkPolyData* surface, const Vector& at);

/// Whether z is by far the longest extent.
bool is_long(const double* bounds);

/// The eye's frame.
struct View {
  Vector towards_eye{}, up{};

  /// Right, up and towards the eye in the picture; orthonormal.
  std::array<Vector, 3> axes() const;
};

/// The side of the body from which a place is looked at, across its length (long bodies) or horizontally, y
/// up.
/// @param bounds  bounds of the body: x, y, z from and to
/// @param normal  outward, at the place
Vector near_side(const double* bounds, const Vector& normal);

/// Three quarters, from the near side, y up; the best first. The axis of a long body runs to the right, or to
/// the left where it is seen from x > 0.
std::vector<View> views_of(const double* bounds, const Vector& normal);

/// A rectangle in the plane of the picture, at the depth of `centre`.
struct Frame {
  Vector centre{};
  double half_width = 0, half_height = 0, half_depth = 0;
};

/// The smallest frame round all points.
Frame frame_of(vtkPolyData* surface, const View& view);

}  // namespace pipelines

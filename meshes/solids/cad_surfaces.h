/// Surfaces of gmsh's current model by what they are, whatever the file calls them: a hole that was exported
/// as a B-spline is a cylinder.
#pragma once

#include <optional>

#include "meshes/solids/model_mesh.h"

namespace meshes {

struct CadSurface {
  enum class Kind { plane, cylinder, bent, other };
  Kind kind = Kind::other;
  Point centre{};     ///< a point of the plane, or of the cylinder's axis [the model's unit]
  Point axis{};       ///< the plane's normal, or along the cylinder's axis; of unit length
  double radius = 0;  ///< radius of a cylinder, or of a surface that is bent alike everywhere, as fillets are
};

/// Recognises a surface by points and normals at a few places.
CadSurface recognise(int surface);

/// Area and its centre, integrated along the curves that bound a plane or a cylinder: exact to rounding,
/// where OpenCASCADE's own quadrature of B-splines is off by 1e-5 of the size.
struct AreaAndCentre {
  double area = 0;
  Point centre{};
};

/// @return nothing of other surfaces, and of curves that do not close
std::optional<AreaAndCentre> area_of(int surface, const CadSurface& shape);

/// Gives the surfaces of a model that gmsh still has their shapes: "hole d 12 mm", "cylinder d 20 mm",
/// "fillet r 2 mm", "rounding r 2 mm", "plane z = 28 mm", "plane"; others stay without. Hollow or not is told
/// by the curved cells.
/// @param unit_m    length of gmsh's unit
/// @param origin_m  where gmsh's origin lies in the part
void name_shapes(double unit_m, const Point& origin_m, ModelMesh& model);

}  // namespace meshes

/// Unit loads: the shapes in space of the load channels. Each is scaled so that a channel value of 1 is 1 N,
/// 1 N m, 1 m/s2, 1 rad/s2 or 1 rad2/s2. Frame: the body's own; torques and moments about the port's centre,
/// right-handed.
#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

namespace fem {

/// A surface where load enters. Seats are cylinders parallel to z with their own axis, loaded from outside
/// or, as bores, from inside; faces are any other surfaces, in one piece or several.
struct LoadSurface {
  enum class Kind { seat, face };
  Kind kind = Kind::seat;
  int boundary_id = 0;
  std::array<double, 3> centre_m{};  ///< seat: on the axis, in the middle; face: the point of its moments
  double radius_m = 0;               ///< 0 for faces
  double length_m = 0;               ///< along z; 0 for faces
  /// Seats: normal pressure along the axis, relative, at equidistant places from the end of smaller z to the
  /// other one, straight lines in between. One value: uniform.
  std::vector<double> axial_profile{1.0};
};

/// Six resultants of a surface. Seats: fx, fy normal pressure cos/sin of the angle times the axial profile;
/// fz axial and torque tangential traction tapered by 1 - (2 z/b)^2; mx, my normal pressure times z. Faces:
/// fx, fy, fz uniform traction, mx, my, torque the traction e x r about the centre. The resultant on the mesh
/// is exact: the six raw load vectors of the surface are combined so that each has its own component 1 and
/// the five others 0.
struct SurfaceResultant {
  enum class Component { fx, fy, fz, mx, my, torque };
  LoadSurface surface;
  Component component = Component::fx;
};

/// Normal pressure  p = value c cos(n theta) / (pi R b)  (or sin) times the axial profile (of mean 1), theta
/// from +x about the seat's axis. A positive p pushes against the surface, into the material. Its discrete
/// resultants are removed on the mesh: n = 1 is the resultant fx, fy. On a clamped body they may stay, and
/// the surface may then be an arc, or of another shape.
struct SeatPressure {
  enum class Phase { cosine, sine };
  LoadSurface surface;
  int harmonic = 0;        ///< 0, 2, 3, 4 ...
  double coefficient = 1;  ///< c, of the pressure pattern, against its harmonic n = 1
  Phase phase = Phase::cosine;
  bool keeps_resultants = false;
};

/// Body force rho (acceleration field): `translation` along x, y, z: rho; `rotation`: rho z x p = rho (-y, x,
/// 0); `spin`: rho (x, y, 0), the centrifugal field of unit squared speed. On the cells of the volume groups
/// named, or on all if none is.
struct BodyForce {
  enum class Field { translation_x, translation_y, translation_z, rotation, spin };
  Field field = Field::translation_x;
  std::vector<int> volume_ids{};
};

/// Springs from a surface to the ground, on its mean displacement along x, y, z (conjugate to the surface's
/// unit resultants fx, fy, fz). They act on the elastic deformation only: loads close without them.
struct ElasticSupport {
  LoadSurface surface;
  std::array<double, 3> stiffness_N_m{};  ///< each >= 0; 0: no spring in that direction
};

struct UnitLoad {
  std::string channel;  ///< "<port>.<component>", unique
  std::variant<SurfaceResultant, SeatPressure, BodyForce> shape;
};

}  // namespace fem

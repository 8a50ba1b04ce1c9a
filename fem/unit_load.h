/// Unit loads: the shapes in space of the load channels. Each is scaled so that a channel value of 1 is 1 N,
/// 1 N m, 1 m/s2, 1 rad/s2 or 1 rad2/s2. Frame: the body's own; torques and moments about the port's centre,
/// right-handed.
#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

namespace fem {

/// A surface where load enters. Seats are cylinders parallel to z with their own axis; end faces are flat
/// discs.
struct LoadSurface {
  enum class Kind { seat, end_face };
  Kind kind = Kind::seat;
  int boundary_id = 0;
  std::array<double, 3> centre_m{};  ///< on the axis, in the middle of the surface
  double radius_m = 0;
  double length_m = 0;  ///< along z; 0 for end faces
};

/// Six resultants of a surface. Seats: fx, fy normal pressure cos/sin of the angle; fz axial and torque
/// tangential traction tapered by 1 - (2 z/b)^2; mx, my normal pressure times z. End faces: fx, fy uniform
/// shear, fz uniform tension, mx, my linear bending traction, torque Saint-Venant traction. The resultant on
/// the mesh is exact: the six raw load vectors of the surface are combined so that each has its own component
/// 1 and the five others 0.
struct SurfaceResultant {
  enum class Component { fx, fy, fz, mx, my, torque };
  LoadSurface surface;
  Component component = Component::fx;
};

/// Normal pressure  p = value c_n cos(n theta) / (pi R b)  (or sin), c_n the half-cosine's coefficient
/// against n = 1: c_0 = 2/pi, c_n = (4/pi) (-1)^(n/2+1) / (n^2-1) for n = 2, 4, ... theta from +x about the
/// seat's axis. A positive p pushes against the surface (inwards). Its discrete resultants are removed on the
/// mesh. With |F| cos(n beta), |F| sin(n beta) as values the harmonics add up, with n = 1, to the half-cosine
/// of resultant |F| centred at beta.
struct SeatPressure {
  enum class Phase { cosine, sine };
  LoadSurface surface;
  int harmonic = 0;  ///< 0 or even
  Phase phase = Phase::cosine;
};

/// Body force rho (acceleration field): `translation` along x, y, z: rho; `rotation`: rho z x p = rho (-y, x,
/// 0); `spin`: rho (x, y, 0), the centrifugal field of unit squared speed.
struct BodyForce {
  enum class Field { translation_x, translation_y, translation_z, rotation, spin };
  Field field = Field::translation_x;
};

struct UnitLoad {
  std::string channel;  ///< "<port>.<component>", unique
  std::variant<SurfaceResultant, SeatPressure, BodyForce> shape;
};

}  // namespace fem

/// Unit loads as amplitudes of harmonics, and the rigid motions of m = 0 and 1. Internal to fem.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <functional>
#include <vector>

#include "fem/base/values/unit_load.h"
#include "fem/models/axisymmetric/meridian_grid.h"

namespace fem {

/// Nodal forces that work on the amplitudes of one harmonic (turned: of the turned one).
struct HarmonicForce {
  int m = 0;
  bool turned = false;
  Eigen::VectorXd force;
};

/// One load: a few harmonics, each (m, turned) at most once.
using HarmonicForces = std::vector<HarmonicForce>;

/// Adds to the harmonic that is there, or a new one.
void add_to(HarmonicForces& forces, int m, bool turned, const Eigen::VectorXd& force);

class HarmonicLoads {
public:
  HarmonicLoads(const MeridianGrid& grid, const MeridianBody& body);

  /// As applied. A load on an eccentric surface acts on the concentric one, with the couple that its lever
  /// makes; body forces on eccentric cylinders likewise, with the forces that their offset makes. Resultants
  /// of surface loads are exact on the mesh.
  /// @throws std::invalid_argument naming the channel: a surface that the section does not have, a body force
  /// on a part, harmonic 1 or a negative one, the sine of harmonic 0, pressure on a face
  HarmonicForces operator()(const UnitLoad& load) const;

  /// fx, fy, fz, mx, my, mz about the origin.
  std::array<double, 6> resultant(const HarmonicForces& forces) const;

  // By the mass: resultants out of a load, rigid motion out of a displacement; m = 0 or 1, else nothing.
  void balance(int m, Eigen::VectorXd& force) const;
  void remove_motion(int m, Eigen::MatrixXd& displacement) const;

private:
  /// Amplitudes with exact unit resultants about a height: of m = 0, axial force and torque; of m = 1, force
  /// across and the couple about the axis square to it (the turned one's couple has the other sign).
  struct Basis {
    Eigen::VectorXd axial, torque, force, couple;
  };
  using Traction = std::function<Eigen::Vector3d(const SectionPoint&)>;

  /// The rigid motions as tractions, in the order of Basis; tilting about a height.
  static std::array<Traction, 4> rigid_tractions(double centre_z_m);
  std::vector<const SectionPoint*> points_of(const LoadSurface& surface) const;
  std::vector<const SectionPoint*> points_between(double begin_m, double end_m) const;
  Eigen::VectorXd integrate(const std::vector<const SectionPoint*>& points, int m,
                            const Traction& traction) const;
  Eigen::MatrixXd modes(int m, double centre_z_m) const;  // 3 n x 2
  Basis basis(const std::vector<const SectionPoint*>& points, double centre_z_m,
              const std::array<Traction, 4>& raw) const;
  Basis basis_of(const LoadSurface& surface) const;
  Basis basis_of(const EccentricCylinder& cylinder) const;

  HarmonicForces forces_of(const SurfaceResultant& load) const;
  HarmonicForces forces_of(const SeatPressure& load) const;
  HarmonicForces forces_of(const BodyForce& load) const;
  /// By a rigid field of accelerations on the body's mass.
  void make_resultant(const std::array<double, 6>& wanted, HarmonicForces& forces) const;

  const MeridianGrid* grid_;
  const MeridianBody* body_;
  std::array<Eigen::MatrixXd, 2> modes_, mass_modes_;  // about the origin; times the mass
};

}  // namespace fem

/// Section diagrams and torsion of a shaft over the cycle: from the stress field integrated over
/// cross-sections, and, to be compared with it, by statics from the loads alone.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "fem/base/values/body.h"
#include "fem/base/values/unit_responses.h"
#include "meshes/shaft_layout/shaft_geometry.h"
#include "meshes/values/body_mesh.h"
#include "pipelines/loads/channels/load_collector.h"

namespace pipelines {

/// Internal resultants at a section plane over the cycle: the action of the part above the plane (larger z)
/// on the part below it (tension and right-handed torque positive), in the body's frame, moments about (0, 0,
/// z). 6 x n_instants: shear forces fx, fy [N], normal force fz [N], bending moments mx, my [N m], torque
/// about z [N m].
using SectionHistory = Eigen::Array<double, 6, Eigen::Dynamic>;

struct SectionResult {
  meshes::SectionPlane plane;
  SectionHistory by_stress;   ///< integral of the recovered stress
  SectionHistory by_statics;  ///< from channels and the density of the body alone
  Eigen::ArrayXd torsion_Pa;  ///< mean over the rim of sigma_theta_z; n_instants
  /// T r / I_p with the statics' torque about the section's own axis; n_instants.
  Eigen::ArrayXd beam_torsion_Pa;
  /// x, y of the section's axis point against the line through the references' axes.
  Eigen::Array2Xd deflection_m;
  Eigen::Array2Xd slope_rad;  ///< d(deflection x)/dz, d(deflection y)/dz from the section's rotation
};

/// Torsional stress on a ring of the surface (fillets included).
struct TorsionRing {
  double z_m = 0, radius_m = 0;
  std::string feature;
  /// Largest over the cycle, hypot of the mean sigma_r_theta and sigma_theta_z; over the whole course where
  /// the loads that the instants pass over are that.
  double max_Pa = 0;
  Eigen::Index instant = 0;  ///< instant of the largest at the instants
  /// Instant of max_Pa: column of ChannelHistory::passed_over; -1: it is `instant`.
  Eigen::Index denser_instant = -1;
  /// What it may be more up to the border of what is left out, where that is next to it: from the ring within
  /// in a straight line, which is above a curve that steepens towards the corner.
  double rise_Pa = 0;
};

/// The largest torsional stress of all rings by one model, and what that model's mesh makes it wrong by [Pa].
struct LargestTorsion {
  double value_Pa = 0, error_Pa = 0;
};

/// Deflection of the axis, and rotation of the section, at a seat's centre: interpolated between the sections
/// around it.
struct SeatMotion {
  std::string port;
  double z_m = 0;
  double max_deflection_m = 0, max_slope_rad = 0;
};

struct Diagrams {
  std::vector<SectionResult> sections;  ///< ascending z
  std::vector<TorsionRing> rings;
  /// The same figure by sections that were refined until its error is known: those of the run itself, or of
  /// harmonics beside a solid.
  std::optional<LargestTorsion> by_harmonics;
  std::vector<SeatMotion> seats;
  /// max over planes and instants of |by_stress - by_statics| against the largest value of force, bending
  /// moment, torque.
  double force_mismatch = 0, bending_mismatch = 0, torque_mismatch = 0;
};

/// The internal resultants at z by statics alone, under any loads with the channels of the unit loads.
/// @param geometry  cylinders of the shaft, for its weight
SectionHistory statics_over_the_cycle(const std::vector<fem::UnitLoad>& unit_loads,
                                      const ChannelHistory& loads, const meshes::Shaft& geometry,
                                      double density_kg_m3, double z_m);

/// @param geometry    cylinders of the shaft, for its weight by statics
/// @param references  ports that deflection and slope refer to: two bearings, one clamp, or none (the body's
/// own mean rigid motion)
/// @throws StageRefused if a port is missing
Diagrams section_diagrams(const BodyLoads& loads, const fem::UnitResponses& responses,
                          const meshes::BodyMesh& mesh, const meshes::Shaft& geometry, double density_kg_m3,
                          const std::vector<std::string>& references);

/// Mean torsional shear on a ring over the instants: rows sigma_r_theta and sigma_theta_z [Pa].
/// @param ring  index into responses.rings
Eigen::Array2Xd ring_shear_Pa(const ChannelHistory& loads, const fem::UnitResponses& responses,
                              std::size_t ring);
/// The same under other values of the channels, K x n.
Eigen::Array2Xd ring_shear_Pa(const Eigen::ArrayXXd& values, const fem::UnitResponses& responses,
                              std::size_t ring);

/// Torsion on all rings of the responses, in their order, which section_diagrams has as well. Rings that are
/// left out beside sharp edges, where stress has no converged value, have 0.
std::vector<TorsionRing> torsion_rings(const BodyLoads& loads, const fem::UnitResponses& responses,
                                       const meshes::BodyMesh& mesh);

/// The ring with the largest torsional stress; null if there is none.
const TorsionRing* largest_torsion_ring(const Diagrams& diagrams);

/// Largest |torsion_Pa - beam_torsion_Pa| over plain sections and instants against the largest
/// beam_torsion_Pa of plain sections; 0 if no plain section carries torque.
double plain_torsion_mismatch(const Diagrams& diagrams);

}  // namespace pipelines

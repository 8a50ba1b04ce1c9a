/// Critical planes of a stress history, by Findley.
///
/// On every plane through the point the shear traction moves on a path. Its amplitude tau_a is the radius of
/// the smallest circle that holds the path, which is exact for any path (half the longest chord would be too
/// small by up to 15 %); sigma_n,max is the largest normal stress, tension positive.
/// f = largest of tau_a + k sigma_n,max over all planes. A compressive sigma_n,max lowers the value. Source:
/// Findley, J. Eng. Industry 81 (1959) 301-306; Papadopoulos et al., Int. J. Fatigue 19 (1997) 219-235, for
/// the smallest circle.
#pragma once

#include <Eigen/Core>

namespace pipelines {

/// What the rule asks of the material: endured while tau_a + k sigma_n,max <= f.
struct CriticalPlaneLimit {
  double normal_share = 0;  ///< k >= 0
  double limit_Pa = 0;      ///< f > 0
};

/// Findley's k and f from the amplitudes endured in reversed bending and torsion.
///   Bar: tau_a = sigma_W/2 sin 2t, sigma_n,max = sigma_W/2 (1 + cos 2t); largest sum sigma_W/2 (k +
///   sqrt(1+k^2)). Torsion: tau_W cos 2t + k tau_W sin 2t; largest sum tau_W sqrt(1+k^2). Both are f, so that
///   with s = 2 tau_W / sigma_W - 1:  k = s / sqrt(1 - s^2),  f = tau_W sqrt(1 + k^2).
/// @throws std::invalid_argument if a strength is not positive, or tau_W / sigma_W is outside 0.5 to 1
/// (exclusive)
CriticalPlaneLimit findley_limit(double reversed_strength_Pa, double reversed_shear_strength_Pa);

struct CriticalPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit; its sign has no meaning
  double shear_amplitude_Pa = 0;
  double max_normal_Pa = 0;
  double equivalent_Pa = 0;  ///< tau_a + k sigma_n,max
  double utilisation = 0;    ///< equivalent / f, not below 0; endured up to 1
};

/// One row for each component xx, yy, zz, xy, yz, xz [Pa], one column for each instant of the cycle.
using StressPath = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Shear amplitude and largest normal stress on one plane.
/// @param normal  need not have unit length
/// @throws std::invalid_argument if the history is empty or not finite, or the normal is zero
CriticalPlane stress_on_plane(const StressPath& history_Pa, const Eigen::Vector3d& normal,
                              const CriticalPlaneLimit& limit);

/// The plane is found on 1,000 directions of a half sphere (4.5 degrees apart), then refined about the best
/// of them to 1e-7 rad: local maxima closer to the best than a coarse direction can lie below its maximum.
/// @throws std::invalid_argument if the history is empty or not finite, k is negative or f not positive
CriticalPlane findley(const StressPath& history_Pa, const CriticalPlaneLimit& limit);
/// The same where more of the path is known than a search over all planes needs: the plane is found by the
/// history, then refined, and its stresses taken, by the finer one. Of paths longer than 2,000 instants the
/// search takes the outermost points of 100 planes, and of 17 planes about the one found, in 16 directions of
/// shear each.
CriticalPlane findley(const StressPath& history_Pa, const StressPath& finer_Pa,
                      const CriticalPlaneLimit& limit);

/// Radius of the smallest circle that holds all points, to rounding.
/// @param points  one column each, at least one
double smallest_circle_radius(const Eigen::Matrix2Xd& points);

}  // namespace pipelines

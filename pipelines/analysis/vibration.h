/// How far a body is from being stressed quasi-statically: its natural frequencies against the harmonics of
/// its loads. Computed only where a scene asks for it (`natural_frequencies = 3` in the body's table).
///
/// How the body is held: two bearings as pins, stiff against the mean displacement of their seats across the
/// axis and free to tilt (a rigid frame, the usual check); a stub axle at its clamp. Turning about and moving
/// along the axis stays free; so does a body without bearings, and a chamber, whose motion on its springs the
/// load stage has already computed. Added masses are not on the mesh, and rotation about the axis (gyroscopic
/// moments, spin softening) is left out.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "fem/values/body.h"
#include "kinetics/load_history.h"
#include "pipelines/loads/body_mesh.h"
#include "pipelines/scene/scene.h"

namespace pipelines {

/// What damping leaves of a resonance, 1 / (2 D) with D = 1 %, as of steel in bearings: harmonics without
/// weight meet a natural frequency in every machine, and must not be infinite.
inline constexpr double resonance_peak = 50;

/// One harmonic of the stress at a place.
struct StressHarmonic {
  double order = 0;          ///< relative to the drive's turn, in the body's axes
  double frequency_Hz = 0;   ///< at which the body is shaken
  double share = 0;          ///< of the static peak
  double amplification = 1;  ///< 1 / |1 - (f / f_n)^2|, at most resonance_peak; of the f_n that changes most
};

struct DynamicAmplification {
  /// 1 + sum over the harmonics of share |amplification - 1|
  double factor = 1;
  StressHarmonic highest;  ///< the one of the highest frequency with a share above 1 %
};

struct Vibration {
  std::vector<double> natural_frequencies_Hz;  ///< ascending, without free rigid motions
  std::string held;                            ///< "pinned at bearing_1, bearing_2" ...
  DynamicAmplification amplification;          ///< of the peak von Mises stress
  DynamicAmplification at_hot_spot;            ///< of the largest hot-spot stress; factor 1 without weld toes
};

/// Above it a run warns; where a harmonic of weight is above all frequencies that were computed, too.
inline constexpr double amplification_limit = 1.02;

/// What resonance adds to stresses computed quasi-statically.
/// A harmonic counts with the von Mises norm of its cosine and sine tensors, sqrt(v_c^2 + v_s^2), which
/// bounds what it brings at any instant.
/// @param stress_Pa  6 x n: xx, yy, zz, xy, yz, xz at one place over whole turns of the drive
/// @param turns      that they cover
/// @param turn_Hz    turns of the drive per second
/// @param spin_Hz    of the body's axes against what holds it: a load that stands still in them then shakes
///                   the body once per turn, and a harmonic counts at its frequency plus this one, the higher
///                   of the two at which it may
/// @param natural_Hz  natural frequencies; every harmonic counts as if it were in the shape of the one that
///                    changes it most, so that beside a resonance the sum is a bound
/// @throws std::invalid_argument as kinetics::line_spectrum; without a frequency, or for one not positive
DynamicAmplification dynamic_amplification(const Eigen::ArrayXXd& stress_Pa, int turns, double turn_Hz,
                                           double spin_Hz, const std::vector<double>& natural_Hz);

/// The body held as the file's comment says; elastic feet are left out.
fem::Body held_body(const BodyScene& scene, const MeshedBody& meshed);

/// @param peak_stress_Pa  as for dynamic_amplification, at the place of the peak
/// @param hot_spot_stress_Pa  likewise at the weld toe of the largest hot-spot stress; empty without one
/// @throws fem::TooManyModes if the scene asks for more frequencies than the mesh has to say
Vibration vibration(const Scene& scene, const BodyScene& body, const MeshedBody& meshed,
                    const kinetics::LoadHistory& loads, const Eigen::ArrayXXd& peak_stress_Pa,
                    const Eigen::ArrayXXd& hot_spot_stress_Pa);

/// A sentence for the user if a factor exceeds the limit, or a harmonic the frequencies; else empty.
std::string warning_of(const BodyScene& body, const Vibration& vibration);

}  // namespace pipelines

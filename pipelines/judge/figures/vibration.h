/// How far a body is from being stressed quasi-statically: its natural frequencies against the harmonics of
/// its loads. Computed only where a scene asks for it (`natural_frequencies = 3` in the body's table).
///
/// How the body is held: two bearings as pins, stiff against the mean displacement of their seats across the
/// axis (a rigid frame, the usual check; or the scene's `bearing_stiffness`) and free to tilt; a stub axle at
/// its clamp. Turning about and moving along the axis stays free; so does a body without bearings, and a
/// chamber, whose motion on its springs the load stage has already computed. Rotation about the axis
/// (gyroscopic moments, spin softening) is left out.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "fem/base/values/body.h"
#include "fem/base/values/natural_mode.h"
#include "kinetics/values/load_history.h"
#include "pipelines/loads/channels/channels.h"
#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// What damping leaves of a resonance, 1 / (2 D) with D = 1 %, as of steel in bearings: harmonics without
/// weight meet a natural frequency in every machine, and must not be infinite.
inline constexpr double resonance_peak = 50;

/// One harmonic of the stress at a place.
struct StressHarmonic {
  double order = 0;  ///< relative to the drive's turn, in the body's axes
  /// Frequency at which the body is shaken: of those at which it may be, the one that changes most.
  double frequency_Hz = 0;
  double share = 0;  ///< amplitude as a share of the static peak
  /// 1 / |1 - (f / f_n)^2|, at most resonance_peak; of the f_n that changes most, and of all that it may be
  double amplification = 1;
};

struct DynamicAmplification {
  /// 1 + sum over the harmonics of share |amplification - 1|
  double factor = 1;
  StressHarmonic highest;  ///< the one of the highest order with a share above 1 %
  double highest_Hz = 0;   ///< the highest frequency at which it may shake the body
};

/// A mesh holds a body too stiff: the true frequency lies between value_Hz - error_Hz and value_Hz.
struct NaturalFrequency {
  double value_Hz = 0;
  double error_Hz = 0;  ///< by which it may be lower, for want of a finer mesh

  double least_Hz() const;  ///< not below 0
};

struct Vibration {
  std::vector<NaturalFrequency> natural_frequencies;  ///< ascending, without free rigid motions
  std::string held;                                   ///< "pinned at bearing_1, bearing_2" ...
  DynamicAmplification amplification;                 ///< amplification of the peak von Mises stress
  /// Amplification of the largest hot-spot stress; factor 1 without weld toes.
  DynamicAmplification at_hot_spot;
  /// What the body's largest stress with resonance has beyond the largest without: at the same place, or at
  /// another one that a load near resonance stresses more.
  struct Added {
    double share = 0;   ///< addition as a share of the largest without resonance
    std::string place;  ///< the other place; empty: the same
  };
  Added to_peak, to_hot_spot;
};

/// Relative error of a natural frequency above which a run warns.
inline constexpr double frequency_error_limit = 0.05;

/// Amplification above which a run warns; it warns, too, where a harmonic of weight is above all frequencies
/// that were computed.
inline constexpr double amplification_limit = 1.02;

/// What resonance adds to stresses computed quasi-statically.
/// A harmonic counts with the von Mises norm of its cosine and sine tensors, sqrt(v_c^2 + v_s^2), which
/// bounds what it brings at any instant.
/// @param stress_Pa  6 x n: xx, yy, zz, xy, yz, xz at one place over whole turns of the drive
/// @param turns      that they cover
/// @param turn_Hz    turns of the drive per second
/// @param spin_Hz    turns per second of the body's axes against what holds it, the stress being of loads
///                   across the axis: one that stands still in them shakes the body once per turn, one that
///                   oscillates at f at f + spin and |f - spin|. A harmonic counts at that of the two that
///                   changes it most
/// @param natural  natural frequencies; every harmonic counts as if it were in the shape of the one that
///                 changes it most, and that one where within its error it changes it most, so that beside a
///                 resonance the sum is a bound
/// @throws std::invalid_argument as kinetics::line_spectrum; without a frequency, for one not positive,
///         or a negative error
DynamicAmplification dynamic_amplification(const Eigen::ArrayXXd& stress_Pa, int turns, double turn_Hz,
                                           double spin_Hz, const std::vector<NaturalFrequency>& natural);

/// Unit stress of each channel, 6 x channels [Pa].
using UnitStress = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// The lines of the loads that stress is a sum of, once for all places.
class LoadLines {
public:
  /// @param factors  channels x n: factors of the unit stresses over whole turns of the drive
  /// @param across   for each channel whether it loads the body across the axis, so that it counts at f +
  /// spin
  ///                 and |f - spin|; others, as torques, at f
  /// @param spins_Hz that the body's axes may have against what holds it; at least one
  /// @throws std::invalid_argument as kinetics::line_spectrum
  LoadLines(const Eigen::ArrayXXd& factors, const std::vector<bool>& across, int turns, double turn_Hz,
            std::vector<double> spins_Hz);

  /// dynamic_amplification of a place, from its unit stresses.
  /// @param peak_Pa  largest von Mises stress there over the cycle
  DynamicAmplification amplification(const UnitStress& unit_Pa, double peak_Pa,
                                     const std::vector<NaturalFrequency>& natural) const;

private:
  Eigen::MatrixXd cosine_, sine_;  // channels x lines, from the mean on
  std::vector<bool> across_;
  int turns_;
  double turn_Hz_;
  std::vector<double> spins_Hz_;
};

/// The body held as the file's comment says; elastic feet are left out.
fem::Body held_body(const BodyScene& scene, const MeshedBody& meshed);

/// The same in words: "pinned at bearing_1, bearing_2".
std::string held_text(const BodyScene& body);

/// Added masses as discs across z: their inertia about x and y is half of the polar one.
std::vector<fem::AttachedMass> attached_to(const BodyScene& scene, const meshes::BodyMesh& mesh);

/// A place at which stress may be amplified.
struct ShakenPlace {
  std::string name;
  double value_Pa = 0;  ///< largest von Mises stress over the cycle
  UnitStress unit_Pa;
};

/// @param channels  channels of the body's loads
/// @param places  the peak's first, then the others that may lead when a load meets a natural frequency: it
/// may
///                have little weight where the peak is
/// @param toes    likewise weld toes; may be empty
/// @throws fem::TooManyModes if the scene asks for more frequencies than the mesh has to say
Vibration vibration(const Scene& scene, const BodyScene& body, const MeshedBody& meshed,
                    const kinetics::LoadHistory& loads, const ChannelHistory& channels,
                    const std::vector<ShakenPlace>& places, const std::vector<ShakenPlace>& toes);

/// A sentence for the user if a factor exceeds the limit, or a harmonic the frequencies; else empty.
std::string warning_of(const BodyScene& body, const Vibration& vibration);

/// A sentence for the user if the mesh knows a natural frequency worse than frequency_error_limit; else
/// empty. A search makes meshes for the stress: eight sectors and few rows hold a drum's shell stiff, and its
/// first two ovals at 541 Hz came out at 739 and above 1002 Hz.
std::string warning_of_frequencies(const BodyScene& body, const Vibration& vibration);

}  // namespace pipelines

/// Speeds at which the loads of a shaft meet its whirl: the shaft as a beam that turns in its bearings
/// (fem/models/beam/rotor.h). Computed only where a scene asks for it (`critical_speeds = 3` in [shaft]), in
/// a fraction of a second and without a mesh of the solid.
///
/// Bearings are rigid or have the scene's `bearing_stiffness`; they have neither mass nor damping. Added
/// masses are discs at their ports. Fillets and keyways are left out, and so is what makes two planes unlike.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fem/models/beam/rotor.h"
#include "kinetics/values/load_history.h"
#include "pipelines/loads/channels/channels.h"
#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// A speed at which a load that goes round with the shaft, or against it, meets a whirl.
struct CriticalSpeed {
  /// Turns of the load in space per turn of the shaft; positive: the way that the shaft turns. Imbalance: 1.
  double order = 1;
  int mode = 1;            ///< from the slowest that this order meets
  double speed_rad_s = 0;  ///< of the shaft
  double error_rad_s = 0;  ///< by which it may be lower for want of shorter elements
  double whirl_rad_s = 0;  ///< frequency of that whirl at the operating speed
  double margin = 0;       ///< by which the operating speed is above it, over it
  double share = 0;        ///< size of the load over the largest force on the shaft; of `loads` alone
};

struct CriticalSpeeds {
  double speed_rad_s = 0;            ///< at which the shaft operates
  std::string held;                  ///< "pinned at bearing_1, bearing_2" ...
  std::vector<CriticalSpeed> modes;  ///< those of order 1, then those of order -1
  std::vector<CriticalSpeed> loads;  ///< of every order of the loads the nearest one, closest first
  /// By how much the lowest frequency of the beam at rest is off that of the solid, over it; none: the scene
  /// asks for no natural frequencies, so that nothing is known of it.
  std::optional<double> model_error;
  std::vector<double> campbell_rad_s;                 ///< speeds of the Campbell diagram
  std::vector<fem::WhirlFrequencies> campbell_whirl;  ///< at these, as many as the scene asks for
};

/// Order and share of a force across the shaft that goes round in space.
struct TurningLoad {
  double order = 0, share = 0;
};

/// The strongest orders at which forces go round the shaft in space, and imbalance, which every shaft has.
/// @param channels  in axes that turn with the shaft, instants over whole turns of the drive
/// @param turning  1: the axes turn counter-clockwise, -1: clockwise, 0: not known, so that both count
/// @param may_stand  whether the axes may also stand still
/// @param spin  turns of the shaft per turn of the drive, above 0
/// @param mass_kg  that accelerations act on
std::vector<TurningLoad> turning_loads(const ChannelHistory& channels, int turns, double spin, int turning,
                                       bool may_stand, double mass_kg);

/// Segments of a contour as those of a beam.
std::vector<fem::BeamSegment> beam_segments(const meshes::Shaft& shaft);

/// @param solid_Hz  lowest natural frequency of the solid at rest in the same bearings, if it is known
CriticalSpeeds critical_speeds(const Scene& scene, const BodyScene& body, const MeshedBody& meshed,
                               const kinetics::LoadHistory& loads, const ChannelHistory& channels,
                               std::optional<double> solid_Hz);

/// The load that is nearest to a whirl, of imbalance and those with a share of 5 % and more; none: no whirl
/// is met at any speed.
std::optional<CriticalSpeed> governing_load(const CriticalSpeeds& speeds);

/// What is known of the error of the beam, in words.
std::string model_error_text(const CriticalSpeeds& speeds);

/// "imbalance", "load of order 2", "load of order 3 backward".
std::string load_name(double order);

}  // namespace pipelines

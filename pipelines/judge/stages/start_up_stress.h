/// Stresses of a body over its machine's start, on the unit responses of the steady run.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/judge/analysis/judged.h"
#include "pipelines/loads/stage/start_up_loads.h"

namespace pipelines {

/// A figure over the start beside the same over steady running.
struct StartUpFigure {
  double largest = 0;  ///< a torque with its sign; else a size
  double time_s = 0;
  double steady = 0;  ///< the largest size in steady running
  /// |largest| / steady; 0: nothing in steady running to compare with.
  double factor() const;
};

struct StartUpElement {
  std::string element, port;
  Eigen::ArrayXd torque_Nm;  ///< on the body, counter-clockwise positive
  StartUpFigure torque;      ///< [N m]
};

/// Torsional stress at the ring that is stressed most during the start.
struct StartUpRing {
  std::string feature;
  double z_m = 0;
  Eigen::ArrayXd stress_Pa;  ///< over the start (signed_ring_stress_Pa)
  StartUpFigure stress;      ///< [Pa]; steady: the largest of any ring
};

struct StartUpStress {
  Eigen::ArrayXd time_s;
  Eigen::ArrayXd drive_angle_rad, drive_speed_rad_s;  ///< of the reference shaft, true ones
  StartUpFigure von_mises;                            ///< [Pa], outside the exclusion distances
  std::string feature;                                ///< of that
  Place place = Place::interior;
  std::array<double, 3> position_m{};
  double safety = 0;       ///< yield strength / von Mises
  double error_share = 0;  ///< numerical, relative, as known of that place in steady running; infinite: not
  std::vector<double> effect_share;  ///< of the stress there and then, in the order of `effects`
  std::vector<std::string> effects;
  std::optional<StartUpRing> ring;  ///< not by the beam, and not without torsion
  std::vector<StartUpElement> elements;
};

/// @param analysis  of the steady run
/// @param steady    load stage of the steady run
StartUpStress start_up_stress(const Judged& analysis, const StartUp& start,
                              const kinetics::LoadHistory& steady, int n_threads);

}  // namespace pipelines

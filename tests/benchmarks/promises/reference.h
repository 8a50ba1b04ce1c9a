/// The stresses of a concentric shaft from harmonics around its axis, refined until they stand still.
#pragma once

#include <map>
#include <string>

#include "pipelines/loads/stage/load_stage.h"

namespace promises {

struct Reference {
  double peak_Pa = 0;
  std::string feature;                   ///< that holds the peak
  std::map<std::string, double> places;  ///< largest von Mises stress of every feature [Pa]
  std::map<std::string, double> errors;  ///< of these [Pa]
  double change = 0;                     ///< what may be missing of the peak, relative
};

/// Sections with cells halved until the peak changes by less than `wanted` (relative), at most four times,
/// with three times as many harmonics of the seat pressures as the scene has.
/// @param scene  its first body is the shaft
Reference axisymmetric_reference(const pipelines::Scene& scene, double wanted);

}  // namespace promises

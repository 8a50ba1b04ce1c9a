/// What beam theory does not know of stress near loads.
#pragma once

#include <vector>

#include "fem/base/values/unit_load.h"
#include "fem/models/beam/beam_shaft.h"

namespace fem {

/// What the surface stress of beam_responses may be wrong by near loads [Pa]: two and a half times the sum of
/// two parts.
///   - Axial loads enter through the surface. Within a diameter d of a place, the axial stress changes by D
///     along the shaft; of that at the distance x the place feels D (1 - x / d).
///   - Sections do not stay plane where the shear force V bends within less than a diameter: its largest von
///     Mises stress, sqrt(3) rim_shear V / A, in the ratio of d to the lever M / V, at most 1. At a lever of
///     five diameters that is 1 % of the bending stress.
/// What the factor was set on: fem/models/README.md.
/// @param factors  of each load its values at the instants
/// @param z_m      places on the shaft
/// @return largest over the instants, for each place
/// @throws std::invalid_argument as beam_responses, and for a place beside the shaft
std::vector<double> near_load_error_Pa(const BeamShaft& shaft, const std::vector<UnitLoad>& loads,
                                       const std::vector<std::vector<double>>& factors,
                                       const std::vector<double>& z_m);

/// The tractions by which loads enter seats: stress on the surface that beam theory does not have.
struct SeatTraction {
  double shear_Pa = 0;     ///< of torque and axial force
  double pressure_Pa = 0;  ///< of lateral forces, moments and the harmonics of the pressure; all of one sign
};

/// The profiles of SurfaceResultant and SeatPressure, made twice as wide, since places beside a seat feel
/// them, too.
/// @param factors, z_m  as in near_load_error_Pa
/// @return largest over the instants, for each place
std::vector<SeatTraction> seat_tractions(const std::vector<UnitLoad>& loads,
                                         const std::vector<std::vector<double>>& factors,
                                         const std::vector<double>& z_m);

}  // namespace fem

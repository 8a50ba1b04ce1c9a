/// The planetary mill with everything that follows from its parameters: what the effects are made from.
#pragma once

#include "kinetics/planetary_mill.h"

namespace kinetics::planetary {

struct Machine {
  PlanetaryMill mill;
  PlanetaryGeometry geometry;
  PlanetaryChargeBody charge;     ///< zero if no filling is given
  double offset_speed_rad_s = 0;  ///< [omega in (11)] w: Omega under `consistent`, else the drum's spin
  double weight_lag_rad = 0;      ///< the charge's weight turns with sin(phi + this): 0 under as_published
  double axle_belt_sine = 0;      ///< times T1 - T2: the belt's part of Y_A, with the convention's sign
};

Machine make_machine(const PlanetaryMill& mill);

}  // namespace kinetics::planetary

/// Planetary mills that the tests of kinetics share.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "kinetics/planetary_mill.h"
#include "kinetics/values/constants.h"

namespace machines {

using kinetics::pi;

/// Set B of the documentation: the printed data, buildable; c = 0.5, half full, at 30 rad/s.
kinetics::PlanetaryMill printed_planetary();

/// A mill that can be built, every parameter drawn at random: both kinds of geometry, all three belts, slow
/// carriers whose belt has to change sides and fast ones, c on both sides of 1.
kinetics::PlanetaryMill random_planetary(std::mt19937& generator);

/// All effects of the mill's convention, except the named ones.
std::vector<std::string> effects_without(const kinetics::PlanetaryMill& mill,
                                         const std::vector<std::string>& without);

}  // namespace machines

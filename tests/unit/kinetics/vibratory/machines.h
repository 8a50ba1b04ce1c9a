/// Machines that the tests of kinetics share.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "kinetics/vibratory_mill.h"

namespace machines {

/// The laboratory mill of the reference outputs (tests/data), preload left to its default. Its motion repeats
/// after 20 turns: (omega_e + omega_r) / omega_e = -1/20.
kinetics::VibratoryMill laboratory();

/// A mill with one to four springs and every parameter drawn at random, within the sizes that mills have.
/// Springs have damping, so that no draw is an undamped resonance.
kinetics::VibratoryMill random(std::mt19937& generator);

/// All effects of the mill's convention, except the named ones.
std::vector<std::string> effects_without(const kinetics::VibratoryMill& mill,
                                         const std::vector<std::string>& without);

/// Largest absolute value.
double largest(const Eigen::ArrayXd& values);

}  // namespace machines

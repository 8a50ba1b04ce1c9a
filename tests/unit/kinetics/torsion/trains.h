/// Drive trains that the tests of kinetics share.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "kinetics/drive_train.h"

namespace trains {

/// A shaft line "s" with these inertias and the stiffnesses between them.
kinetics::DriveTrain chain(const std::vector<double>& inertia_kg_m2,
                           const std::vector<double>& stiffness_N_m_rad);

/// An excitation of one harmonic.
kinetics::TrainExcitation harmonic(const std::string& inertia, double amplitude_Nm, double frequency_rad_s,
                                   double phase_rad = 0);

/// Root-peeling machine MOK-150, spec of the drive train: five masses, motor to disc, shaft lines "motor" and
/// "working"; mains torque of 3.744 N m on the rotor, 9.6 N m on the disc against it, both at 2 pi 50 rad/s.
/// @param belt_on             the shaft line that the belt's stiffness refers to
/// @param half_shaft_N_m_rad  stiffness of each half of the working shaft, on its own line
kinetics::DriveTrain mok150(const std::string& belt_on, double half_shaft_N_m_rad = 9.5e5);

struct RandomTrain {
  int most_inertias = 12;
  double decades = 4;  ///< spread of inertias and stiffnesses
  bool damped = true;
  bool rigid = true;  ///< some elements are rigid
};

/// A tree of shafts, belts and gears with two harmonics, drawn at random; damping is strong enough that no
/// draw is a resonance.
kinetics::DriveTrain random(std::mt19937& generator, const RandomTrain& kind);

/// Natural frequencies by counting in long double: how many lie below w follows from the signs of the dynamic
/// stiffnesses along the tree (J. Demmel, W. Gragg 1993), each found by bisection. Needs a train without
/// rigid or held members.
std::vector<long double> counted_frequencies(const kinetics::DriveTrain& train);

}  // namespace trains

/// The excitations of a train as constants and lines of a spectrum.
#pragma once

#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "kinetics/drive_train.h"
#include "kinetics/torsion_chain/reduced.h"

namespace kinetics::torsion {

/// One frequency of one excitation: torque Re(amplitude e^(i w t)) on an inertia, real.
struct TorqueLine {
  double frequency_rad_s = 0;
  double order = 0;  ///< order by the speed of the reference shaft; zero where the frequency is given
  std::complex<double> amplitude_Nm;
  Index inertia = 0;
  std::string excitation;
};

struct Spectral {
  Eigen::ArrayXd constant_Nm;  ///< per inertia, real
  std::vector<TorqueLine> lines;
};

/// All excitations; a table contributes its discrete Fourier series. Lines without amplitude are kept where a
/// harmonic says so, and dropped where they are a table's round-off.
Spectral spectral(const DriveTrain& train, const ReducedTrain& reduced);

/// Torque per inertia at an instant.
Eigen::ArrayXd torque_at(const Spectral& excitation, double time_s);

/// Shortest period of all frequencies; empty if there is none, or none up to 1000 times the longest single
/// one.
std::optional<double> common_period_s(const std::vector<double>& frequencies_rad_s);

}  // namespace kinetics::torsion

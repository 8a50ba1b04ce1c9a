/// Harmonics of a periodic series, and force pairs as magnitude and direction.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace kinetics {

/// One line of a line spectrum: amplitude * cos(order * angle - phase_rad).
struct Harmonic {
  double order = 0;      ///< relative to the drive: 1 is once per turn of it; 1/turns is the lowest
  double amplitude = 0;  ///< >= 0, unit of the series
  double phase_rad = 0;  ///< in (-pi, pi]; zero where the amplitude is round-off
};

/// x(angle) = mean + sum of A_n cos(n angle - phase_n); angle: what the drive has turned since the first
/// instant.
struct LineSpectrum {
  double mean = 0;
  std::vector<Harmonic> lines;  ///< by rising order
};

/// Line spectrum of a series sampled at equidistant instants over whole turns of the drive, by direct sums.
/// Lines that lie between the orders k / turns leak into their neighbours: choose a window over which the
/// motion repeats.
/// @param values    n values at angles 2 pi turns i / n, i = 0 .. n - 1; n >= 1
/// @param turns     turns of the drive that they cover, >= 1
/// @param n_lines   lines asked for, 0 .. n / 2: orders 1/turns, 2/turns, ... The one at n / 2 is known by
/// its
///                  cosine alone (sampled at its peaks).
/// @throws MachineRefused if the series is empty or not finite, or turns or n_lines out of range
LineSpectrum line_spectrum(const Eigen::ArrayXd& values, int turns, int n_lines);

/// A force over time as a polar plot draws it.
struct PolarSeries {
  Eigen::ArrayXd magnitude;      ///< >= 0, unit of the components
  Eigen::ArrayXd direction_rad;  ///< counter-clockwise from +x, in (-pi, pi]; zero where there is no force
};

/// Components in the fixed frame (x right, y up) to magnitude and direction.
/// @throws MachineRefused if the sizes differ or a component is not finite
PolarSeries polar(const Eigen::ArrayXd& fx, const Eigen::ArrayXd& fy);

}  // namespace kinetics

#include "kinetics/torsion_chain/excitation.h"

#include <algorithm>
#include <cmath>

#include "kinetics/torsion_chain/checks.h"
#include "kinetics/values/constants.h"

namespace kinetics::torsion {
namespace {

/// Order of the reference shaft for an order of a shaft line.
double reference_order(const DriveTrain& train, const ReducedTrain& reduced, double order,
                       const std::string& order_of) {
  const std::string& line = order_of.empty() ? train.reference_shaft : order_of;
  const auto on_it = [&](const TrainInertia& i) { return i.shaft == line; };
  const auto found = std::find_if(train.inertias.begin(), train.inertias.end(), on_it);
  return order * std::abs(reduced.ratio[found - train.inertias.begin()]);
}

/// Adds the discrete Fourier series of the table; the mean is returned.
double add_table(const std::vector<double>& torque_Nm, const TorqueLine& fundamental,
                 std::vector<TorqueLine>& lines) {
  const std::size_t n = torque_Nm.size();
  double largest_Nm = 0, mean_Nm = 0;
  std::vector<std::complex<double>> root(n);
  for (std::size_t j = 0; j < n; ++j) {
    largest_Nm = std::max(largest_Nm, std::abs(torque_Nm[j]));
    mean_Nm += torque_Nm[j] / double(n);
    root[j] = std::polar(1.0, -2 * pi * double(j) / double(n));
  }
  for (std::size_t k = 1; 2 * k <= n; ++k) {
    std::complex<double> sum = 0;
    for (std::size_t j = 0; j < n; ++j) sum += torque_Nm[j] * root[j * k % n];
    TorqueLine line = fundamental;
    line.frequency_rad_s *= double(k);
    line.order *= double(k);
    line.amplitude_Nm = sum * (2 * k == n ? 1.0 : 2.0) / double(n);
    if (std::abs(line.amplitude_Nm) > 1e-14 * largest_Nm) lines.push_back(line);
  }
  return mean_Nm;
}

}  // namespace

Spectral spectral(const DriveTrain& train, const ReducedTrain& reduced) {
  check_excitations(train);
  Spectral result{Eigen::ArrayXd::Zero(static_cast<Index>(train.inertias.size())), {}};
  for (const TrainExcitation& x : train.excitations) {
    const Index inertia = inertia_at(train, x.inertia, x.name + ".inertia");
    const auto line = [&](const auto& rhythm) {
      TorqueLine made{0, 0, 0, inertia, x.name};
      if (rhythm.order) made.order = reference_order(train, reduced, *rhythm.order, rhythm.order_of);
      made.frequency_rad_s = rhythm.frequency_rad_s.value_or(made.order * train.reference_speed_rad_s);
      return made;
    };
    result.constant_Nm[inertia] += x.constant_Nm;
    for (const TorqueHarmonic& harmonic : x.harmonics) {
      result.lines.push_back(line(harmonic));
      result.lines.back().amplitude_Nm =
          harmonic.amplitude_Nm *
          std::complex<double>(std::cos(harmonic.phase_rad), -std::sin(harmonic.phase_rad));
    }
    if (!x.table.torque_Nm.empty())
      result.constant_Nm[inertia] += add_table(x.table.torque_Nm, line(x.table), result.lines);
  }
  return result;
}

Eigen::ArrayXd torque_at(const Spectral& excitation, double time_s) {
  Eigen::ArrayXd torque_Nm = excitation.constant_Nm;
  for (const TorqueLine& line : excitation.lines) {
    const double angle_rad = line.frequency_rad_s * time_s;
    torque_Nm[line.inertia] +=
        line.amplitude_Nm.real() * std::cos(angle_rad) - line.amplitude_Nm.imag() * std::sin(angle_rad);
  }
  return torque_Nm;
}

std::optional<double> common_period_s(const std::vector<double>& frequencies_rad_s) {
  if (frequencies_rad_s.empty()) return std::nullopt;
  const double base = *std::min_element(frequencies_rad_s.begin(), frequencies_rad_s.end());
  for (int q = 1; q <= 1000; ++q) {
    const auto whole = [&](double w) {
      return std::abs(w / base * q - std::round(w / base * q)) <= 1e-9 * (w / base) * q;
    };
    if (std::all_of(frequencies_rad_s.begin(), frequencies_rad_s.end(), whole)) return q * (2 * pi) / base;
  }
  return std::nullopt;
}

}  // namespace kinetics::torsion

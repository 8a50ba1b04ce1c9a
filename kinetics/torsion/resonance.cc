#include <algorithm>
#include <cmath>

#include "kinetics/torsion/forced.h"
#include "kinetics/values/constants.h"
#include "kinetics/values/machine_refused.h"
#include "kinetics/values/wrong_input.h"

namespace kinetics {
namespace torsion {
namespace {

/// @param digits  so many as tell a frequency from a natural one
std::string both_units(double frequency_rad_s, int digits) {
  return rounded(frequency_rad_s, digits) + " rad/s (" + rounded(frequency_rad_s / (2 * pi), digits) + " Hz)";
}

/// Amplification of a mode at r times its natural frequency; infinite at an undamped resonance.
double amplification(double r, double damping_ratio) {
  return 1 / std::hypot((1 - r) * (1 + r), 2 * damping_ratio * r);
}

constexpr int digits_of_refusal = 12, digits_of_warning = 6;

/// Column of the natural frequency nearest to w, on a scale of ratios.
Index nearest_mode(const Eigen::ArrayXd& frequency_rad_s, double w) {
  Index nearest = 0;
  (frequency_rad_s / w).log().abs().minCoeff(&nearest);
  return nearest;
}

}  // namespace

double damping_ratio(const PreparedTrain& prepared, Index mode) {
  const double local =
      prepared.reduced.damped() ? mode_damping(prepared.reduced, prepared.spectrum, mode) : 0;
  return local + prepared.train.modal_damping_ratio;
}

std::vector<std::string> resonance_warnings(const PreparedTrain& prepared,
                                            const std::vector<TorqueLine>& lines) {
  std::vector<std::string> warnings;
  if (prepared.reduced.n_edges() == 0) return warnings;
  const Index shift = prepared.reduced.held ? 0 : 1;
  for (const TorqueLine& line : lines) {
    const Index k = nearest_mode(prepared.spectrum.frequency_rad_s, line.frequency_rad_s);
    const double w_k = prepared.spectrum.frequency_rad_s[k], r = line.frequency_rad_s / w_k;
    if (std::abs(r - 1) > 0.1 || line.amplitude_Nm == 0.0) continue;
    const double zeta = damping_ratio(prepared, k);
    if (std::abs(r - 1) <= 1e-12 && zeta < 1e-14)
      throw MachineRefused("excitation " + line.excitation + " at " +
                           both_units(line.frequency_rad_s, digits_of_refusal) +
                           ": meets the natural frequency " + both_units(w_k, digits_of_refusal) +
                           " of mode " + std::to_string(k + shift) +
                           ", which nothing damps; there is no steady state: give damping, or change the "
                           "frequency");
    warnings.push_back(
        "excitation " + line.excitation + " at " + both_units(line.frequency_rad_s, digits_of_warning) +
        " is " + rounded(100 * std::abs(r - 1), 3) + " % from the natural frequency " +
        both_units(w_k, digits_of_warning) + " of mode " + std::to_string(k + shift) +
        ": it is amplified up to " + number(std::round(100 * amplification(r, zeta)) / 100) + " times");
  }
  return warnings;
}

}  // namespace torsion

std::vector<ResonanceMargin> resonance_margins(const DriveTrain& train) {
  const torsion::PreparedTrain prepared(train);
  const auto& reduced = prepared.reduced;
  const auto& natural = prepared.spectrum.frequency_rad_s;
  std::vector<ResonanceMargin> margins;
  if (natural.size() == 0) return margins;
  for (const auto& line : torsion::spectral(train, reduced).lines) {
    const Eigen::Index k = torsion::nearest_mode(natural, line.frequency_rad_s);
    const double margin = line.frequency_rad_s / natural[k] - 1;
    const double zeta = torsion::damping_ratio(prepared, k);
    margins.push_back({{line.excitation, line.order, line.frequency_rad_s},
                       k + (reduced.held ? 0 : 1),
                       natural[k],
                       margin,
                       zeta,
                       torsion::amplification(1 + margin, zeta)});
  }
  std::stable_sort(margins.begin(), margins.end(),
                   [](const auto& a, const auto& b) { return std::abs(a.margin) < std::abs(b.margin); });
  return margins;
}

}  // namespace kinetics

#include "kinetics/planetary_effects/belt.h"

#include <cmath>

#include "kinetics/planetary_effects/effect.h"
#include "kinetics/values/wrong_input.h"

namespace kinetics::planetary {
namespace {

using Eigen::Array2Xd;
using Eigen::ArrayXd;

double slip_exponent(const Machine& machine, double friction) {
  return friction * machine.geometry.wrap_rad;
}

/// Slack strand over |T1 - T2|, for belts whose tensions grow with it.
double slack_factor(const Machine& machine) {
  if (const auto* ratio = std::get_if<RatioBelt>(&machine.mill.belt)) return 1 / (ratio->ratio - 1);
  const double friction = std::get<EytelweinBelt>(machine.mill.belt).friction;
  return 1 / std::expm1(slip_exponent(machine, friction));
}

}  // namespace

TensionSum tension_sum(const Machine& machine) {
  const PlanetaryBelt& belt = machine.mill.belt;
  if (const auto* pretensioned = std::get_if<PretensionedBelt>(&belt))
    return {0, 2 * pretensioned->pretension_N, false};
  if (const auto* eytelwein = std::get_if<EytelweinBelt>(&belt))
    return {1 / std::tanh(slip_exponent(machine, eytelwein->friction) / 2), 0, false};
  const double ratio = std::get<RatioBelt>(belt).ratio;
  return {(ratio + 1) / (ratio - 1), 0, machine.mill.convention != PlanetaryConvention::consistent};
}

Tensions tensions(const Machine& machine, const ArrayXd& difference_N) {
  const TensionSum sum = tension_sum(machine);
  if (std::holds_alternative<PretensionedBelt>(machine.mill.belt)) {
    const ArrayXd half_N = ArrayXd::Constant(difference_N.size(), sum.constant_N / 2);
    return {half_N + difference_N / 2, half_N - difference_N / 2, 2 * half_N};
  }
  const ArrayXd driving_N = sum.follows_sign ? difference_N : ArrayXd(difference_N.abs());
  const ArrayXd slack_N = slack_factor(machine) * driving_N, tight_N = slack_N + driving_N;
  const auto as_named = (difference_N == driving_N).eval();
  return {as_named.select(tight_N, slack_N), as_named.select(slack_N, tight_N), sum.factor * driving_N};
}

std::vector<std::string> belt_warnings(const Machine& machine, const Tensions& t) {
  std::vector<std::string> warnings;
  const auto* pretensioned = std::get_if<PretensionedBelt>(&machine.mill.belt);
  const ArrayXd slack_N = t.T1_N.min(t.T2_N), tight_N = t.T1_N.max(t.T2_N);
  const double least_N = slack_N.minCoeff();
  if (least_N < 0)
    warnings.push_back(
        "a belt strand falls to " + rounded(least_N) + " N: a belt cannot push; " +
        (pretensioned ? "it hangs slack, raise its pretension"
                      : "the ratio T1 = K T2 is kept where the belt has to turn the drum the other way"));
  if (pretensioned) {
    const double most = std::exp(slip_exponent(machine, pretensioned->friction));
    if (((tight_N > most * slack_N) && (slack_N >= 0)).any())
      warnings.push_back("the belt slips: tight over slack strand exceeds exp(mu theta) = " + rounded(most) +
                         "; raise pretension or friction");
  } else if (least_N >= 0 && (t.T1_N > t.T2_N).any() && (t.T1_N < t.T2_N).any()) {
    warnings.push_back(
        "the belt's tight strand changes sides in each turn: the charge's weight exceeds its inertia; the "
        "drum rattles in its drive");
  }
  return warnings;
}

Effect belt(const Machine& machine) {
  return [machine](const Instants& at) {
    const PlanetaryGeometry& g = machine.geometry;
    const ArrayXd difference_N = at.moment_Nm / g.drum_pulley_m;
    const ArrayXd along_N = -g.belt_cosine * tensions(machine, difference_N).sum_N;
    Array2Xd force_N(2, at.size()), on_axle_N(2, at.size());
    force_N.row(0) = along_N.transpose();
    force_N.row(1) = -g.belt_sine * difference_N.transpose();
    on_axle_N.row(0) = along_N.transpose();
    on_axle_N.row(1) = -machine.axle_belt_sine * difference_N.transpose();  // (14), Y
    return EffectLoad{Receiver::pulley, force_N, -at.moment_Nm, on_axle_N};
  };
}

}  // namespace kinetics::planetary

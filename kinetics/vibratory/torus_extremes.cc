#include "kinetics/vibratory/torus_extremes.h"

#include <algorithm>
#include <cmath>

#include "kinetics/values/machine_refused.h"
#include "kinetics/values/wrong_input.h"
#include "kinetics/vibratory/balance.h"
#include "kinetics/vibratory/checks.h"
#include "kinetics/vibratory/pitch.h"
#include "kinetics/vibratory/published.h"

namespace kinetics {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr int points = 72;       // to a turn of either angle
constexpr int n_candidates = 4;  // local extremes of the grid that are refined
const double circle_rad = 2 * std::acos(-1.0);

/// The mill's steady loads as a function of the two angles.
class Torus {
public:
  Torus(const VibratoryMill& mill, const std::vector<std::string>& effects)
      : mill_(mill), effects_(vibratory::make_effects(mill, effects)) {
    if (vibratory::contains(effects, "pitch")) pitch_ = vibratory::solve_pitch(mill, effects_);
  }

  LoadHistory at(const ArrayXd& phi_rad, const ArrayXd& chi_rad) const {
    vibratory::Instants motion = vibratory::steady_at(mill_, phi_rad, chi_rad);
    pitch_.apply(motion);
    LoadHistory loads = vibratory::empty_history(mill_, effects_, ArrayXd::Zero(phi_rad.size()), motion);
    if (mill_.convention == Convention::published)
      vibratory::published_over(mill_, effects_, motion, loads);
    else
      vibratory::balance_over(mill_, effects_, motion, loads);
    return loads;
  }

private:
  VibratoryMill mill_;
  std::vector<vibratory::NamedEffect> effects_;
  vibratory::PitchMotion pitch_;
};

double within_turn(double angle_rad) {
  const double rest = std::fmod(angle_rad, circle_rad);
  return rest < 0 ? rest + circle_rad : rest;
}

/// Climbs sign * quantity from a point of the grid: to the best of 5 x 5 neighbours, or half the step.
TorusPoint climb(const Torus& torus, const std::string& quantity, double sign, double phi_rad,
                 double chi_rad) {
  double step_rad = circle_rad / points / 2;
  TorusPoint best{0, phi_rad, chi_rad};
  ArrayXd phi(25), chi(25);
  while (step_rad > 1e-8) {
    for (Index i = 0; i < 25; ++i) {
      phi[i] = best.phi_rad + step_rad * double(i / 5 - 2);
      chi[i] = best.chi_rad + step_rad * double(i % 5 - 2);
    }
    const ArrayXd values = torus.at(phi, chi).quantity(quantity).values;
    Index top = 0;
    (sign * values).maxCoeff(&top);
    if (!(sign * values[top] > sign * values[12])) top = 12;
    best = {values[top], phi[top], chi[top]};
    if (top == 12) step_rad /= 3;
  }
  return {best.value, within_turn(best.phi_rad), within_turn(best.chi_rad)};
}

/// Indices of the grid at which no neighbour is higher, the highest first.
std::vector<Index> local_maxima(const ArrayXd& values) {
  std::vector<Index> found;
  for (int i = 0; i < points; ++i)
    for (int j = 0; j < points; ++j) {
      const double here = values[i * points + j];
      bool highest = true;
      for (int k = 0; k < 9; ++k)
        highest &=
            values[((i + k / 3 - 1 + points) % points) * points + (j + k % 3 - 1 + points) % points] <= here;
      if (highest) found.push_back(i * points + j);
    }
  std::stable_sort(found.begin(), found.end(), [&](Index a, Index b) { return values[a] > values[b]; });
  return found;
}

TorusPoint highest(const Torus& torus, const Quantity& on_grid, const ArrayXd& phi, const ArrayXd& chi,
                   double sign) {
  const auto candidates = local_maxima(sign * on_grid.values);
  TorusPoint best{on_grid.values[candidates.front()], phi[candidates.front()], chi[candidates.front()]};
  for (std::size_t i = 0; i < candidates.size() && i < n_candidates; ++i) {
    const TorusPoint found = climb(torus, on_grid.name, sign, phi[candidates[i]], chi[candidates[i]]);
    if (sign * found.value > sign * best.value) best = found;
  }
  return best;
}

bool is_load(const std::string& name) {
  return name == "R_E" || name == "B" || name == "T" || name == "theta" || name.rfind("spring_", 0) == 0;
}

void require_torus_quantity(const LoadHistory& loads, const std::string& name) {
  std::vector<std::string> known;
  for (const Quantity& quantity : loads.quantities)
    if (quantity.name != "chi" && quantity.has_statistics) known.push_back(quantity.name);
  if (!vibratory::contains(known, name))
    throw MachineRefused("quantity " + name + ": has no extremes with these effects; did you mean " +
                         nearest(name, known) + "? Known: " + listed(known));
}

}  // namespace

std::vector<TorusExtremes> torus_extremes(const VibratoryMill& mill, const std::vector<std::string>& effects,
                                          std::vector<std::string> quantities) {
  vibratory::check_effects(mill.convention, effects);
  vibratory::check_parameters(mill, effects);
  ArrayXd phi(points * points), chi(points * points);
  for (Index i = 0; i < phi.size(); ++i) {
    phi[i] = circle_rad * double(i / points) / points;
    chi[i] = circle_rad * double(i % points) / points;
  }
  const Torus torus(mill, effects);
  const LoadHistory on_grid = torus.at(phi, chi);
  if (quantities.empty())
    for (const Quantity& quantity : on_grid.quantities)
      if (is_load(quantity.name)) quantities.push_back(quantity.name);
  std::vector<TorusExtremes> extremes;
  for (const std::string& name : quantities) {
    require_torus_quantity(on_grid, name);
    const Quantity& quantity = on_grid.quantity(name);
    extremes.push_back(
        {name, quantity.unit, highest(torus, quantity, phi, chi, -1), highest(torus, quantity, phi, chi, 1)});
  }
  return extremes;
}

}  // namespace kinetics

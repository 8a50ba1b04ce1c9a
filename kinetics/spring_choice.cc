#include "kinetics/spring_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinetics/values/machine_refused.h"
#include "kinetics/values/wrong_input.h"
#include "kinetics/vibratory/checks.h"
#include "kinetics/vibratory/spring_choice.h"
#include "kinetics/vibratory_effects/affine_optimum.h"
#include "kinetics/vibratory_effects/effect.h"
#include "kinetics/vibratory_effects/springs.h"

namespace kinetics {
namespace {

using vibratory::ScalableMill;

/// Total vertical stiffness of the given springs.
double check(const VibratoryMill& mill, const std::vector<std::string>& effects, const TimeGrid& grid,
             const SpringSearch& search) {
  vibratory::check_effects(mill.convention, effects);
  vibratory::check_parameters(mill, effects);
  check_grid(grid);
  if (!vibratory::contains(effects, "springs"))
    throw MachineRefused("springs: the effect is off, so there are none to choose; add it");
  if (mill.eccentricity_m == 0)
    refuse("eccentricity", 0,
           "without eccentricity the springs do not move and no stiffness is better than another; give the "
           "eccentricity");
  double total_N_m = 0;
  for (const Spring& spring : mill.springs) total_N_m += spring.stiffness_N_m.y();
  if (total_N_m <= 0)
    refuse("sum of the springs' vertical stiffness", total_N_m,
           "the given springs are scaled and set the proportions; give them vertical stiffness");
  require_finite("search.least_scale", search.least_scale);
  require_finite("search.most_scale", search.most_scale);
  if (search.least_scale <= 0) refuse("search.least_scale", search.least_scale, "must be positive");
  if (search.most_scale <= search.least_scale)
    refuse("search.most_scale", search.most_scale, "must exceed search.least_scale");
  if (search.n_scan < 3) refuse("search.n_scan", search.n_scan, "must be at least 3");
  if (!(search.most_transmitted_N > 0))
    refuse("search.most_transmitted_N", search.most_transmitted_N, "must be positive");
  return total_N_m;
}

double held_optimum(const ScalableMill& mill, SpringAim aim) {
  const Eigen::Array2Xd R0_N = mill.reaction_N(0), G_N = mill.slope_N();
  return aim == SpringAim::rms ? vibratory::rms_optimum(R0_N, G_N) : vibratory::peak_optimum(R0_N, G_N);
}

void warn(const VibratoryMill& mill, bool searched, const SpringSearch& search, SpringChoice& choice) {
  const double mass_kg = mill.charge_mass_kg + mill.structure_mass_kg + mill.exciter_mass_kg;
  const double bounce_rad_s = mass_kg > 0 ? std::sqrt(choice.stiffness_N_m / mass_kg) : 0;
  if (std::abs(bounce_rad_s / mill.speed_rad_s - 1) < 0.2)
    choice.warnings.push_back("with k* = " + rounded(choice.stiffness_N_m) + " N/m the chamber bounces at " +
                              rounded(bounce_rad_s) + " rad/s, within 20 % of the drive's " +
                              rounded(mill.speed_rad_s) +
                              " rad/s: springs that carry the inertia are in resonance, and any play of the "
                              "eccentric or slip of the drive is no longer held back");
  if (choice.scale == 0)
    choice.warnings.push_back("k* = 0: any stiffness raises the reaction; the weights need springs still");
  const double ends = 1e-6;
  if (searched && choice.scale <= search.least_scale * (1 + ends))
    choice.warnings.push_back("k* lies at the soft end of the search: the bound decides, not the reaction");
  if (searched && choice.scale >= search.most_scale * (1 - ends))
    choice.warnings.push_back("k* lies at the stiff end of the search: the bound decides, not the reaction");
  for (const PitchResonance& resonance : choice.resonances)
    if (resonance.between_given_and_chosen)
      choice.warnings.push_back("between the given springs and k* the pitch passes a resonance at " +
                                rounded(resonance.frequency_rad_s) +
                                " rad/s, k = " + rounded(resonance.stiffness_N_m) + " N/m");
}

}  // namespace

SpringChoice choose_springs(const VibratoryMill& mill, const std::vector<std::string>& effects,
                            const TimeGrid& grid, SpringAim aim, const SpringSearch& search) {
  const double given_N_m = check(mill, effects, grid, search);
  ScalableMill scalable{mill, effects, grid};
  if (mill.convention == Convention::consistent)
    scalable.mill.springs = vibratory::with_preloads(mill, effects);
  const auto reaction = [&](double scale) {
    try {
      const Eigen::Array2Xd R_N = scalable.reaction_N(scale);
      return aim == SpringAim::rms ? vibratory::rms_norm(R_N) : vibratory::peak_norm(R_N);
    } catch (const MachineRefused&) {  // all input is checked: an undamped resonance
      return std::numeric_limits<double>::infinity();
    }
  };
  const auto objective = [&](double scale) {
    const double reaction_N = reaction(scale);
    const bool is_free = !std::isfinite(search.most_transmitted_N) || !std::isfinite(reaction_N);
    return is_free || scalable.transmitted_N(scale) <= search.most_transmitted_N
               ? reaction_N
               : std::numeric_limits<double>::infinity();
  };
  const bool has_pitch = vibratory::contains(effects, "pitch"),
             searched = has_pitch || search.bounds_held_pitch;
  SpringChoice choice;
  choice.scale = searched ? vibratory::scan_for_least(objective, search) : held_optimum(scalable, aim);
  choice.stiffness_N_m = choice.scale * given_N_m;
  choice.reaction_N = objective(choice.scale);
  choice.reaction_given_N = reaction(1);
  if (!std::isfinite(choice.reaction_N) && std::isfinite(search.most_transmitted_N))
    refuse("largest transmitted force [N]", search.most_transmitted_N,
           "no springs of the search keep it: allow more, or let the search go farther");
  if (!std::isfinite(choice.reaction_N))
    refuse("search.most_scale", search.most_scale,
           "every scale of the search is an undamped resonance of the pitch, or its mean moment is not "
           "resisted; check springs and speed, or give the springs damping");
  choice.transmitted_N = scalable.transmitted_N(choice.scale);
  if (std::isfinite(choice.reaction_given_N)) choice.transmitted_given_N = scalable.transmitted_N(1);
  if (has_pitch) choice.resonances = vibratory::pitch_resonances(scalable, search);
  for (PitchResonance& resonance : choice.resonances)
    resonance.between_given_and_chosen = (resonance.scale - 1) * (resonance.scale - choice.scale) < 0;
  warn(mill, searched, search, choice);
  return choice;
}

}  // namespace kinetics

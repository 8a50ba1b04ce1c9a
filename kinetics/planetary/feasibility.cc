#include "kinetics/planetary/feasibility.h"

#include <cmath>

#include "kinetics/values/machine_refused.h"
#include "kinetics/values/wrong_input.h"

namespace kinetics::planetary {
namespace {

constexpr double touching = 1e-12;  // relative: pulleys that touch by design are not refused for rounding

/// The lengths in the words in which they were given.
std::string given(const PlanetaryMill& mill) {
  if (const auto* ratios = std::get_if<PlanetaryRatios>(&mill.geometry))
    return "geometry.k = " + number(ratios->k) + ", geometry.c = " + number(ratios->c) + ": ";
  return "geometry.carrier_length = " + number(std::get<PlanetaryLengths>(mill.geometry).carrier_m) + ": ";
}

}  // namespace

std::vector<std::string> check_feasibility(const PlanetaryMill& mill) {
  const PlanetaryGeometry g = planetary_geometry(mill);
  const bool consistent = mill.convention == PlanetaryConvention::consistent;
  std::vector<std::string> findings;
  if (std::abs(g.belt_sine) > 1) {
    const std::string none = given(mill) + "one pulley contains the other and no belt exists, |sin beta| = " +
                             number(std::abs(g.belt_sine));
    if (consistent || !mill.belt_beyond_geometry)
      throw MachineRefused(none + "; c must be at least k (l_OA at least |r_O - r_A|)" +
                           (consistent ? "" : ", or set belt.beyond_geometry to reproduce Fig. 8"));
    findings.push_back(none + "; cos beta is taken as zero");
  }
  if (g.wrap_rad == 0 && std::holds_alternative<EytelweinBelt>(mill.belt))
    throw MachineRefused(
        given(mill) +
        "the smaller pulley has no wrap, and without wrap friction carries no belt; choose the belt of a "
        "given ratio, or move the axes apart");
  const double pulleys_m = g.central_pulley_m + g.drum_pulley_m;
  if (pulleys_m > g.carrier_m * (1 + touching))
    findings.push_back(given(mill) +
                       "the pulleys overlap in their plane; l_OA must be at least r_O + r_A = " +
                       number(pulleys_m) + " m, k at most c / (1 + 2c)");
  if (g.carrier_m <= mill.drum_radius_m)
    findings.push_back(given(mill) + "opposite drums overlap; l_OA must exceed drum_radius = " +
                       number(mill.drum_radius_m) + ", (1 - k) / k must exceed b");
  if (consistent && !findings.empty()) throw MachineRefused(findings.front());
  for (std::string& finding : findings) finding = "this machine cannot be built: " + finding;
  return findings;
}

}  // namespace kinetics::planetary

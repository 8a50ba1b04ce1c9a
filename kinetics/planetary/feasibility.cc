#include "kinetics/planetary/feasibility.h"

#include <cmath>
#include <stdexcept>

#include "kinetics/wrong_input.h"

namespace kinetics::planetary {
namespace {

constexpr double touching = 1e-12;  // relative: pulleys that touch by design are not refused for rounding

/// The parameter to change, in the words of the geometry that was given.
std::string wording(const PlanetaryMill& mill, const std::string& as_ratios, const std::string& as_lengths) {
  if (const auto* ratios = std::get_if<PlanetaryRatios>(&mill.geometry))
    return "geometry.k = " + number(ratios->k) + ", geometry.c = " + number(ratios->c) + ": " + as_ratios;
  const auto& lengths = std::get<PlanetaryLengths>(mill.geometry);
  return "geometry.carrier_m = " + number(lengths.carrier_m) + ": " + as_lengths;
}

}  // namespace

std::vector<std::string> check_feasibility(const PlanetaryMill& mill) {
  const PlanetaryGeometry g = planetary_geometry(mill);
  const bool consistent = mill.convention == PlanetaryConvention::consistent;
  std::vector<std::string> findings;
  if (std::abs(g.belt_sine) > 1) {
    const std::string none = wording(mill, "one pulley contains the other and no belt exists, |sin beta| = ",
                                     "one pulley contains the other and no belt exists, |sin beta| = ") +
                             number(std::abs(g.belt_sine));
    if (consistent || !mill.belt_beyond_geometry)
      throw std::invalid_argument(none + "; c must be at least k (l_OA at least |r_O - r_A|)" +
                                  (consistent ? "" : ", or set belt_beyond_geometry to reproduce Fig. 8"));
    if (!std::holds_alternative<RatioBelt>(mill.belt))
      throw std::invalid_argument(none + "; beyond geometry only the belt of a given ratio can be computed");
    findings.push_back(none + "; cos beta is taken as zero");
  }
  const double pulleys_m = g.central_pulley_m + g.drum_pulley_m;
  if (pulleys_m > g.carrier_m * (1 + touching))
    findings.push_back(wording(
        mill, "the pulleys overlap in their plane; k must not exceed c / (1 + 2c)",
        "the pulleys overlap in their plane; it must be at least r_O + r_A = " + number(pulleys_m) + " m"));
  if (g.carrier_m <= mill.drum_radius_m)
    findings.push_back(
        wording(mill, "opposite drums overlap; (1 - k) / k must exceed b",
                "opposite drums overlap; it must exceed drum_radius_m = " + number(mill.drum_radius_m)));
  if (consistent && !findings.empty()) throw std::invalid_argument(findings.front());
  for (std::string& finding : findings) finding = "this machine cannot be built: " + finding;
  return findings;
}

}  // namespace kinetics::planetary

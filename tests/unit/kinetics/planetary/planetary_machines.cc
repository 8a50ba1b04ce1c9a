#include "tests/unit/kinetics/planetary/planetary_machines.h"

#include <algorithm>
#include <cmath>

namespace machines {

kinetics::PlanetaryMill printed_planetary() {
  kinetics::PlanetaryMill mill;
  mill.speed_rad_s = 30;
  mill.drum_radius_m = 0.1;
  mill.drum_length_m = 1;
  mill.drum_mass_kg = 79.47;
  mill.geometry = kinetics::PlanetaryRatios{0.1, 1, 0.5};
  mill.charge.bulk_density_kg_m3 = 4600;
  mill.charge.half_angle_rad = pi / 2;
  mill.charge.segment_angle_rad = 50 * pi / 180;
  return mill;
}

kinetics::PlanetaryMill random_planetary(std::mt19937& generator) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(generator);
  };
  kinetics::PlanetaryMill mill;
  mill.gravity_m_s2 = between(9, 10);
  mill.speed_rad_s = std::exp(between(std::log(0.5), std::log(80)));
  mill.initial_angle_rad = between(-3, 3);
  mill.initial_drum_angle_rad = between(-3, 3);
  mill.drum_radius_m = between(0.05, 0.5);
  mill.drum_length_m = between(0.1, 2);
  mill.drum_mass_kg = between(1, 500);
  const double r_A = mill.drum_radius_m * between(0.5, 1.5), r_O = r_A * between(0.4, 4);
  const double carrier_m = std::max(r_A + r_O, mill.drum_radius_m) * between(1.01, 3);
  if (between(0, 1) < 0.5)
    mill.geometry = kinetics::PlanetaryLengths{carrier_m, r_O, r_A};
  else
    mill.geometry = kinetics::PlanetaryRatios{r_A / (carrier_m + r_A), mill.drum_radius_m / r_A, r_A / r_O};
  mill.charge.bulk_density_kg_m3 = between(500, 8000);
  mill.charge.half_angle_rad = between(0.3, 2.8);
  mill.charge.segment_angle_rad = between(-1, 2.5);
  switch (std::uniform_int_distribution<>(0, 2)(generator)) {
    case 0:
      mill.belt = kinetics::RatioBelt{between(1.1, 5)};
      break;
    case 1:
      mill.belt = kinetics::EytelweinBelt{between(0.1, 1)};
      break;
    default:
      mill.belt = kinetics::PretensionedBelt{between(0, 50e3), between(0.1, 1)};
  }
  return mill;
}

std::vector<std::string> effects_without(const kinetics::PlanetaryMill& mill,
                                         const std::vector<std::string>& without) {
  std::vector<std::string> names;
  for (const auto& info : kinetics::planetary_mill_effects(mill.convention))
    if (std::find(without.begin(), without.end(), info.name) == without.end()) names.push_back(info.name);
  return names;
}

}  // namespace machines

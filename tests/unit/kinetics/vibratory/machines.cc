#include "tests/unit/kinetics/vibratory/machines.h"

#include <algorithm>

namespace machines {

using Eigen::Vector2d;
using kinetics::Spring;
using kinetics::VibratoryMill;

VibratoryMill laboratory() {
  VibratoryMill mill;
  mill.eccentricity_m = 0.004;
  mill.speed_rad_s = 151.844;
  mill.charge_relative_speed_rad_s = -159.4362;
  mill.charge_initial_angle_rad = 1.57;
  mill.charge_offset_m = 0.03;
  mill.charge_mass_kg = 20;
  mill.structure_mass_kg = 30;
  mill.exciter_mass_kg = 6;
  mill.debalance_mass_kg = 4;
  mill.debalance_offset_m = 0.01;
  mill.chamber_centre_m = {0.28, 0.04};
  mill.structure_centre_m = {0.26, 0.02};
  mill.pitch_inertia_kg_m2 = 2.85;
  for (const double x_m : {0.10, 0.46})
    mill.springs.push_back({Vector2d(x_m, -0.18), Vector2d(14000, 27500), Vector2d(30, 60), std::nullopt});
  return mill;
}

VibratoryMill random(std::mt19937& generator) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(generator);
  };
  VibratoryMill mill;
  mill.gravity_m_s2 = between(9, 10);
  mill.eccentricity_m = between(0.001, 0.01);
  mill.speed_rad_s = between(50, 200);
  mill.initial_angle_rad = between(-3, 3);
  mill.charge_relative_speed_rad_s = between(-2, 2) * mill.speed_rad_s;
  mill.charge_initial_angle_rad = between(-3, 3);
  mill.charge_offset_m = between(0, 0.1);
  mill.charge_mass_kg = between(1, 500);
  mill.structure_mass_kg = between(5, 1000);
  mill.exciter_mass_kg = between(1, 100);
  mill.debalance_mass_kg = between(1, 50);
  mill.debalance_offset_m = between(-0.05, 0.05);
  mill.chamber_centre_m = {between(-0.5, 0.5), between(-0.5, 0.5)};
  mill.structure_centre_m = {between(-0.5, 0.5), between(-0.5, 0.5)};
  mill.pitch_inertia_kg_m2 =
      mill.structure_mass_kg * mill.structure_centre_m.squaredNorm() + between(0.1, 20);
  const int n_springs = std::uniform_int_distribution<>(1, 4)(generator);
  for (int i = 0; i < n_springs; ++i) {
    Spring spring;
    spring.position_m = {between(-0.5, 0.5), between(-0.5, 0.5)};
    spring.stiffness_N_m = {between(1e3, 1e5), between(1e3, 1e5)};
    spring.damping_N_s_m = {between(10, 500), between(10, 500)};
    if (n_springs == 1) spring.preload_N = Vector2d(between(-100, 100), between(0, 1000));
    mill.springs.push_back(spring);
  }
  mill.charge_lag.loss_angle_rad = between(0, 0.5);
  return mill;
}

std::vector<std::string> effects_without(const VibratoryMill& mill, const std::vector<std::string>& without) {
  std::vector<std::string> names;
  for (const auto& info : kinetics::vibratory_mill_effects(mill.convention))
    if (std::find(without.begin(), without.end(), info.name) == without.end()) names.push_back(info.name);
  return names;
}

double largest(const Eigen::ArrayXd& values) {
  return values.abs().maxCoeff();
}

}  // namespace machines

#include "kinetics/vibratory_effects/springs.h"

#include <algorithm>
#include <cmath>

#include "kinetics/values/wrong_input.h"
#include "kinetics/vibratory_effects/effect.h"

namespace kinetics::vibratory {
namespace {

/// Vertical weights in effect on the chamber at rest, and their moment about E' (clockwise positive, N m).
struct Weights {
  double force_N = 0, moment_Nm = 0;
  void add(double weight_N, double x_m) { force_N += weight_N, moment_Nm += weight_N * x_m; }
};

Weights weights_on_chamber(const VibratoryMill& mill, const std::vector<std::string>& effects) {
  Weights weights;
  const double g = mill.gravity_m_s2;
  if (contains(effects, "gravity_structure"))
    weights.add(mill.structure_mass_kg * g, mill.structure_centre_m.x());
  if (contains(effects, "gravity_exciter")) weights.add(mill.exciter_mass_kg * g, 0);
  if (contains(effects, "gravity_charge")) weights.add(mill.charge_mass_kg * g, mill.chamber_centre_m.x());
  return weights;
}

/// s + theta z x p: displacement of a spring's foot; with the rates of s and theta, its velocity.
Eigen::Array2Xd at_foot(const Eigen::Array2Xd& s, const Eigen::ArrayXd& theta, const Spring& spring) {
  return s + scaled(theta, constant(turned(spring.position_m), s.cols()));
}

}  // namespace

std::vector<Spring> with_preloads(const VibratoryMill& mill, const std::vector<std::string>& effects) {
  std::vector<Spring> springs = mill.springs;
  const auto given =
      std::count_if(springs.begin(), springs.end(), [](const Spring& s) { return bool(s.preload_N); });
  if (given == std::ptrdiff_t(springs.size())) return springs;
  if (given > 0)
    refuse("springs with preload", double(given),
           "of " + number(double(springs.size())) +
               " springs; give the preload of all of them, or of none: then it is the static balance of the "
               "weights");

  const Weights weights = weights_on_chamber(mill, effects);
  double k = 0, kx = 0, kxx = 0, reach_m = 0;  // sum of ky, ky x, ky x^2
  for (const Spring& spring : springs) {
    const double x_m = spring.position_m.x(), ky_N_m = spring.stiffness_N_m.y();
    k += ky_N_m, kx += ky_N_m * x_m, kxx += ky_N_m * x_m * x_m;
    reach_m = std::max(reach_m, std::abs(x_m));
  }
  if (k <= 0 && weights.force_N != 0)
    refuse("sum of the springs' vertical stiffness", k,
           "cannot carry the weights of " + number(weights.force_N) +
               " N; give vertical stiffness, or give every spring its preload");
  const double rotary = k > 0 ? kxx - kx * kx / k : 0;  // about the springs' own centre
  const double centre_m = k > 0 ? kx / k : 0;
  const double excess_Nm = weights.moment_Nm - weights.force_N * centre_m;
  const bool on_one_vertical = rotary <= 1e-12 * k * reach_m * reach_m;
  if (on_one_vertical && std::abs(excess_Nm) > 1e-9 * std::abs(weights.force_N) * std::max(reach_m, 1e-3))
    refuse("x of the springs' position", centre_m,
           "springs on one vertical cannot balance the weights' moment of " + number(excess_Nm) +
               " N m about it; place the springs apart, or give every spring its preload");
  const double slope = on_one_vertical ? 0 : excess_Nm / rotary;
  for (Spring& spring : springs) {
    const double drop_m = (k > 0 ? weights.force_N / k : 0) + slope * (spring.position_m.x() - centre_m);
    spring.preload_N = Eigen::Vector2d(0, spring.stiffness_N_m.y() * drop_m);
  }
  return springs;
}

double pitch_stiffness_Nm(const std::vector<Spring>& springs) {
  double sum = 0;
  for (const Spring& s : springs) sum += s.stiffness_N_m.dot(turned(s.position_m).cwiseAbs2());
  return sum;
}

double pitch_damping_Nm_s(const std::vector<Spring>& springs) {
  double sum = 0;
  for (const Spring& s : springs) sum += s.damping_N_s_m.dot(turned(s.position_m).cwiseAbs2());
  return sum;
}

Effect springs(const VibratoryMill& mill) {
  return [mill](const Instants& at) {
    std::vector<PlacedForce> forces;
    const Eigen::Array2Xd s_m = translation(mill, at);
    for (std::size_t i = 0; i < mill.springs.size(); ++i) {
      const Spring& spring = mill.springs[i];
      const Eigen::Array2Xd stretched_m = at_foot(s_m, at.theta_rad, spring);
      forces.push_back({Place::spring_foot,
                        i,
                        constant(spring.preload_N.value(), at.size()) -
                            stretched_m.colwise() * spring.stiffness_N_m.array(),
                        {}});
    }
    return forces;
  };
}

Effect published_springs(const VibratoryMill& mill) {
  double stiffness_N_m = 0;
  for (const Spring& spring : mill.springs) stiffness_N_m += spring.stiffness_N_m.y();
  return [mill, stiffness_N_m](const Instants& at) {
    Eigen::Array2Xd force_N = Eigen::Array2Xd::Zero(2, at.size());
    force_N.row(1) = (stiffness_N_m * mill.eccentricity_m * at.phi_rad.sin()).transpose();  // (31)
    return std::vector<PlacedForce>{{Place::pivot, 0, force_N, {}}};
  };
}

Effect spring_damping(const VibratoryMill& mill) {
  return [mill](const Instants& at) {
    std::vector<PlacedForce> forces;
    const Eigen::Array2Xd velocity_m_s = translation_velocity(mill, at);
    for (std::size_t i = 0; i < mill.springs.size(); ++i) {
      const Spring& spring = mill.springs[i];
      const Eigen::Array2Xd foot_m_s = at_foot(velocity_m_s, at.theta_rad_s, spring);
      forces.push_back({Place::spring_foot, i, -(foot_m_s.colwise() * spring.damping_N_s_m.array()), {}});
    }
    return forces;
  };
}

}  // namespace kinetics::vibratory

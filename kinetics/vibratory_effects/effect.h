/// What an effect of the vibratory mill is: a function that fills a block of instants with placed forces.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "kinetics/vibratory_effects/mill.h"
#include "kinetics/vibratory_effects/motion.h"

namespace kinetics::vibratory {

/// Where a force acts. All places but the debalance are on the chamber.
enum class Place { pivot, structure_centre, charge_centre, chamber_centre, spring_foot, debalance };

/// A force at a place, fixed frame; optionally a couple, counter-clockwise positive.
struct PlacedForce {
  Place place = Place::pivot;
  std::size_t foot = 0;      ///< index of the spring where place is spring_foot
  Eigen::Array2Xd force_N;   ///< 2 x n
  Eigen::ArrayXd couple_Nm;  ///< n, or empty: none
};

/// Forces over a block of instants: one entry per place.
using Effect = std::function<std::vector<PlacedForce>(const Instants&)>;

struct NamedEffect {
  std::string name;
  Effect evaluate;
};

/// Position of a place [m], 2 x n: from the pivot E' in the chamber's rest attitude for the chamber's places,
/// from the fixed shaft axis E for the debalance.
Eigen::Array2Xd position(const VibratoryMill& mill, const PlacedForce& force, const Instants& at);

/// The effects of the named list under the mill's convention, in the order of summation.
/// Spring preloads that the mill does not give are the static balance of those weights that are in the list.
/// @param names  checked by check_parameters
std::vector<NamedEffect> make_effects(const VibratoryMill& mill, const std::vector<std::string>& names);

bool contains(const std::vector<std::string>& names, const std::string& name);
bool contains(const std::vector<NamedEffect>& effects, const std::string& name);

// Makers, by family. Each returns one row of the table in kinetics/README.md.

// gravity.cc: (0, -m g) at the centre of each mass
Effect gravity_structure(const VibratoryMill& mill);
Effect gravity_exciter(const VibratoryMill& mill);
Effect gravity_charge(const VibratoryMill& mill);
Effect gravity_debalance(const VibratoryMill& mill);

// inertia.cc: d'Alembert forces of the prescribed translation and of the debalance
Effect structure_inertia(const VibratoryMill& mill);
Effect exciter_inertia(const VibratoryMill& mill);
Effect debalance_inertia(const VibratoryMill& mill);

// charge.cc: d'Alembert forces of the grinding charge
Effect charge_translation(const VibratoryMill& mill);
Effect charge_centripetal(const VibratoryMill& mill);
Effect charge_coriolis(const VibratoryMill& mill);
Effect charge_relative(const VibratoryMill& mill);
Effect charge_lag(const VibratoryMill& mill);
/// eta [rad], given or from the grinding power: sin(eta) = P / (m ecc^2 omega_e^3). Source: ours.
double loss_angle_rad(const VibratoryMill& mill);

// springs.cc
Effect springs(const VibratoryMill& mill);            ///< preload and stiffness; needs every preload set
Effect published_springs(const VibratoryMill& mill);  ///< (31): vertical, whole stiffness, no preload
Effect spring_damping(const VibratoryMill& mill);

// pitch.cc
Effect pitch(const VibratoryMill& mill);
Effect charge_follows_pitch(const VibratoryMill& mill);

}  // namespace kinetics::vibratory

/// What an effect of the planetary mill is: a function that fills a block of instants with one load.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "kinetics/planetary_effects/machine.h"

namespace kinetics::planetary {

/// A block of instants.
struct Instants {
  Eigen::ArrayXd phi_rad;
  Eigen::ArrayXd moment_Nm;  ///< M_A of the effects before this one: what the belt balances

  Eigen::Index size() const { return phi_rad.size(); }
};

/// The drum's surface that receives the load.
enum class Receiver { drum, inner_wall, pulley };

/// A load on the drum: carrier frame, force through A and moment about A.
struct EffectLoad {
  Receiver receiver = Receiver::drum;
  Eigen::Array2Xd force_N;    ///< 2 x n
  Eigen::ArrayXd moment_Nm;   ///< n; of the charge: its share of M_A
  Eigen::Array2Xd on_axle_N;  ///< share of (X_A, -Y_A): force_N, but for the belt under the paper's signs
};

using Effect = std::function<EffectLoad(const Instants&)>;

struct NamedEffect {
  std::string name;
  Effect evaluate;
};

/// The effects of the named list under the mill's convention, in the order of summation; the belt is last.
/// @param names  checked by check_effects
std::vector<NamedEffect> make_effects(const Machine& machine, const std::vector<std::string>& names);

bool contains(const std::vector<std::string>& names, const std::string& name);

/// The same force at every instant, 2 x n.
Eigen::Array2Xd constant_force(double fx_N, double fy_N, Eigen::Index n);
/// Weight of a mass in the carrier frame: -m g (sin phi, cos phi).
Eigen::Array2Xd weight(double mass_kg, const Machine& machine, const Instants& at);

// Makers, by family. Each returns one row of the table in kinetics/README.md.

// drum.cc
Effect drum_transport(const Machine& machine);
Effect drum_gravity(const Machine& machine);

// charge.cc
Effect charge_transport(const Machine& machine);
Effect charge_offset(const Machine& machine);
Effect charge_gravity(const Machine& machine);

// belt.cc
Effect belt(const Machine& machine);

}  // namespace kinetics::planetary

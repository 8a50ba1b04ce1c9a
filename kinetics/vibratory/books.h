/// What the balance collects over the instants, before it becomes quantities.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "kinetics/load_history.h"
#include "kinetics/vibratory/effect.h"

namespace kinetics::vibratory {

/// Forces on one body, summed; the scales are sums of magnitudes.
struct BodySums {
  Eigen::Array2Xd force_N;
  Eigen::ArrayXd force_scale_N, moment_Nm, moment_scale_Nm;  ///< moment about E' (chamber) or E (shaft)

  explicit BodySums(Eigen::Index n);
  /// Adds a force at an arm to the instants from `first` on.
  void add(Eigen::Index first, const Eigen::Array2Xd& arm_m, const Eigen::Array2Xd& force_N);
  void add_couple(Eigen::Index first, const Eigen::ArrayXd& couple_Nm);
};

struct Books {
  explicit Books(Eigen::Index n);

  std::vector<Resultant> resultants;
  BodySums chamber, shaft;
  Instants motion;  ///< of all instants
  Eigen::ArrayXd charge_power_W, damping_power_W, couple_Nm;

  /// Adds a block's load to a role's contribution and total; makes the contribution at its first mention.
  /// @param load  rows fx, fy, torque
  void post(const std::string& role, const std::string& effect, Eigen::Index first,
            const Eigen::Array3Xd& load);
  /// Makes an empty resultant, so that it is there even if no effect loads it.
  void open(const std::string& role, const std::string& description);
};

/// Turns the collected sums into the history's resultants and quantities, with warnings.
void write_results(const VibratoryMill& mill, const std::vector<NamedEffect>& effects, const Books& books,
                   LoadHistory& history);

}  // namespace kinetics::vibratory

/// The belt: strand tensions from their difference, which the charge's moment prescribes.
///
/// T1 is the strand that pulls the drum's pulley clockwise, T1 - T2 = M_A / r_A. Both leave the pulley
/// towards the central one: tangent points r_A (s, -+ cos beta), directions (-cos beta, -+ s), s = sin beta.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "kinetics/planetary_effects/machine.h"

namespace kinetics::planetary {

struct Tensions {
  Eigen::ArrayXd T1_N, T2_N, sum_N;
};

/// @param difference_N  T1 - T2 per instant
Tensions tensions(const Machine& machine, const Eigen::ArrayXd& difference_N);

/// What a belt that swaps or keeps its strands needs to know: T1 + T2 = factor |T1 - T2|, or = factor
/// (T1 - T2) where `follows_sign`; with pretension the sum is `constant_N` instead.
struct TensionSum {
  double factor = 0;
  double constant_N = 0;
  bool follows_sign = false;
};
TensionSum tension_sum(const Machine& machine);

/// Sentences about tensions that no belt can have: negative ones, slip, strands that swap.
std::vector<std::string> belt_warnings(const Machine& machine, const Tensions& tensions);

}  // namespace kinetics::planetary

/// One step of the average-acceleration method, in midpoint form.
///
///   (2 J / dt + D) d + B^T (C theta_n + (C dt / 2 + d_e) (r_n + B d) + modal damping) = M_m - D v_n
///   v_m = v_n + d,  r_m = r_n + B d,  v_(n+1) = v_n + 2 d,  theta_(n+1) = theta_n + dt r_m
///
/// The twist theta of every element and its rate r are states of their own, and a step is solved for the
/// change d of the speeds: so a train that turns for long, or fast, loses nothing of its torques.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "kinetics/torsion/spectrum.h"
#include "kinetics/torsion/tree_solver.h"
#include "kinetics/torsion_chain/dense_algebra.h"
#include "kinetics/torsion_chain/reduced.h"

namespace kinetics::torsion {

struct StepState {
  Eigen::ArrayXd speed;        ///< per node, reduced
  Eigen::ArrayXd angle;        ///< per node, reduced
  Eigen::ArrayXd twist, rate;  ///< per edge
  double work_J = 0, dissipated_J = 0;
};

class Stepper {
public:
  /// @param viscous  per edge: D' and what stands for its loss factor
  Stepper(const ReducedTrain& reduced, const Spectrum& spectrum, double modal_damping_ratio,
          Eigen::ArrayXd viscous, double time_step_s);

  /// @param load  reduced torque per node, mean of both ends of the step
  void advance(const Eigen::ArrayXd& load, StepState& state) const;

  /// Torque of each edge in a state, damping included.
  Eigen::ArrayXd torque(const StepState& state) const;

  /// Sum of the edge torques that leave each node.
  Eigen::ArrayXd leaving(const Eigen::ArrayXd& edge_torque) const;

private:
  struct Midpoint {
    Eigen::ArrayXd speed, rate;
  };
  Midpoint solve(const Eigen::ArrayXd& load) const;
  Eigen::ArrayXd modal(const Eigen::ArrayXd& rate) const;

  const ReducedTrain& reduced_;
  double time_step_s_;
  Eigen::ArrayXd viscous_, node_, edge_;
  std::optional<TreeSolver<double>> tree_;      ///< without modal damping
  Eigen::MatrixXd modal_;                       ///< edge x edge; empty without modal damping
  std::optional<Cholesky> full_, flexibility_;  ///< with it: its edges; T_m from loads
};

}  // namespace kinetics::torsion

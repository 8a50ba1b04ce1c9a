/// Dynamic stiffnesses on a tree: from the leaves to the root and back, O(n), without a matrix.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <utility>
#include <vector>

#include "kinetics/torsion_chain/reduced.h"

namespace kinetics::torsion {

/// Solves node[i] q_i + sum of edge torques leaving i = load[i], edge torque = edge[e] (q_first - q_second).
///
/// A subtree behind an edge Z has the dynamic stiffness G; seen through the edge it is Z G / (Z + G). Stiff
/// edges and light nodes cancel nowhere: this is K - w^2 J without ever adding w^2 J to K. Edge torques come
/// from the loads and the root's angle, never from differences of angles.
template <class Scalar>
class TreeSolver {
public:
  using Array = Eigen::Array<Scalar, Eigen::Dynamic, 1>;

  /// @param root  where the loads are, if they are at one node: then no torque is a difference of large ones,
  /// even where
  ///              a subtree is at a resonance of its own. Any node will do for stiffnesses that are all
  ///              positive.
  TreeSolver(const ReducedTrain& reduced, const Array& node, Array edge, Index root)
      : edge_(std::move(edge)),
        held_(reduced.held.value_or(-1)),
        root_(root),
        steps_(walk(reduced.n_nodes(), reduced.edges, root)),
        seen_(node),
        passed_(edge_.size()) {
    for (auto step = steps_.rbegin(); step != steps_.rend(); ++step) {
      const Scalar Z = edge_[step->edge], G = seen_[step->child];
      const bool wall = step->child == held_;
      passed_[step->edge] = wall ? Scalar(0) : Z / pivot(Z, G);
      seen_[step->parent] += wall ? Z : passed_[step->edge] * G;
    }
  }

  struct Solution {
    Array angle;   ///< per node
    Array torque;  ///< per edge, first to second
  };

  Solution solve(const Array& load) const {
    Array carried = load;
    for (auto step = steps_.rbegin(); step != steps_.rend(); ++step)
      carried[step->parent] += passed_[step->edge] * carried[step->child];
    Solution s{Array::Zero(load.size()), Array::Zero(edge_.size())};
    if (root_ != held_) s.angle[root_] = carried[root_] / seen_[root_];
    for (const Step& step : steps_) {
      const Scalar Z = edge_[step.edge], G = seen_[step.child];
      const Scalar above = s.angle[step.parent], m = carried[step.child];
      const bool wall = step.child == held_;
      s.torque[step.edge] = step.sense * (wall ? Z * above : passed_[step.edge] * (G * above - m));
      s.angle[step.child] = wall ? Scalar(0) : (Z * above + m) / pivot(Z, G);
    }
    return s;
  }

private:
  /// Z + G, moved by the last digit where it vanishes: a subtree that stands still at its own resonance.
  static Scalar pivot(Scalar Z, Scalar G) {
    const Scalar sum = Z + G;
    return sum == Scalar(0) ? Z * std::numeric_limits<double>::epsilon() : sum;
  }

  Array edge_;
  Index held_, root_;  ///< held_: -1 if none is
  std::vector<Step> steps_;
  Array seen_;    ///< G per node, its subtree included
  Array passed_;  ///< Z / (Z + G) per edge
};

}  // namespace kinetics::torsion

/// Dynamic stiffnesses on a tree: from the leaves to the root and back, O(n), without a matrix.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "kinetics/torsion/reduced.h"

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

  /// The root is the held node, or else the one from which no subtree is near a resonance of its own.
  TreeSolver(const ReducedTrain& reduced, Array node, Array edge)
      : node_(std::move(node)), edge_(std::move(edge)), held_(reduced.held.has_value()) {
    root_at(reduced, reduced.held.value_or(0));
    if (held_) return;
    const Index stride = std::max<Index>(1, reduced.n_nodes() / 50);
    Index best = 0;
    double best_pivot = worst_pivot_;
    for (Index root = stride; root < reduced.n_nodes() && best_pivot < 1e-2; root += stride) {
      root_at(reduced, root);
      if (worst_pivot_ > best_pivot) best = root, best_pivot = worst_pivot_;
    }
    if (root_ != best) root_at(reduced, best);
  }

  /// Smallest |Z + G| / (|Z| + |G|): how much the solution may amplify round-off.
  double worst_pivot() const { return worst_pivot_; }

  struct Solution {
    Array angle;   ///< per node
    Array torque;  ///< per edge, first to second
  };

  Solution solve(const Array& load) const {
    Array carried = load;
    for (auto step = steps_.rbegin(); step != steps_.rend(); ++step)
      carried[step->parent] += passed_[step->edge] * carried[step->child];
    Solution s{Array::Zero(load.size()), Array::Zero(edge_.size())};
    if (!held_) s.angle[root_] = carried[root_] / seen_[root_];
    for (const Step& step : steps_) {
      const Scalar Z = edge_[step.edge], G = seen_[step.child];
      const Scalar above = s.angle[step.parent], m = carried[step.child];
      s.torque[step.edge] = step.sense * passed_[step.edge] * (G * above - m);
      s.angle[step.child] = (Z * above + m) / pivot(Z, G);
    }
    return s;
  }

private:
  /// Z + G, moved by the last digit where it vanishes: a subtree that stands still at its own resonance.
  static Scalar pivot(Scalar Z, Scalar G) {
    const Scalar sum = Z + G;
    return sum == Scalar(0) ? Z * std::numeric_limits<double>::epsilon() : sum;
  }

  void root_at(const ReducedTrain& reduced, Index root) {
    root_ = root;
    steps_ = walk(reduced.n_nodes(), reduced.edges, root);
    seen_ = node_;
    passed_.resize(edge_.size());
    worst_pivot_ = 1;
    for (auto step = steps_.rbegin(); step != steps_.rend(); ++step) {
      const Scalar Z = edge_[step->edge], G = seen_[step->child];
      worst_pivot_ = std::min(worst_pivot_, double(std::abs(Z + G) / (std::abs(Z) + std::abs(G))));
      passed_[step->edge] = Z / pivot(Z, G);
      seen_[step->parent] += passed_[step->edge] * G;
    }
  }

  Array node_, edge_;
  bool held_;
  Index root_ = 0;
  std::vector<Step> steps_;
  Array seen_;    ///< G per node, its subtree included
  Array passed_;  ///< Z / (Z + G) per edge
  double worst_pivot_ = 1;
};

}  // namespace kinetics::torsion

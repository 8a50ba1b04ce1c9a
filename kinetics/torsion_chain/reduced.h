/// A train reduced to its reference shaft by kinetic and potential energy, and the walks over its tree.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "kinetics/drive_train.h"

namespace kinetics::torsion {

using Index = Eigen::Index;

/// A connection of two vertices of a tree.
struct Edge {
  Index first = 0, second = 0;
};

/// One step of a walk over a tree, away from its root.
struct Step {
  Index parent = 0, child = 0, edge = 0;
  double sense = 1;  ///< +1 where the parent is the edge's first vertex
};

/// The steps from the root to all other vertices, parents before children.
std::vector<Step> walk(Index n_vertices, const std::vector<Edge>& edges, Index root);

/// Inertias that rigid elements join are one node; elastic elements are its edges. All values reduced:
/// J' = J u^2, D' = D u^2 (3), C' = C u^2 (4)-(6), torque T' = T u (7).
struct ReducedTrain {
  Eigen::ArrayXd ratio;                                 ///< u per inertia
  std::vector<Index> node_of;                           ///< per inertia
  Eigen::ArrayXd inertia;                               ///< J' per node
  Eigen::ArrayXd damping;                               ///< D' per node, to the ground
  std::vector<Edge> edges;                              ///< elastic elements, between nodes
  std::vector<Index> element_of;                        ///< per edge
  Eigen::ArrayXd stiffness, edge_damping, loss_factor;  ///< C', D' per edge
  std::optional<Index> held;                            ///< the node that is held
  Index base = 0;  ///< the held inertia, or the first: where the balance of a rigid element ends

  std::vector<Edge> links;    ///< all elements, between inertias
  Eigen::ArrayXd link_ratio;  ///< u of each element's first inertia

  Index n_nodes() const { return inertia.size(); }
  Index n_edges() const { return stiffness.size(); }
  bool damped() const { return damping.any() || edge_damping.any() || loss_factor.any(); }
};

/// @throws MachineRefused for wrong parameters (see checks.h), a cycle, a train in several pieces,
///         a reference shaft that no inertia sits on, one shaft line with two ratios
ReducedTrain reduce(const DriveTrain& train);

/// Stiffness of an elastic element on the shaft that it refers to [N m/rad].
double stiffness_N_m_rad(const TrainElement& element);

/// Reduced torque of every element, rigid ones included, by the balance of all that lies beyond them.
/// @param edge_torque  reduced torque of the elastic elements, first to second
/// @param load         per inertia: reduced excitation minus inertia and drag torque
template <class Array>
Array element_torques(const ReducedTrain& reduced, const Array& edge_torque, const Array& load) {
  const Index n = static_cast<Index>(reduced.links.size());
  Array torque = Array::Zero(n), beyond = -load;
  std::vector<bool> elastic(reduced.links.size(), false);
  for (Index e = 0; e < reduced.n_edges(); ++e) {
    torque[reduced.element_of[e]] = edge_torque[e];
    elastic[reduced.element_of[e]] = true;
  }
  const auto steps = walk(load.size(), reduced.links, reduced.base);
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
    if (!elastic[step->edge]) torque[step->edge] = step->sense * beyond[step->child];
    beyond[step->parent] += step->sense * torque[step->edge];
  }
  return torque;
}

}  // namespace kinetics::torsion

#include <cmath>

#include "kinetics/drive_train.h"
#include "kinetics/torsion/spectrum.h"
#include "kinetics/torsion_chain/reduced.h"
#include "kinetics/values/machine_refused.h"

namespace kinetics {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using torsion::ReducedTrain;

/// Shares of the nodes, distributed to the inertias of each by J'.
ArrayXd per_inertia(const DriveTrain& train, const ReducedTrain& reduced, const ArrayXd& per_node) {
  ArrayXd values(reduced.ratio.size());
  for (Index i = 0; i < values.size(); ++i) {
    const Index node = reduced.node_of[i];
    const double J = train.inertias[i].inertia_kg_m2 * reduced.ratio[i] * reduced.ratio[i];
    values[i] = per_node[node] * J / reduced.inertia[node];
  }
  return values;
}

/// Unit length, the largest entry positive.
ArrayXd normalised(const ArrayXd& shape) {
  Index largest = 0;
  shape.abs().maxCoeff(&largest);
  return shape / (shape[largest] < 0 ? -1 : 1) / shape.matrix().stableNorm();
}

}  // namespace

NaturalModes natural_modes(const DriveTrain& train, Shapes shapes) {
  const ReducedTrain reduced = torsion::reduce(train);
  const auto spectrum = torsion::spectrum(reduced, shapes == Shapes::all);
  const Index rigid = reduced.held ? 0 : 1, n_modes = reduced.n_edges() + rigid;
  NaturalModes modes;
  modes.frequency_rad_s = ArrayXd::Zero(n_modes);
  modes.frequency_rad_s.tail(reduced.n_edges()) = spectrum.frequency_rad_s;
  if (shapes == Shapes::none) return modes;

  const Index n = reduced.ratio.size();
  modes.reduced_shape = modes.kinetic_share = Eigen::ArrayXXd::Zero(n, n_modes);
  modes.potential_share = Eigen::ArrayXXd::Zero(static_cast<Index>(train.elements.size()), n_modes);
  if (rigid) {
    modes.reduced_shape.col(0) = 1 / std::sqrt(double(n));
    modes.kinetic_share.col(0) = per_inertia(train, reduced, reduced.inertia / reduced.inertia.sum());
  }
  for (Index k = 0; k < reduced.n_edges(); ++k) {
    const ArrayXd vector = spectrum.node_vectors.col(k).array();
    ArrayXd shape(n);
    for (Index i = 0; i < n; ++i) {
      const Index node = reduced.node_of[i];
      shape[i] = reduced.held == node ? 0 : vector[node] / std::sqrt(reduced.inertia[node]);
    }
    modes.reduced_shape.col(k + rigid) = normalised(shape);
    modes.kinetic_share.col(k + rigid) = per_inertia(train, reduced, vector.square());
    for (Index e = 0; e < reduced.n_edges(); ++e)
      modes.potential_share(reduced.element_of[e], k + rigid) = std::pow(spectrum.edge_vectors(e, k), 2);
  }
  modes.shape = modes.reduced_shape.colwise() * reduced.ratio;
  return modes;
}

double mean_speed_rad_s(const DriveTrain& train, const std::string& inertia) {
  const auto reduced = torsion::reduce(train);
  for (std::size_t i = 0; i < train.inertias.size(); ++i)
    if (train.inertias[i].name == inertia)
      return train.reference_speed_rad_s * reduced.ratio[Eigen::Index(i)];
  throw MachineRefused("the train has no inertia \"" + inertia + "\"");
}

}  // namespace kinetics

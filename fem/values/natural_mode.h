/// Natural vibrations of a body. Plain values, no deal.II.
#pragma once

#include <vector>

namespace fem {

/// One undamped free vibration of a body at rest.
struct NaturalMode {
  double frequency_Hz = 0;
  /// n_nodes x 3, nodes as in body_nodes() and UnitResponses::nodes; of modal mass 1, so in kg^(-1/2). The
  /// largest entry is positive. A repeated frequency's shapes are any orthogonal ones of theirs.
  std::vector<double> shape;
  double residual = 0;  ///< |K x - w^2 M x| / |w^2 M x|
};

}  // namespace fem

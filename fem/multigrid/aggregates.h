/// Groups of neighbouring nodes that multigrid moves as rigid bodies. Internal to fem.
///
/// Source: P. Vanek, J. Mandel, M. Brezina, Algebraic multigrid by smoothed aggregation for second and fourth
/// order elliptic problems, Computing 56 (1996) 179-196: the three passes of the aggregation, the prolongator
/// smoothed by one step of damped Jacobi.
#pragma once

#include <cstdint>
#include <vector>

#include "fem/matrices/block_matrix.h"

namespace fem {

struct Aggregates {
  std::size_t n = 0;
  std::vector<std::int32_t> of_node;
};

/// Every node in one aggregate: a node with its strong neighbours, or what such groups have left over.
/// Neighbours i, j are strong if |K_ij|^2 > threshold^2 |K_ii| |K_jj| (Frobenius): in stretched cells those
/// across the short sides.
/// @param stiffness  3 x 3 blocks
/// @param siblings   so many nodes after each other stay together and count as one
Aggregates aggregate_nodes(const BlockMatrix<double>& stiffness, int siblings, double threshold);

/// The six rigid motions of nodes at these places, about their mean, rotations by displacements of size 1 at
/// the farthest node: a 3 x 6 block per node.
std::vector<double> rigid_motions(const std::vector<double>& xyz_m);

/// What an aggregate can do: motions as a combination of six displacements that are orthogonal and of size 1.
struct AggregateMotions {
  std::vector<double> basis;   ///< 3 x 6 per node; zero columns for what the nodes do not tell apart (of a
                               ///< node, of nodes on a line)
  std::vector<double> motion;  ///< 6 x 6 per aggregate, two blocks of 3 x 6: the motions in that basis
  std::vector<int> rank;       ///< per aggregate, of 6
};
/// @param motions  3 x 6 per node
AggregateMotions span_motions(const Aggregates& aggregates, const std::vector<double>& motions);

}  // namespace fem

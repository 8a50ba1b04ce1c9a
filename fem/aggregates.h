/// Groups of neighbouring nodes that multigrid moves as rigid bodies. Internal to fem.
///
/// Source: P. Vanek, J. Mandel, M. Brezina, Algebraic multigrid by smoothed aggregation for second and fourth
/// order elliptic problems, Computing 56 (1996) 179-196: the three passes of the aggregation, the prolongator
/// smoothed by one step of damped Jacobi.
#pragma once

#include <cstdint>
#include <vector>

#include "fem/block_matrix.h"

namespace fem {

struct Aggregates {
  std::size_t n = 0;
  std::vector<std::int32_t> of_node;
};

/// Every node in one aggregate: a node with its strong neighbours, or what such groups have left over.
/// Neighbours i, j are strong if |K_ij|^2 > threshold^2 |K_ii| |K_jj| (Frobenius): in stretched cells those
/// across the short sides.
Aggregates aggregate_nodes(const BlockMatrix<double>& stiffness, double threshold);

/// Six displacements per aggregate that span its rigid motions: a 3 x 6 block per node, of unit size over the
/// aggregate and orthogonal to each other. Motions that its nodes do not tell apart (of a node, of nodes on a
/// line) are left out: their columns are zero.
/// @param xyz_m  3 per node
/// @param rank   of each aggregate on return, 3 to 6
std::vector<double> rigid_motions(const Aggregates& aggregates, const std::vector<double>& xyz_m,
                                  std::vector<int>& rank);

}  // namespace fem

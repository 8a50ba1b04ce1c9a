/// Lagrange polynomials on [0, 1] at the nodes of a cell's edge. Internal to fem.
#pragma once

#include <vector>

namespace fem {

/// Where a cell of the degree (1 to 3) has its nodes along an edge: Gauss-Lobatto points.
std::vector<double> nodes_on_edge(int degree);

struct LagrangeAt {
  double value = 0, derivative = 0;
};

/// The polynomial of each node, at one point.
std::vector<LagrangeAt> lagrange(const std::vector<double>& nodes, double at);

}  // namespace fem

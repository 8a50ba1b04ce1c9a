#include "fem/common/lagrange.h"

#include <cmath>

namespace fem {

std::vector<double> nodes_on_edge(int degree) {
  if (degree == 1) return {0, 1};
  if (degree == 2) return {0, 0.5, 1};
  const double inner = 0.5 - 0.5 / std::sqrt(5.0);
  return {0, inner, 1 - inner, 1};
}

std::vector<LagrangeAt> lagrange(const std::vector<double>& nodes, double at) {
  std::vector<LagrangeAt> result(nodes.size());
  for (std::size_t j = 0; j < nodes.size(); ++j) {
    LagrangeAt& polynomial = result[j];
    polynomial.value = 1;
    for (std::size_t left_out = 0; left_out < nodes.size(); ++left_out) {
      if (left_out == j) continue;
      polynomial.value *= (at - nodes[left_out]) / (nodes[j] - nodes[left_out]);
      double product = 1 / (nodes[j] - nodes[left_out]);
      for (std::size_t m = 0; m < nodes.size(); ++m)
        if (m != j && m != left_out) product *= (at - nodes[m]) / (nodes[j] - nodes[m]);
      polynomial.derivative += product;
    }
  }
  return result;
}

}  // namespace fem

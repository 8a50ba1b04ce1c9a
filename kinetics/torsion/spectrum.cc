#include "kinetics/torsion/spectrum.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "kinetics/torsion_chain/bidiagonal.h"
#include "kinetics/torsion_chain/dense_algebra.h"
#include "kinetics/torsion_chain/jacobi.h"

namespace kinetics::torsion {
namespace {

/// 1 / sqrt(J'), zero for the held node: an infinite inertia.
Eigen::ArrayXd inverse_root_inertia(const ReducedTrain& reduced) {
  Eigen::ArrayXd w = reduced.inertia.sqrt().inverse();
  if (reduced.held) w[*reduced.held] = 0;
  return w;
}

/// The walk along the train if it is a chain.
std::optional<std::vector<Step>> along_chain(const ReducedTrain& reduced) {
  std::vector<int> degree(reduced.n_nodes(), 0);
  for (const Edge& edge : reduced.edges) ++degree[edge.first], ++degree[edge.second];
  if (std::any_of(degree.begin(), degree.end(), [](int d) { return d > 2; })) return std::nullopt;
  const Index end = std::find_if(degree.begin(), degree.end(), [](int d) { return d < 2; }) - degree.begin();
  return walk(reduced.n_nodes(), reduced.edges, end);
}

Spectrum of_chain(const ReducedTrain& reduced, const std::vector<Step>& steps, bool with_vectors) {
  const Index m = reduced.n_edges();
  const Eigen::ArrayXd w = inverse_root_inertia(reduced);
  ChainMatrix matrix{Eigen::VectorXd(m), Eigen::VectorXd(m)};
  for (Index k = 0; k < m; ++k) {
    const double root_C = std::sqrt(reduced.stiffness[steps[k].edge]);
    matrix.diagonal[k] = root_C * w[steps[k].parent];
    matrix.beside[k] = -root_C * w[steps[k].child];
  }
  const SingularValues values = singular_values(matrix, with_vectors);
  Spectrum result{values.value.reverse(), {}, {}};
  if (!with_vectors) return result;
  result.node_vectors.resize(m + 1, m);
  result.edge_vectors.resize(m, m);
  if (m > 0) result.node_vectors.row(steps[0].parent) = values.right.row(0).reverse();
  for (Index k = 0; k < m; ++k) {
    result.node_vectors.row(steps[k].child) = values.right.row(k + 1).reverse();
    result.edge_vectors.row(steps[k].edge) = steps[k].sense * values.left.row(k).reverse();
  }
  return result;
}

Spectrum of_tree(const ReducedTrain& reduced, bool with_vectors) {
  const Index m = reduced.n_edges();
  const Eigen::ArrayXd w = inverse_root_inertia(reduced);
  Eigen::MatrixXd transposed = Eigen::MatrixXd::Zero(m + 1, m);
  for (Index e = 0; e < m; ++e) {
    const double root_C = std::sqrt(reduced.stiffness[e]);
    transposed(reduced.edges[e].first, e) = root_C * w[reduced.edges[e].first];
    transposed(reduced.edges[e].second, e) = -root_C * w[reduced.edges[e].second];
  }
  const auto values = jacobi_singular_values(std::move(transposed), with_vectors);
  Spectrum result{values.value.reverse(), {}, {}};
  if (!with_vectors) return result;
  result.node_vectors = values.left.rowwise().reverse();
  result.edge_vectors = values.right.rowwise().reverse();
  return result;
}

}  // namespace

Spectrum spectrum(const ReducedTrain& reduced, bool with_vectors) {
  const auto chain = along_chain(reduced);
  return chain ? of_chain(reduced, *chain, with_vectors) : of_tree(reduced, with_vectors);
}

double mode_damping(const ReducedTrain& reduced, const Spectrum& spectrum, Index mode) {
  const double w = spectrum.frequency_rad_s[mode];
  const auto together = [&](Index k) { return std::abs(spectrum.frequency_rad_s[k] / w - 1) <= 1e-9; };
  Index first = mode, last = mode;
  while (first > 0 && together(first - 1)) --first;
  while (last + 1 < reduced.n_edges() && together(last + 1)) ++last;
  Eigen::ArrayXd drag = reduced.damping / reduced.inertia;
  if (reduced.held) drag[*reduced.held] = 0;
  const Eigen::ArrayXd loss = reduced.loss_factor + reduced.edge_damping * w / reduced.stiffness;
  const auto node = spectrum.node_vectors.middleCols(first, last - first + 1);
  const auto edge = spectrum.edge_vectors.middleCols(first, last - first + 1);
  return smallest_eigenvalue(weighted_gram(node, drag / (2 * w)) + weighted_gram(edge, loss / 2));
}

}  // namespace kinetics::torsion

#include "pipelines/write/living/time_basis.h"

#include <algorithm>
#include <cmath>

namespace pipelines {
namespace {

using Eigen::Index;

/// All series that are not zero, each over the largest size of its signal.
struct ScaledRows {
  Eigen::MatrixXd rows;
  std::vector<std::pair<std::size_t, Index>> places;  ///< set and signal of each
};

ScaledRows scaled_rows(const std::vector<Eigen::ArrayXXd>& sets, const Eigen::ArrayXd& sizes) {
  ScaledRows scaled;
  for (std::size_t s = 0; s < sets.size(); ++s)
    for (Index j = 0; j < sets[s].rows(); ++j)
      if ((sets[s].row(j) != 0).any()) scaled.places.emplace_back(s, j);
  scaled.rows.resize(Index(scaled.places.size()), sets.front().cols());
  for (Index i = 0; i < scaled.rows.rows(); ++i) {
    const auto& [set, signal] = scaled.places[std::size_t(i)];
    scaled.rows.row(i) = sets[set].row(signal) / sizes[signal];
  }
  return scaled;
}

}  // namespace

TimeBasis time_basis(const std::vector<Eigen::ArrayXXd>& sets) {
  constexpr double tolerance = 1e-6;
  const auto n_signals = sets.front().rows(), n = sets.front().cols();
  Eigen::ArrayXd sizes = Eigen::ArrayXd::Zero(n_signals);
  for (const auto& set : sets) sizes = sizes.max(set.abs().rowwise().maxCoeff());
  auto [rest, places] = scaled_rows(sets, sizes);
  const double enough = tolerance * std::sqrt(double(n));
  std::vector<Eigen::RowVectorXd> basis;
  std::vector<Eigen::VectorXd> coefficients;
  while (rest.rows() > 0 && Index(basis.size()) < n) {
    Index largest = 0;
    const double norm = rest.rowwise().norm().maxCoeff(&largest);
    if (norm <= enough) break;
    const Eigen::RowVectorXd direction = rest.row(largest) / norm;
    const Eigen::VectorXd along = rest * direction.transpose();
    rest.noalias() -= along * direction;
    basis.push_back(direction);
    coefficients.push_back(along);
  }
  TimeBasis result;
  const auto rank = Index(basis.size());
  result.basis.resize(rank, n);
  result.tables.assign(sets.size(), Eigen::MatrixXd::Zero(n_signals, rank));
  for (Index k = 0; k < rank; ++k) {
    result.basis.row(k) = basis[std::size_t(k)];
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto& [set, signal] = places[i];
      result.tables[set](signal, k) = coefficients[std::size_t(k)][Index(i)] * sizes[signal];
    }
  }
  return result;
}

}  // namespace pipelines

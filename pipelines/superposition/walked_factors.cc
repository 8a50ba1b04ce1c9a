#include "pipelines/superposition/walked_factors.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace pipelines {
namespace {

/// Residuals of a channel, relative to itself, that count as rounding.
constexpr double dependent = 1e-14;

/// More than the rounding of a sum over the channels, relative to their largest values.
constexpr double rounding_of_sums = 1e-13;

}  // namespace

IndependentChannels independent_channels(const Eigen::ArrayXXd& values) {
  const Eigen::Index n = values.rows(), most = std::min(n, values.cols());
  IndependentChannels result;
  if (!values.allFinite()) {  // nothing follows from what is no number
    result.of_channel.setIdentity(n, n);
    for (Eigen::Index k = 0; k < n; ++k) result.channels.push_back(k);
    return result;
  }
  const Eigen::ArrayXd sizes = values.matrix().rowwise().norm();
  const Eigen::ArrayXd scale = (sizes > 0).select(sizes.inverse(), 0.0);
  const Eigen::MatrixXd instants = (values.colwise() * scale).matrix().transpose();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(instants);
  const auto& order = qr.colsPermutation().indices();
  Eigen::Index rank = 0;
  while (rank < most && std::abs(qr.matrixQR()(rank, rank)) > dependent) ++rank;
  result.of_channel = Eigen::MatrixXd::Zero(n, rank);
  const Eigen::MatrixXd rest = qr.matrixQR()
                                   .topLeftCorner(rank, rank)
                                   .triangularView<Eigen::Upper>()
                                   .solve(qr.matrixQR().topRightCorner(rank, n - rank));
  for (Eigen::Index i = 0; i < rank; ++i) {
    result.channels.push_back(order[i]);
    result.of_channel(order[i], i) = 1;
    for (Eigen::Index k = 0; k < n - rank; ++k)
      if (sizes[order[rank + k]] > 0)
        result.of_channel(order[rank + k], i) = rest(i, k) * sizes[order[rank + k]] / sizes[order[i]];
  }
  for (Eigen::Index k = rank; k < n; ++k)
    if (sizes[order[k]] > 0) result.others.push_back(order[k]);
  return result;
}

WalkedFactors::WalkedFactors(const Eigen::ArrayXXd& values) : independent_(independent_channels(values)) {
  using kernel::block, kernel::blocks_at_once;
  const std::size_t n_walked = n_channels(), n_given = std::size_t(values.cols());
  n_blocks_ = (n_given + block - 1) / block;
  n_bounds_ = (n_blocks_ + blocks_at_once - 1) / blocks_at_once * blocks_at_once;
  values_.resize(n_blocks_ * n_walked * block);
  bounds_.assign(n_walked * n_bounds_ * 2, 0.0);
  for (std::size_t k = 0; k < n_walked; ++k) {
    const Eigen::ArrayXd row = values.row(independent_.channels[k]);
    const double largest = row.abs().maxCoeff();
    for (std::size_t b = 0; b < n_blocks_; ++b) {
      double* of_block = &values_[(b * n_walked + k) * block];
      for (std::size_t i = 0; i < block; ++i)
        of_block[i] = row[Eigen::Index(std::min(b * block + i, n_given - 1))];
      bound(k, b, largest);
    }
  }
}

void WalkedFactors::bound(std::size_t channel, std::size_t b, double largest) {
  using kernel::block, kernel::blocks_at_once;
  const double* of_block = &values_[(b * n_channels() + channel) * block];
  const auto [low, high] = std::minmax_element(of_block, of_block + block);
  double* bounds =
      &bounds_[(channel * n_bounds_ + b / blocks_at_once * blocks_at_once) * 2 + b % blocks_at_once];
  bounds[0] = 0.5 * (*low + *high);
  bounds[blocks_at_once] = 0.5 * (*high - *low) + rounding_of_sums * largest;
}

kernel::Factors WalkedFactors::for_kernel() const {
  return {n_channels(), n_blocks_, n_bounds_, values_.data(), bounds_.data()};
}

void WalkedFactors::gather(const double* of_channel, std::size_t width, double* walked) const {
  for (std::size_t i = 0; i < n_channels(); ++i, walked += width) {
    const double* own = of_channel + std::size_t(independent_.channels[i]) * width;
    for (std::size_t c = 0; c < width; ++c) walked[c] = own[c];
    for (const auto k : independent_.others) {
      const double share = independent_.of_channel(k, Eigen::Index(i));
      for (std::size_t c = 0; c < width; ++c) walked[c] += share * of_channel[std::size_t(k) * width + c];
    }
  }
}

}  // namespace pipelines

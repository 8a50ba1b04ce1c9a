#include "pipelines/superpose/kernels/walked_factors.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace pipelines {
namespace {

/// Residuals of a channel, relative to itself, that count as rounding.
constexpr double dependent = 1e-14;

/// More than the rounding of a sum over the channels, relative to their largest values.
constexpr double rounding_of_sums = 1e-13;

/// Number of blocks below which knots save nothing.
constexpr std::size_t fewest_blocks_for_knots = 3;

/// Deviations from straight lines between the knots, relative to the channels' sizes: with so many on the
/// average, times the root of the number of channels, all instants are walked as fast. Deviations add up,
/// stresses as their squares. Measured on channels cos(w i (1 + k) + k), whose w was raised until the knots
/// cost as much as they save: 1.5 with 12 channels, 2.3 with 31.
constexpr double roughest = 1.5;

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
  const Eigen::ArrayXXd walked = values(independent_.channels, Eigen::all);
  const bool is_steady = walked.cols() > 0 && (walked == walked.col(0).replicate(1, walked.cols())).all();
  n_given_ = is_steady ? 1 : std::size_t(values.cols());
  n_blocks_ = (n_given_ + block - 1) / block;
  n_bounds_ = (n_blocks_ + blocks_at_once - 1) / blocks_at_once * blocks_at_once;
  values_.resize(n_blocks_ * n_channels() * block);
  bounds_.assign(n_channels() * n_bounds_ * 2, 0.0);
  for (std::size_t k = 0; k < n_channels(); ++k) {
    const Eigen::ArrayXd row = walked.row(Eigen::Index(k));
    sizes_.push_back(row.abs().maxCoeff());
    for (std::size_t b = 0; b < n_blocks_; ++b) {
      double* of_block = &values_[(b * n_channels() + k) * block];
      for (std::size_t i = 0; i < block; ++i)
        of_block[i] = row[Eigen::Index(std::min(b * block + i, n_given_ - 1))];
      bound(k, b, sizes_.back());
    }
  }
  find_knots();
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

double WalkedFactors::value(std::size_t channel, std::size_t instant) const {
  return values_[(instant / kernel::block * n_channels() + channel) * kernel::block +
                 instant % kernel::block];
}

void WalkedFactors::find_deviations(std::size_t channel) {
  using kernel::span;
  double* of_knots = &deviations_[channel * knots_.n_deviations];
  const double rounding = rounding_of_sums * sizes_[channel];
  for (std::size_t begin = 0; begin < n_given_; begin += span) {
    const std::size_t end = std::min(begin + span, n_given_ - 1);
    const double first = value(channel, begin), change = value(channel, end) - first;
    double deviation = 0;
    for (std::size_t i = begin + 1; i < end; ++i) {
      const double t = double(i - begin) / double(end - begin);
      deviation = std::max(deviation, std::abs(value(channel, i) - first - t * change) / (4 * t * (1 - t)));
    }
    for (const std::size_t knot : {begin / span, begin / span + 1}) {
      double& of_knot = of_knots[knot / kernel::knots_at_once];
      of_knot = std::max(of_knot, deviation + rounding);
    }
  }
  of_knots[knots_.n_deviations - 1] = rounding;
}

void WalkedFactors::find_knots() {
  using kernel::block, kernel::knots_at_once, kernel::span;
  if (n_blocks_ < fewest_blocks_for_knots || n_channels() == 0) return;
  const std::size_t n_spans = (n_given_ + span - 1) / span, n_groups = n_spans / knots_at_once + 1;
  knots_ = {n_spans, n_given_ - 1, n_spans / block + 1, (n_groups / knots_at_once + 1) * knots_at_once,
            nullptr, nullptr};
  knot_values_.resize(knots_.n_blocks * n_channels() * block);
  deviations_.assign(n_channels() * knots_.n_deviations, 0.0);
  double roughness = 0;
  for (std::size_t k = 0; k < n_channels(); ++k) {
    for (std::size_t i = 0; i < knots_.n_blocks * block; ++i)
      knot_values_[(i / block * n_channels() + k) * block + i % block] =
          value(k, std::min(i * span, knots_.last));
    find_deviations(k);
    for (std::size_t d = 0; d < n_groups; ++d)
      roughness += deviations_[k * knots_.n_deviations + d] / sizes_[k];
  }
  roughness /= std::sqrt(double(n_channels())) * double(n_groups);
  if (!(roughness <= roughest)) knots_ = {};
}

kernel::Factors WalkedFactors::for_kernel() const {
  auto knots = knots_;
  knots.values = knot_values_.data();
  knots.deviations = deviations_.data();
  return {n_channels(), n_blocks_, n_bounds_, values_.data(), bounds_.data(), knots};
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

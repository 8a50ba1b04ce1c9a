/// Time factors as the walks through the instants take them, of the channels that are independent.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "pipelines/superpose/kernels/superposition_kernel.h"

namespace pipelines {

/// Channels of which all others are sums: a spring's force follows from another's, a part of a seat's
/// pressure is not there. Found by a rank-revealing QR factorisation with pivoting (Golub and Van Loan,
/// Matrix Computations, 4th ed., 5.4.2); each channel counts by its own size.
struct IndependentChannels {
  std::vector<Eigen::Index> channels;
  std::vector<Eigen::Index> others;  ///< channels that are sums of these, but not zero
  Eigen::MatrixXd of_channel;  ///< K x independent: values = of_channel * values of the independent, to 1e-14
};
/// @param values  K x instants
IndependentChannels independent_channels(const Eigen::ArrayXXd& values);

class WalkedFactors {
public:
  WalkedFactors() = default;
  /// @param values  K x instants
  explicit WalkedFactors(const Eigen::ArrayXXd& values);

  std::size_t n_channels() const { return independent_.channels.size(); }
  kernel::Factors for_kernel() const;

  /// What a quantity that is linear in the channels makes of the independent ones.
  /// @param of_channel  K rows of `width` numbers
  /// @param walked      n_channels() rows of `width` numbers, to be written
  void gather(const double* of_channel, std::size_t width, double* walked) const;

  /// The same of one number per channel.
  /// @param of_channel  number of a channel, by the channel's row
  /// @param walked      n_channels() numbers, each `stride` after the one before, to be written
  template <typename OfChannel>
  void gather_numbers(const OfChannel& of_channel, double* walked, std::size_t stride) const {
    for (std::size_t i = 0; i < n_channels(); ++i) walked[i * stride] = of_channel(independent_.channels[i]);
    for (const auto k : independent_.others) {
      const double other = of_channel(k);
      for (std::size_t i = 0; i < n_channels(); ++i)
        walked[i * stride] += independent_.of_channel(k, Eigen::Index(i)) * other;
    }
  }

private:
  void bound(std::size_t channel, std::size_t b, double largest);
  void find_knots();
  void find_deviations(std::size_t channel);
  double value(std::size_t channel, std::size_t instant) const;

  IndependentChannels independent_;
  std::size_t n_given_ = 0;  ///< instants that are walked: one of a steady history
  std::size_t n_blocks_ = 0, n_bounds_ = 0;
  std::vector<double> values_, bounds_, sizes_;  ///< as kernel::Factors; largest of each channel
  kernel::Knots knots_;                          ///< its sizes
  std::vector<double> knot_values_, deviations_;
};

}  // namespace pipelines

/// Spectra of time factors over one cycle: whether the instants resolve them, and how many would.
///
/// Series over one period at n equidistant instants, a row each. With complex lines c_h,
///   y(i) = Re sum_h c_h exp(2 pi j h i / n),  h = 0 .. n / 2,
/// and the same at i between the instants is the trigonometric polynomial through them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "pipelines/loads/channels/channels.h"

namespace pipelines {

/// Instants of which the largest prime factor is above this are not transformed: it would take its square.
inline constexpr Eigen::Index largest_transformed_prime = 4096;

/// Lines of several series that belong together, such as the components of one stress.
struct FactorSpectrum {
  Eigen::Index n_instants = 0;
  Eigen::ArrayXXcd lines;  ///< rows x (highest line above rounding + 1)
  /// Sum of the sizes of the lines from a third of n_instants on: what stands so high tells that there is
  /// more above; 0 where the instants resolve the series.
  double upper_third = 0;
  bool is_decaying = true;  ///< the upper third of the spectrum is not more than the third below it

  bool is_resolved() const { return upper_third == 0; }
  /// Bound of what the trigonometric polynomial is wrong by between the instants, in the rows' 2-norm: twice
  /// the sum of the lines above n / 2, each of which is missing and falls on a lower one. Of series no
  /// rougher than ones with kinks lines fall as 1 / h^2; their sum from n / 2 on is then twice that over the
  /// upper third, of which aliases hide up to a half. Jumps have no such bound.
  double unresolved() const { return 8 * upper_third; }
};

/// The size of a line: the largest 2-norm over the rows that it may have at any instant.
double line_size(const FactorSpectrum& spectrum, Eigen::Index order);

/// @param values    rows x n over one period
/// @param rounding  lines up to this size are none
/// @throws std::invalid_argument if n is 0 or can_be_transformed(n) is false
FactorSpectrum factor_spectrum(const Eigen::ArrayXXd& values, double rounding);
bool can_be_transformed(Eigen::Index n_instants);

/// The number of instants over the cycle by which no crest is missed by more than `most`: the sum over the
/// lines of what a crest between two instants can lose of each, size (pi h / n)^2 / 2, plus what so many
/// instants leave unresolved.
/// Source: Taylor's theorem about a crest, where the derivative is 0.
double instants_for(const FactorSpectrum& spectrum, double most);

/// Number of instants that are needed, and the channel that needs them.
struct InstantsNeeded {
  double n_instants = 1;     ///< over the whole history
  std::string channel;       ///< channel that asks for them; empty: none changes
  bool is_resolved = true;   ///< as far as its spectrum tells
  Eigen::Index highest = 0;  ///< its highest order over the history that is not rounding
};

/// The number of instants over the cycle from which on every channel is known between them to a share of the
/// largest channel of its unit.
/// @param share  > 0
InstantsNeeded instants_needed(const ChannelHistory& loads, double share);

}  // namespace pipelines

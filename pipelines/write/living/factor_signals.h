/// What the factors of a body's channels follow from. Most of them are linear in the loads. Harmonics of a
/// seat's pressure are not: they turn with the force that presses there,
///
///   a_k = f_k |F| cos(n arg F)  or  f_k |F| sin(n arg F),
///
/// so that a sum over effects has to be taken of F, before.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "pipelines/loads/channels/load_collector.h"

namespace pipelines {

/// The law of one harmonic.
struct PressureLaw {
  Eigen::Index channel = 0;
  Eigen::Index force = 0;  ///< signal of F_x; F_y is the next one
  int harmonic = 0;
  bool is_sine = false;
  double factor = 1;  ///< f_k
};

struct FactorSignals {
  std::vector<Eigen::Index> channels;  ///< of the first signals; forces that press follow, two of each
  std::vector<std::string> forces;     ///< their ports
  std::vector<PressureLaw> laws;
  Eigen::Index n_channels = 0;

  Eigen::Index size() const { return Eigen::Index(channels.size() + 2 * forces.size()); }

  /// The channels' factors, K x n.
  /// @param signals  size() x n
  Eigen::ArrayXXd factors(const Eigen::ArrayXXd& signals) const;
};

/// A harmonic that does not meet its law to a millionth of its size counts as linear.
FactorSignals factor_signals(const BodyLoads& loads);

/// Signals of loads that need not have all channels: what a channel has not is zero. size() x n.
/// @param of     the loads that `signals` are of
/// @param loads  the same body under others
/// @param trouble  takes why the channels' factors cannot be made of them: a channel that is not there, or
///                 another law
Eigen::ArrayXXd signals_of(const FactorSignals& signals, const BodyLoads& of, const BodyLoads& loads,
                           std::string& trouble);

}  // namespace pipelines

/// What brings the damage of a place: shares of the effects, or of the channels.
///
/// D is Palmgren and Miner's sum over counted cycles, D = sum n_i / N(A_i). With a factor s_e on all loads of
/// effect e,
///   share_e = (dD/ds_e) / sum_f (dD/ds_f),   dD/ds_e = sum k_i (n_i / N_i) d ln(A_i) / ds_e,
/// k_i the slope of the branch of the S-N curve that A_i is on. Shares sum to one; a negative one relieves.
/// With the effect times 1 - h the damage falls by h times k times the share, to first order, where one slope
/// counts.
///
/// A_i is a function of the stresses at the two ends of its cycle, which are linear in the effects: its range
/// along the direction of counting, at unwelded places with the mean and its sensitivity. Ends are turning
/// points: by their moving the range does not change to first order, but the mean does. What the effects do
/// to the support by the stress gradient, at instants that move likewise, is in the shares. The direction of
/// counting is held: turning it changes the damage in second order only (stationary_direction). Where other
/// turning points pair up damage jumps, and has no derivative by the effects.
///
/// Where nothing damages, the shares are those of the damage that begins when all loads are raised together:
/// every cycle by the slope above the knee.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "pipelines/judge/analysis/weld_places.h"
#include "pipelines/judge/life/fatigue_places.h"

namespace pipelines {

/// d ln(A) of one cycle by the stresses at its ends [1/Pa], and by the moving of its ends.
struct AmplitudeSlopes {
  Eigen::Matrix<double, 6, 1> by_from, by_to;
  /// Slope by the mean stress: what the moving of the ends changes.
  Eigen::Matrix<double, 6, 1> by_mean = Eigen::Matrix<double, 6, 1>::Zero();
};

/// A is the range of a form that is linear in the stress.
AmplitudeSlopes slopes_of_range(const EndsOfCycle& cycle, const Eigen::Matrix<double, 6, 1>& form);
/// A is FKM's equivalent reversed amplitude (FatigueRules::counted).
AmplitudeSlopes slopes_of_equivalent(const EndsOfCycle& cycle, const Eigen::Matrix<double, 6, 1>& form,
                                     double mean_stress_sensitivity);

/// k n / N: by how much the damage of a block grows with the logarithm of its amplitude.
double damage_slope(const SnCurve& curve, const StressBlock& block);

/// dD/ds of the parts of one history at one place of the body. It is linear in their stresses at the ends of
/// cycles: weights of these over time are gathered, and parts are looked at once.
class DamageDerivative {
public:
  /// @param course  course of the loads; null: ends of cycles are at instants
  /// All outlive this.
  DamageDerivative(const UnitStresses& unit_Pa, const ChannelHistory& loads, const FactorCourse* course);

  /// @param weight  k n / N of the cycle, with a sign
  /// @param moving  form whose turning points the ends are, where they lie on a smooth course; null: ends
  ///                stay where they are
  void add(const EndsOfCycle& cycle, const AmplitudeSlopes& slopes, double weight,
           const Eigen::Matrix<double, 6, 1>* moving = nullptr);
  /// The stress at a column of FactorCourse::fine, or between two; without a course at an instant.
  /// @param by_stress  dD / d stress [1/Pa]
  void add(double place, const Eigen::Matrix<double, 6, 1>& by_stress);
  /// The support by the stress gradient, for all cycles of that weight in sum.
  void add(const SupportSlopes& support, double weight);

  Eigen::VectorXd by_effect() const;
  Eigen::VectorXd by_channel() const;

private:
  void spread(const PlacesAround& around, const PlacesAround::Weights& weights,
              const Eigen::Matrix<double, 6, 1>& by_stress);
  template <typename ByMove>
  void add_move(double place, const Eigen::Matrix<double, 6, 1>& form, const ByMove& by_move);
  Eigen::MatrixXd by_loads() const;

  const UnitStresses& unit_Pa_;
  const ChannelHistory& loads_;
  const FactorCourse* course_;
  Eigen::MatrixXd by_stress_;  // 6 x places
  Eigen::MatrixXd by_load_;    // slopes of the support, channels x instants; empty: none
};

/// The derivative divided by its sum; empty where that is not positive.
std::vector<double> shares_of(const Eigen::VectorXd& derivative);

/// Shares of effects, and of channels where asked for, in the damage of a node's cycles over a period. Empty
/// where nothing changes.
/// @param loads         the loads that `search` has
/// @param with_channels false: the shares of channels stay empty
StressShares shares_in_damage(const Responded& analysis, const ChannelHistory& loads,
                              const FatiguePlaces& search, const FatigueRules& rules, const FatigueNode& node,
                              const CountedNode& counted, bool with_channels);

/// Shares of effects in the damage of a toe's cycles over a period. Empty where nothing changes.
std::vector<double> shares_in_damage(const WeldPlace& place, const ChannelHistory& loads,
                                     const FactorCourse& course, const ToeStress& toe, const SnCurve& curve);

}  // namespace pipelines

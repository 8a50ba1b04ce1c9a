/// What brings the damage over operating blocks, by effect: damage_shares.h for blocks and their starts.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipelines/judge/life/damage_shares.h"
#include "pipelines/judge/life/duty_fatigue.h"

namespace pipelines {

/// The effects of all blocks, in running and in starts, each once.
std::vector<std::string> effects_of_blocks(const std::vector<BlockOnBody>& blocks);

/// Cycles of a place, with what each counts in a second of operation, in the measure of the S-N curve.
struct WeighedCycles {
  std::vector<EndsOfCycle> cycles;
  std::vector<StressBlock> blocks;
};

using SlopesOf = std::function<AmplitudeSlopes(const EndsOfCycle&)>;

/// A place in a block.
struct PlaceInBlock {
  UnitStresses unit_Pa;
  const BlockOnBody& block;
  const FactorCourse& course;  ///< course of the block's running
};

class DutyShares {
public:
  /// @param effects  effects_of_blocks
  explicit DutyShares(std::vector<std::string> effects) : effects_(std::move(effects)) {}
  Eigen::Index n_effects() const { return Eigen::Index(effects_.size()); }

  /// dD/ds of the running.
  /// @param support  FatiguePlaces::support_slopes; none at a weld
  /// @param moving   as in DamageDerivative::add
  Eigen::VectorXd running(const PlaceInBlock& at, const WeighedCycles& weighed, const SlopesOf& slopes_of,
                          const SnCurve& curve, const SupportSlopes& support = {},
                          const Eigen::Matrix<double, 6, 1>* moving = nullptr) const;

  /// dD/ds of what starts do beyond the running in them; zeros where that is nothing.
  /// @param start        ends are columns of the start sequence: the transient, or rest, then
  ///                     FactorCourse::fine
  /// @param its_running  ends are columns of FactorCourse::fine
  /// @param support      slopes of the running's support
  Eigen::VectorXd starting(const PlaceInBlock& at, const WeighedCycles& start,
                           const WeighedCycles& its_running, const SlopesOf& slopes_of, const SnCurve& curve,
                           const SupportSlopes& support = {}) const;

private:
  Eigen::VectorXd on_all(const Eigen::VectorXd& own, const std::vector<std::string>& names) const;

  std::vector<std::string> effects_;
};

}  // namespace pipelines

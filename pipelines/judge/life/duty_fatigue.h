/// Damage of a body over operating blocks and starts, summed by Palmgren and Miner.
///
/// All stresses come from one set of unit responses. A second of operation holds the share of each block, and
/// in it share / period repetitions of the block's cycle and its starts. Cycles of all blocks are counted
/// (rainflow) and go into one S-N curve together: a block above the knee lowers the limit for the others.
///
/// A start is the sequence from rest through its transient into running, counted as one repetition: what it
/// adds to the cycle of running is its damage. So the one large cycle from rest to running and back is in it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipelines/judge/life/body_fatigue.h"

namespace pipelines {

/// One block on one body.
struct BlockOnBody {
  const ChannelHistory* running = nullptr;  ///< over a period, channels of the unit responses
  const NodalMaximum* von_mises = nullptr;  ///< envelope of the running
  const NodalCycles* cycles = nullptr;      ///< cycles of the surface in the running
  LoadPeriod period;
  double share = 0;                               ///< share of the time in operation, (0, 1]
  const ChannelHistory* starting = nullptr;       ///< over one start; null: none, or at once
  double starts_per_s = 0;                        ///< starts in a second of operation
  const NodalMaximum* start_von_mises = nullptr;  ///< largest in a start, about; null: the block has none

  /// Periods in a second of operation.
  double running_per_s() const { return share / period.duration_s; }
};

/// What a block does to a place.
struct BlockDamage {
  double amplitude_Pa = 0;        ///< amplitude of the largest cycle; at weld toes half of the largest range
  double damage_per_s = 0;        ///< damage of running in a second of operation
  double starts_per_s = 0;        ///< damage of starts in a second of operation
  double start_amplitude_Pa = 0;  ///< amplitude of the largest cycle of a start; 0: the block has none
  double sum_per_s() const { return damage_per_s + starts_per_s; }
};

struct DutyPlace {
  std::string feature;  ///< or weld toe
  std::array<double, 3> position_m{};
  bool is_weld = false;
  std::vector<BlockDamage> blocks;    ///< in the order of the scene
  double damage_per_s = 0;            ///< damage of all blocks in a second of operation
  std::optional<double> life_s;       ///< in operation; none: endures
  std::optional<double> life_safety;  ///< safety against the wanted life: factor on all stresses
  double utilisation = 0;  ///< by the largest cycle of the block or start that uses it most; toes: 0
  /// Whole error of the stress (whole_error_share_of_change), the largest of the blocks and starts, with what
  /// the instants leave unresolved, by the damage of the blocks; infinite: not known.
  double error_share = 0;
  LifeCertainty certainty;  ///< certainty of the life
  /// Shares of the damage of all blocks (damage_shares.h), in the order of effects_of_blocks; empty: nothing
  /// changes.
  std::vector<double> effect_share;
};

/// Judges every feature's worst node, and every weld toe; by falling damage, then by rising safety against
/// the wanted life, then by falling utilisation and amplitude. The node is the first by the same order of
/// those that some block uses up most (FatiguePlaces::worst_of), that a start stresses most, or whose largest
/// cycles of all blocks, each counted once a period without support by the gradient, do most damage together.
/// Each block is counted along the direction in which it damages most: the sum is at least that of any one
/// direction.
/// @param analysis  whose scene asks for fatigue
std::vector<DutyPlace> judge_duty(const Judged& analysis, const std::vector<BlockOnBody>& blocks,
                                  int n_threads);

}  // namespace pipelines

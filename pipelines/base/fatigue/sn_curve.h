/// S-N curve with a knee, linear damage, and the factor on all stresses that a wanted life leaves.
///
/// Source: Palmgren (1924), Miner (1945); below the knee Haibach's slope 2 k - 1 (Betriebsfestigkeit, 3rd
/// ed., 3.2.4), which stands for a fatigue limit that falls while damage grows.
#pragma once

#include <optional>
#include <vector>

namespace pipelines {

/// N(A) = N_D (A / A_D)^-k above the knee, N_D (A / A_D)^-k2 below. Amplitudes and ranges serve alike.
struct SnCurve {
  double knee_amplitude_Pa = 0;        ///< A_D
  double knee_cycles = 0;              ///< N_D
  double slope = 0;                    ///< k >= 1
  std::optional<double> second_slope;  ///< k2 >= k; without: amplitudes up to the knee endure for ever
  /// Amplitudes up to the knee endure while none is above it, and count by the slope k beside one that is.
  /// Who makes the curve sets second_slope by the amplitudes at hand; life_factor minds both cases.
  bool endures_together = false;
};

/// @throws std::invalid_argument if the knee is not positive, k is below 1 or k2 below k
void require_sound(const SnCurve& curve);

/// Cycles to failure; empty: the amplitude endures for ever (it is zero, or not above the knee of a curve
/// without second slope; also where the number of cycles leaves the range of numbers).
/// @throws std::invalid_argument by require_sound(curve), or if the amplitude is negative
std::optional<double> cycles_to_failure(const SnCurve& curve, double amplitude_Pa);

/// The amplitude that is endured for so many cycles; from the knee on that of the knee, without second slope.
/// @throws std::invalid_argument by require_sound(curve), or if the cycles are not positive
double endured_amplitude_Pa(const SnCurve& curve, double cycles);

/// Cycles of one amplitude.
struct StressBlock {
  double amplitude_Pa = 0;  ///< at the stress ratio of the curve (means are converted before)
  double count = 0;         ///< >= 0, need not be whole
};

/// Damage D = sum n_i / N_i of one repetition of the blocks; 1 / D repetitions to failure (damage sum 1).
/// @throws std::invalid_argument by require_sound(curve), or if an amplitude or a count is negative or not
/// finite
double miner_damage(const SnCurve& curve, const std::vector<StressBlock>& blocks);

/// The same curve where the blocks have damage by it. Else with its knee at the largest amplitude and one
/// slope: the damage that begins when all amplitudes are raised together.
SnCurve curve_with_damage(SnCurve curve, const std::vector<StressBlock>& blocks);

/// Sum of n_i A_i^k: in proportion to the damage by one slope without a knee (Miner's elementary rule).
double elementary_damage(const std::vector<StressBlock>& blocks, double slope);

/// Largest factor on all amplitudes with which the blocks can be repeated so often: the safety against a
/// wanted life. With it the damage of all repetitions is just the damage sum, or, without second slope, the
/// next larger factor would pass it. Found in closed form between the factors at which an amplitude crosses
/// the knee, with Newton's method where both slopes take part. Empty if nothing damages: no cycles, or no
/// stress.
/// @param repetitions  > 0
/// @param damage_sum   at failure, > 0; 1 after Miner, 0.3 to 0.5 where guidelines ask for it
/// @throws std::invalid_argument as miner_damage, or if repetitions or damage_sum are not positive
std::optional<double> life_factor(const SnCurve& curve, const std::vector<StressBlock>& blocks,
                                  double repetitions, double damage_sum = 1);

}  // namespace pipelines

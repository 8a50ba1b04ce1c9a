/// How well a life by an S-N curve is known, and where it is none.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/base/fatigue/sn_curve.h"

namespace pipelines {

/// Lives that the error of the stress leaves possible.
struct LifeRange {
  std::optional<double> least_s, most_s;  ///< none: endures
};

struct LifeCertainty {
  std::optional<LifeRange> range;  ///< none: the stress is not known to within itself, or `beyond` has a text
  std::string beyond;              ///< why the S-N curve does not hold there; empty: it holds
};

/// Curves of high-cycle fatigue begin here: below, plastic strain decides, which elastic stress does not
/// tell. The usual boundary (Haibach, Betriebsfestigkeit, 3rd ed.; the curves of FKM and IIW are not drawn
/// below).
constexpr double least_cycles_of_curves = 1e4;

/// Lives at all stresses times 1 + error and 1 - error.
/// @param error_share  whole error of the stress; from 1 on nothing is known of a life, and of what
///                     seems to endure the least life alone; infinite: nothing, but that what has no
///                     amplitude endures
/// @param beyond       text of beyond_curve: where there is one there is no range
/// @param life_s       with all stresses times a factor; none: endures
LifeCertainty certainty_of(double error_share, const std::string& beyond,
                           const std::function<std::optional<double>(double)>& life_s);

/// What an error of the stress leaves of a safety, or of another factor on all stresses, at least; none
/// where the error is not known.
std::optional<double> least_safety(double safety, double error_share);

/// The blocks with amplitudes times a factor.
std::vector<StressBlock> scaled(std::vector<StressBlock> blocks, double factor);

/// Why a curve does not hold for such cycles: stress beyond the yield strength, or an amplitude of fewer
/// cycles than least_cycles_of_curves.
/// @param largest_Pa  amplitude and size of the mean together
/// @param blocks      in the curve's own measure
/// @return empty: it holds
std::string beyond_curve(double largest_Pa, double yield_Pa, const SnCurve& curve,
                         const std::vector<StressBlock>& blocks);

/// The factor on all stresses with which a wanted life is reached (life_factor), at most the one that brings
/// the largest cycle to where curves begin: elastic stress tells of no higher one.
/// @param repetitions, damage_sum  as life_factor; none if nothing damages
std::optional<double> life_safety(const SnCurve& curve, const std::vector<StressBlock>& blocks,
                                  double repetitions, double damage_sum = 1);

/// A sentence for the warnings.
/// @param place   the first of so many
/// @param beyond  its LifeCertainty::beyond
std::string warning_beyond_curve(const std::string& body, std::size_t n_places, const std::string& place,
                                 const std::string& beyond);

}  // namespace pipelines

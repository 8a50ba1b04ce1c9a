#include "pipelines/search/cheap_models/section_changes.h"

#include <algorithm>
#include <cmath>

namespace pipelines {
namespace {

/// Ratios of two changes count between a least one, third order (that of the stress of cubic cells), and
/// somewhat less than first order, as beside the end of a load or at a seam.
constexpr double least_ratio = 1.0 / 8, most_ratio = 0.6, safety = 2, hidden_share = 1.0 / 24;

/// From four sections on first order may come to light below third: a ratio that has grown grows on, values
/// that turn back have passed from one to the other, and a change that is small beside the one before is so
/// by chance.
constexpr double small_by_chance = 1.0 / 12, hidden_share_by_chance = 1.0 / 4;

/// How far values are believed.
struct Trust {
  double of_two;              ///< share of the only change that may be missing
  double least_ratio;         ///< of three sections; the first is coarse
  double hidden_share;        ///< of the change before the last, of three sections
  double least_share_of_two;  ///< of the value
};
/// Of the value, of three sections and more: what no cut lowers. Source: a fillet of shaft 11 of the
/// benchmark of harmonics stood still 8e-5 above the truth.
constexpr double least_share = 1e-4;
/// Parts of third and first order of any sizes and one sign are bounded.
constexpr Trust usual{1.75, 0.3, 1.0 / 6, 0.002};
/// An error with parts a of third and b of first order on the first section is bounded on the second one for
/// b / a from -0.7 to 1.2, on the third one from -0.2 to 0.3, above which the ratio exceeds
/// `most_of_third_order`. Where the maximum has moved between two sections their change says less.
constexpr Trust of_fillet{0.5, 1.0 / 6, 1.0 / 20, 0.0015};
constexpr double most_of_third_order = 0.18;
/// With b / a from 0.18, where the ratio exceeds 0.16, more than the least ratio is needed: a fifth up to
/// 0.3.
constexpr double raised_by = 1.25, most_raised = 1.0 / 5;

}  // namespace

double missing_Pa(const std::vector<double>& values_Pa, Surroundings where) {
  const std::size_t n = values_Pa.size();
  const double value_Pa = values_Pa.back();
  if (n < 2) return value_Pa;
  const auto change_Pa = [&](std::size_t back) { return values_Pa[n - back] - values_Pa[n - back - 1]; };
  const Trust own = where == Surroundings::inside_fillet ? of_fillet : usual;
  const double last_Pa = std::abs(change_Pa(1));
  if (n < 3) return std::max(own.of_two * last_Pa, own.least_share_of_two * value_Pa);
  const double before_Pa = std::abs(change_Pa(2));
  double ratio = before_Pa > 0 ? last_Pa / before_Pa : most_ratio;
  const Trust trust = ratio > most_of_third_order ? usual : own;
  double least = std::max(trust.least_ratio, std::min(raised_by * ratio, most_raised)),
         hidden = trust.hidden_share;
  if (n > 3) {
    least = least_ratio;
    hidden = ratio < small_by_chance ? hidden_share_by_chance : hidden_share;
    if (change_Pa(1) * change_Pa(2) < 0)
      ratio = most_ratio;
    else if (ratio * std::abs(change_Pa(3)) > before_Pa)
      ratio *= ratio * std::abs(change_Pa(3)) / before_Pa;
  }
  ratio = std::clamp(ratio, least, most_ratio);
  return std::max({safety * last_Pa * ratio / (1 - ratio), hidden * before_Pa, least_share * value_Pa});
}

}  // namespace pipelines

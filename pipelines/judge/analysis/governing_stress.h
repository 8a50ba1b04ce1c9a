/// The one stress by which a body is judged: that with the least safety of its peak and its weld toes'
/// hot-spot stresses. Terminal, report, picture, summary and envelope.vtu all show it first.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "pipelines/judge/analysis/judged.h"

namespace pipelines {

struct GoverningStress {
  enum class Kind { peak, hot_spot };
  Kind kind = Kind::peak;
  std::string place;                   ///< the feature, or the weld toe
  Place surface = Place::interior;     ///< weld toes lie on free surface
  std::array<double, 3> position_m{};  ///< of a hot spot: the toe
  std::int32_t instant = 0;
  double value_Pa = 0;
  double safety = 0;  ///< yield strength / value
  ErrorBudget errors;

  /// "peak von Mises stress", "hot-spot stress"
  std::string name() const;
  /// Numerical part, relative; 0 where nothing is stressed.
  double relative_error() const { return value_Pa > 0 ? errors.numerical_Pa() / value_Pa : 0; }
};

/// Where a peak and a hot spot have the same value it is the peak.
GoverningStress governing_stress(const Judged& analysis);

/// The errors that governing_stress states.
ErrorBudget& errors_of_governing(Judged& analysis);

/// Error of a zone's peak, all that a finer mesh or a more expensive model lowers: that of the body's peak,
/// which a search may know better, or the zone's own estimate and the share that a cheap model adds to the
/// body's peak. Harmonics on an eccentric segment, and within its diameter of one, add at least what they
/// may be off by in pascals where the largest stress of these is; zones away from the largest stress of
/// their place, as on the other side of a fillet, 2.5 times that.
std::optional<double> error_Pa(const Judged& analysis, const Zone& zone);

/// Error of a place as it is shown: its numerical one, and what a cheap model adds, as of a zone.
double error_Pa(const Judged& analysis, const PlaceStress& place);

/// What the assumptions leave open of a stress at a place of the surface, as a share of it
/// (ErrorBudget::model) and without load patches (load_patch_error_Pa): what is stated of the body's peak, as
/// a share; of a cheap model as of a zone there. 0 where the peak has no such entries.
double model_error_share(const Judged& analysis, const std::string& feature, std::size_t node);

/// The whole error that is stated of the body's peak, as a share of it, at the feature that has the peak; 0
/// elsewhere. Whatever is said of the stress there is known no better.
double stated_error_share(const Judged& analysis, const std::string& feature);

/// The whole error of a hot spot as a share of it: the numerical one, load patches, and what else is stated
/// of the first one's assumptions, as a share.
/// @return infinite where the toe is not judged
double whole_error_share(const Judged& analysis, const HotSpotStress& spot);

/// Numerical error of a hot spot: of the first one all that its error budget has; of others what is known of
/// the place, or else the estimate of this mesh alone.
double error_Pa(const Judged& analysis, const HotSpotStress& spot);

}  // namespace pipelines

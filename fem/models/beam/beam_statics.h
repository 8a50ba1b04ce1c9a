/// Statics of a free shaft: unit loads as forces per length, balanced by its inertia. Internal to fem.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "fem/base/values/unit_load.h"
#include "fem/models/beam/beam_section.h"

namespace fem {

/// A stretch of one segment between neighbouring places where something changes; `points` places from begin
/// to end, evenly spaced.
struct BeamInterval {
  double begin_m = 0, end_m = 0;
  std::size_t segment = 0;
  static constexpr int points = 17;
  double z_m(int i) const { return begin_m + (end_m - begin_m) * i / (points - 1); }
};

/// Force and moment about the origin, from the left end to each point of each interval: a column each.
using WrenchAlong = Eigen::Matrix<double, 6, Eigen::Dynamic>;

class BeamLine {
public:
  /// @param breaks_m  places that must be ends of intervals, beside ends of segments and of loads
  BeamLine(const BeamShaft& shaft, const std::vector<UnitLoad>& loads, std::vector<double> breaks_m);

  const std::vector<BeamInterval>& intervals() const noexcept { return intervals_; }
  const BeamSection& section(std::size_t interval) const { return sections_[intervals_[interval].segment]; }

  /// The column of a point where an interval of this segment begins or ends.
  Eigen::Index column_at(std::size_t segment, double z_m) const;

  /// Sum of all of a load about the origin.
  Wrench6 total(const UnitLoad& load) const;

  /// Internal wrench (action of the part above on the part below, about (0, 0, z)) of the load balanced by
  /// the shaft's inertia.
  WrenchAlong internal(const UnitLoad& load) const;

  /// Motion of the sections (translation at the z axis, rotation) under an internal wrench, without any rigid
  /// part in the mass norm.
  WrenchAlong motion(const WrenchAlong& internal) const;

private:
  /// Integral from the left end to each point.
  /// @param per_length  of an interval and a column
  template <typename PerLength>
  WrenchAlong integral(const PerLength& per_length) const;
  double z_m(std::size_t interval, Eigen::Index column) const;

  WrenchAlong below(const UnitLoad& load) const;
  Wrench6 density(const UnitLoad& load, const BeamInterval& interval, double z_m) const;
  Wrench6 sum(const WrenchAlong& per_length) const;  // over the whole shaft

  const BeamShaft* shaft_;
  std::vector<BeamInterval> intervals_;
  std::vector<BeamSection> sections_;  // by segment
  WrenchAlong mass_columns_;           // 6 x 6 per point, side by side
  Eigen::Matrix<double, 6, 6> mass_;
};

}  // namespace fem

#include "fem/beam/near_loads.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "fem/beam/beam_statics.h"

namespace fem {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double safety = 2.5;  // fem/README.md: random shafts

/// The thinnest of the segments that meet at a place.
std::size_t segment_at(const BeamShaft& shaft, double z_m) {
  const double tiny = 1e-9 * (shaft.segments.back().end_m - shaft.segments.front().begin_m);
  std::optional<std::size_t> thinnest;
  for (std::size_t i = 0; i < shaft.segments.size(); ++i) {
    const auto& s = shaft.segments[i];
    if (z_m > s.begin_m - tiny && z_m < s.end_m + tiny &&
        (!thinnest || s.radius_m < shaft.segments[*thinnest].radius_m))
      thinnest = i;
  }
  if (!thinnest) throw std::invalid_argument("beam: z = " + std::to_string(z_m) + " m is beside the shaft");
  return *thinnest;
}

/// Internal wrenches along a shaft under all of its loads.
class WrenchesUnderLoads {
public:
  WrenchesUnderLoads(const BeamLine& line, const std::vector<UnitLoad>& loads,
                     const std::vector<std::vector<double>>& factors)
      : line_(line), factors_(Index(loads.size()), factors.empty() ? 0 : Index(factors.front().size())) {
    for (std::size_t k = 0; k < loads.size(); ++k) {
      unit_.push_back(line.internal(loads[k]));
      factors_.row(Index(k)) =
          Eigen::Map<const Eigen::RowVectorXd>(factors.at(k).data(), Index(factors[k].size()));
    }
    Eigen::MatrixXd axial(line.intervals().size() * std::size_t(BeamInterval::points), loads.size());
    for (std::size_t k = 0; k < loads.size(); ++k) axial.col(Index(k)) = unit_[k].row(2).transpose();
    axial_N_ = axial * factors_;
  }

  /// 6 x instants, at a column of the line.
  WrenchAlong at(Index column) const {
    WrenchAlong unit(6, Index(unit_.size()));
    for (std::size_t k = 0; k < unit_.size(); ++k) unit.col(Index(k)) = unit_[k].col(column);
    return unit * factors_;
  }

  /// At each instant the largest change of the axial force within a reach of a place, weighed with 1 - x /
  /// reach.
  ArrayXd axial_change_N(Index column, double z_m, double reach_m) const {
    ArrayXd largest_N = ArrayXd::Zero(axial_N_.cols());
    for (std::size_t k = 0; k < line_.intervals().size(); ++k)
      for (int point = 0; point < BeamInterval::points; ++point) {
        const double nearness = 1 - std::abs(line_.intervals()[k].z_m(point) - z_m) / reach_m;
        if (nearness <= 0) continue;
        const auto other = axial_N_.row(Index(k) * BeamInterval::points + point);
        largest_N = largest_N.max(nearness * (other - axial_N_.row(column)).array().abs().transpose());
      }
    return largest_N;
  }

private:
  const BeamLine& line_;
  Eigen::MatrixXd factors_;        // loads x instants
  std::vector<WrenchAlong> unit_;  // of the unit loads
  Eigen::MatrixXd axial_N_;        // columns of the line x instants
};

/// sqrt(3) rim_shear V / A at each instant, in the ratio of the diameter to the lever.
ArrayXd shear_in_short_parts_Pa(const BeamSegment& segment, const BeamSection& section,
                                const WrenchAlong& internal) {
  ArrayXd result(internal.cols());
  for (Index i = 0; i < internal.cols(); ++i) {
    const Wrench6 w = internal.col(i);
    const Eigen::Vector2d& c = section.centroid_m;
    const double shear_N = w.head<2>().norm(), moment_Nm = std::hypot(w[3] - c[1] * w[2], w[4] + c[0] * w[2]);
    const double over_lever = shear_N > 0 ? std::min(1.0, 2 * segment.radius_m * shear_N / moment_Nm) : 0;
    result[i] = std::sqrt(3.0) * section.rim_shear * shear_N / section.area_m2 * over_lever;
  }
  return result;
}

}  // namespace

std::vector<double> near_load_error_Pa(const BeamShaft& shaft, const std::vector<UnitLoad>& loads,
                                       const std::vector<std::vector<double>>& factors,
                                       const std::vector<double>& z_m) {
  if (shaft.segments.empty()) throw std::invalid_argument("beam: needs at least one segment");
  const BeamLine line(shaft, loads, z_m);
  const WrenchesUnderLoads wrenches(line, loads, factors);
  std::vector<double> errors_Pa;
  for (const double z : z_m) {
    const auto i_segment = segment_at(shaft, z);
    const auto& segment = shaft.segments[i_segment];
    const auto section = beam_section(segment, shaft.material.poisson_ratio);
    const auto column = line.column_at(i_segment, z);
    const ArrayXd sum_Pa = wrenches.axial_change_N(column, z, 2 * segment.radius_m) / section.area_m2 +
                           shear_in_short_parts_Pa(segment, section, wrenches.at(column));
    errors_Pa.push_back(safety * (sum_Pa.size() > 0 ? sum_Pa.maxCoeff() : 0));
  }
  return errors_Pa;
}

}  // namespace fem

#include "fem/models/beam/near_loads.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "fem/base/values/constants.h"
#include "fem/equations/loads/surface_loads.h"
#include "fem/models/beam/beam_statics.h"

namespace fem {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double safety = 2.5;  // fem/models/README.md: random shafts

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

const LoadSurface* seat_of(const UnitLoad& load) {
  const auto* surface = surface_of(load);
  return surface != nullptr && surface->kind == LoadSurface::Kind::seat ? surface : nullptr;
}

/// Largest tractions of a unit load on its seat (SurfaceResultant, SeatPressure).
struct UnitTraction {
  double around_Pa = 0, along_Pa = 0, pressure_Pa = 0;
};

UnitTraction unit_traction(const UnitLoad& load, const LoadSurface& seat) {
  const double r = seat.radius_m, b = seat.length_m;
  const double tangential = 1.5 / (2 * pi * r * b);
  const double normal =
      *std::max_element(seat.axial_profile.begin(), seat.axial_profile.end()) / (pi * r * b);
  if (const auto* pressure = std::get_if<SeatPressure>(&load.shape))
    return {0, 0, std::abs(pressure->coefficient) * normal};
  using Component = SurfaceResultant::Component;
  switch (std::get<SurfaceResultant>(load.shape).component) {
    case Component::fx:
    case Component::fy:
      return {0, 0, normal};
    case Component::fz:
      return {0, tangential, 0};
    case Component::mx:
    case Component::my:
      return {0, 0, 6 / (pi * r * b * b)};
    case Component::torque:
      return {tangential / r, 0, 0};
  }
  return {};
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

std::vector<SeatTraction> seat_tractions(const std::vector<UnitLoad>& loads,
                                         const std::vector<std::vector<double>>& factors,
                                         const std::vector<double>& z_m) {
  std::vector<SeatTraction> tractions;
  for (const double z : z_m) {
    SeatTraction at;
    const Index n_instants = factors.empty() ? 0 : Index(factors.front().size());
    ArrayXd around_Pa = ArrayXd::Zero(n_instants), along_Pa = around_Pa, pressure_Pa = around_Pa;
    for (std::size_t k = 0; k < loads.size(); ++k) {
      const auto* seat = seat_of(loads[k]);
      if (seat == nullptr) continue;
      const double from_middle = std::abs(z - seat->centre_m[2]) / seat->length_m;
      const auto size = Eigen::Map<const ArrayXd>(factors[k].data(), n_instants).abs();
      const auto unit = unit_traction(loads[k], *seat);
      const double tapered = std::max(0.0, 1 - from_middle * from_middle);
      around_Pa += tapered * unit.around_Pa * size;
      along_Pa += tapered * unit.along_Pa * size;
      pressure_Pa += std::clamp(2 - 2 * from_middle, 0.0, 1.0) * unit.pressure_Pa * size;
    }
    if (n_instants > 0) {
      at.shear_Pa = (around_Pa.square() + along_Pa.square()).sqrt().maxCoeff();
      at.pressure_Pa = pressure_Pa.maxCoeff();
    }
    tractions.push_back(at);
  }
  return tractions;
}

}  // namespace fem

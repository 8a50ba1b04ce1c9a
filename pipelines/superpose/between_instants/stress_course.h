/// The stress of one place over a cycle, between its instants too: largest cycle and cycles along a
/// direction, with the instants of their ends.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "pipelines/superpose/between_instants/factor_course.h"
#include "pipelines/superpose/envelope/stress_cycle.h"
#include "pipelines/superpose/envelope/stress_shares.h"

namespace pipelines {

/// A direction in the space of stress deviators, of length one in the coordinates whose 2-norm is von Mises
/// stress (deviatoric_coordinates.h).
using DeviatoricDirection = Eigen::Matrix<double, 5, 1>;

/// A counted cycle, by the stresses at its ends.
struct EndsOfCycle {
  double range_Pa = 0;                      ///< along what was counted
  Stress from{}, to{};                      ///< at its ends
  double from_instant = 0, to_instant = 0;  ///< i + share of the step to the next
};

/// The largest cycle, its ends between the instants.
struct CycleBetween {
  StressCycle cycle{};      ///< with the nearest instants
  double from = 0, to = 0;  ///< instants: i + share of the step to the next
};

/// The places around a place between them, and their weights: a value there is that of the polynomial through
/// eight of them.
struct PlacesAround {
  static constexpr Eigen::Index n = 8;
  using Weights = Eigen::Matrix<double, n, 1>;

  explicit PlacesAround(double place);

  /// The i-th of the places, of as many as the period has.
  Eigen::Index wrapped(Eigen::Index i, Eigen::Index n_places) const {
    return ((first + i) % n_places + n_places) % n_places;
  }

  Eigen::Index first;  ///< the weights' places begin here and repeat with the period
  /// Weights of the polynomial and its derivatives, by the step of the places.
  Weights value, slope, curvature;
};

class StressCourse {
public:
  /// @param unit_Pa  unit stresses of the place, a column for each channel
  StressCourse(const UnitStresses& unit_Pa, const FactorCourse& factors);

  /// @param stress_Pa  6 x places of the factors
  static StressCourse at_places(Eigen::ArrayXXd stress_Pa, const FactorCourse& factors);

  /// The course of a series that is known at its instants alone.
  /// @param stress_Pa  6 x instants (xx, yy, zz, xy, yz, xz), at least one
  explicit StressCourse(Eigen::ArrayXXd stress_Pa);

  /// Stress at the places, 6 x places.
  const Eigen::ArrayXXd& stress_Pa() const { return stress_Pa_; }
  /// Stress at n times as many places where the course is smooth; else at the places. 6 x places.
  Eigen::ArrayXXd denser_Pa(Eigen::Index n) const;
  /// Turning points lie between the places, where the polynomial has them.
  bool is_smooth() const { return is_smooth_; }
  /// 5 x places; their distance is the von Mises stress of the difference.
  Eigen::Matrix<double, 5, Eigen::Dynamic> coordinates() const;

  /// No two places differ more, but for the slack. Then each end goes to where it is farthest from the other,
  /// until neither does. Where a second pair is almost as far apart as the first, up to
  /// (pi / places per period)^2 may be missed: 0.4 % with 48.
  CycleBetween largest(double slack = 0) const;

  /// Cycles of a form that is linear in the stress, by rainflow over a period that repeats, each turning
  /// point where the form has it: to 1e-6 of its harmonic with 48 places a period. Ranges that differ by 1e-9
  /// of the largest count as equal.
  /// @param form     weights of the six components
  /// @param refined  false: at the places
  std::vector<EndsOfCycle> cycles_of(const Eigen::Matrix<double, 6, 1>& form, bool refined = true) const;
  /// Cycles of the part of the stress along that direction.
  std::vector<EndsOfCycle> cycles_along(const DeviatoricDirection& direction, bool refined = true) const;

private:
  Stress at(double place) const;
  double instant_of(double place) const;
  double crest_of(const Eigen::ArrayXd& values, Eigen::Index place) const;
  double farthest_near(double place, const Stress& from) const;

  Eigen::ArrayXXd stress_Pa_;
  bool is_smooth_ = false;
  Eigen::Index per_step_ = 1;
};

/// The six weights by which a direction's part of a stress is formed.
Eigen::Matrix<double, 6, 1> form_along(const DeviatoricDirection& direction);

/// The direction of a stress's deviator; zero without one.
DeviatoricDirection direction_of(const Stress& stress);

}  // namespace pipelines

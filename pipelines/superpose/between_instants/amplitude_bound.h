/// Bounds of the stress amplitude at a place, and its course on few rows, for a search among many places.
///
/// The first bound comes from the spectrum of the loads, without a walk over the cycle.
/// The stress is its mean and a sum of lines; in deviatoric coordinates (deviatoric_coordinates.h) each line
/// runs round an ellipse, and its reach along a unit direction d is sqrt(d' E_h d), E_h = p p' + q q' with
/// the parts of its complex amplitude. Along d the stress is never farther from the mean than the sum of
/// these, and by the inequality of Cauchy and Schwarz
///   (sum_h sqrt(d' E_h d))^2 <= d' (sum_h E_h / w_h) d <= largest eigenvalue,  w_h > 0, sum_h w_h = 1.
/// The least of several choices of w is taken: w_h as the longest half axis, which is exact for lines in one
/// direction, as its square, which is exact for lines across each other, and one between them. It asks for
/// five numbers a line, whatever the number of instants.
///
/// Lines of a window that does not close spread, and are never in step: there that bound is half as much
/// again as the amplitude. So a second one looks at every few places and adds how far those between them
/// leave the straight lines that connect them: distances are convex along these.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "pipelines/superpose/between_instants/factor_course.h"
#include "pipelines/superpose/between_instants/stress_course.h"

namespace pipelines {

/// All stresses of a course lie within `radius_Pa` of its mean, as von Mises stress of the difference. So no
/// two differ by more than twice that, which bounds the amplitude.
struct StressBall {
  double radius_Pa = 0;
  double mean_Pa = 0;  ///< von Mises stress of the mean over the cycle
};

/// No two stresses of a course differ by more than twice `amplitude_Pa`.
struct AmplitudeInBall {
  StressBall ball;
  double amplitude_Pa = 0;
};

class AmplitudeBound {
public:
  /// Takes the stresses at all places of the course.
  /// @param size  largest stress that one unit of each channel brings [Pa]
  AmplitudeBound(const FactorCourse& course, const Eigen::ArrayXd& size);

  /// @param unit_Pa  unit stresses of the place, a column for each channel
  StressBall about_mean(const UnitStresses& unit_Pa) const;

  /// Bound from every few of the places. Level 0 asks for a sixteenth of the time of stress_of and its
  /// largest cycle, level 1 for a quarter, and is closer.
  /// @param level  below n_levels
  AmplitudeInBall at_knots(const UnitStresses& unit_Pa, std::size_t level) const;
  static constexpr std::size_t n_levels = 2;

  /// Stress at the places from as few rows as the loads have that do not follow from each other, to 1e-10 of
  /// the largest channel.
  /// @param course  as at the beginning
  StressCourse stress_of(const UnitStresses& unit_Pa, const FactorCourse& course) const;

private:
  /// Rows at every few of the places.
  struct Knots {
    Eigen::MatrixXd rows;      // as rows_, at these places
    Eigen::VectorXd off_line;  // largest distance of each row from straight lines between them
  };
  static Knots knots_of(const Eigen::MatrixXd& rows, Eigen::Index every);
  void take_rows(const Eigen::ArrayXXd& fine, const Eigen::MatrixXd& triangle, const Eigen::VectorXd& scale);

  Eigen::VectorXd mean_;     // mean of each channel
  Eigen::MatrixXcd lines_;   // channels x lines
  Eigen::ArrayXd rest_;      // what mean and lines leave of each channel, at any place
  Eigen::MatrixXd rows_;     // some channels without their means, and ones: rows x places
  Eigen::MatrixXd of_rows_;  // channels x rows
  std::array<Knots, n_levels> knots_;
};

}  // namespace pipelines

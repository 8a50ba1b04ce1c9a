#include "pipelines/superpose/between_instants/amplitude_bound.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>

#include "pipelines/base/common/constants.h"
#include "pipelines/superpose/between_instants/cycle_extremes.h"

namespace pipelines {
namespace {

using Eigen::Index;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

/// Powers of the half axis by which lines are weighed.
constexpr std::array<double, 3> powers = {1, 1.5, 2};

/// Share of the largest channel that rows may leave; nothing beside the slack of searches.
constexpr double same_row = 1e-10;

/// Places that are copied at once.
constexpr Index places_at_once = 4096;

/// Places from knot to knot, by level.
constexpr std::array<Index, AmplitudeBound::n_levels> places_per_knot = {16, 4};
/// Slack as a share of the largest cycle at the knots.
constexpr double slack_at_knots = 1e-4;

/// An eigenvalue in single steps of rounding.
constexpr double rounding = 1e-12;

/// Von Mises stress of each column.
Eigen::VectorXd von_mises_of_columns(const UnitStresses& stress_Pa) {
  return deviatoric_coordinates(stress_Pa).matrix().colwise().norm().transpose();
}

double largest_eigenvalue(const Matrix5& matrix) {
  return Eigen::SelfAdjointEigenSolver<Matrix5>(matrix, Eigen::EigenvaluesOnly).eigenvalues()[4];
}

}  // namespace

AmplitudeBound::AmplitudeBound(const FactorCourse& course, const Eigen::ArrayXd& size)
    : mean_(course.fine().rowwise().mean().matrix()), lines_(course.strongest().matrix()) {
  const auto& fine = course.fine();
  const Index n = fine.cols(), n_channels = fine.rows(), n_lines = lines_.cols();
  Eigen::MatrixXd amplitudes(n_channels, 2 * n_lines);
  amplitudes << lines_.real(), lines_.imag();
  const Eigen::VectorXd scale = (size > 0).select(size, 0).matrix();
  rest_ = Eigen::ArrayXd::Zero(n_channels);
  Eigen::MatrixXd triangle = Eigen::MatrixXd::Zero(n_channels, n_channels);  // R of all places so far
  for (Index first = 0; first < n; first += places_at_once) {
    const Index m = std::min(places_at_once, n - first);
    const Eigen::MatrixXd about_mean = fine.middleCols(first, m).matrix().colwise() - mean_;
    Eigen::MatrixXd waves(2 * n_lines, m);
    for (Index l = 0; l < n_lines; ++l)
      for (Index i = 0; i < m; ++i) {
        const double angle =
            2 * pi * std::fmod(course.orders()[l] * double(first + i), double(n)) / double(n);
        waves(l, i) = std::cos(angle);
        waves(n_lines + l, i) = -std::sin(angle);
      }
    rest_ = rest_.max((about_mean - amplitudes * waves).array().abs().rowwise().maxCoeff());
    Eigen::MatrixXd stacked(n_channels + m, n_channels);
    stacked << triangle, about_mean.transpose() * scale.asDiagonal();
    triangle = Eigen::HouseholderQR<Eigen::MatrixXd>(stacked).matrixQR().topRows(n_channels);
    triangle.triangularView<Eigen::StrictlyLower>().setZero();
  }
  take_rows(fine, triangle, scale);
  for (std::size_t level = 0; level < n_levels; ++level)
    knots_[level] = knots_of(rows_, places_per_knot[level]);
}

AmplitudeBound::Knots AmplitudeBound::knots_of(const Eigen::MatrixXd& rows, Index every) {
  const Index last = rows.cols() - 1, n = (last + every - 1) / every + 1;
  Knots knots{Eigen::MatrixXd(rows.rows(), n), Eigen::VectorXd::Zero(rows.rows())};
  for (Index i = 0; i < n; ++i) knots.rows.col(i) = rows.col(std::min(i * every, last));
  for (Index i = 0; i + 1 < n; ++i) {
    const Index first = i * every, width = std::min(every, last - first);
    for (Index j = 1; j < width; ++j) {
      const double share = double(j) / double(width);
      const Eigen::VectorXd on_line = (1 - share) * knots.rows.col(i) + share * knots.rows.col(i + 1);
      knots.off_line = knots.off_line.cwiseMax((rows.col(first + j) - on_line).cwiseAbs());
    }
  }
  return knots;
}

/// Channels by pivots, the others as sums of these.
void AmplitudeBound::take_rows(const Eigen::ArrayXXd& fine, const Eigen::MatrixXd& triangle,
                               const Eigen::VectorXd& scale) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> reduced(triangle);
  reduced.setThreshold(same_row);
  const Index n_channels = fine.rows(), rank = reduced.rank();
  const auto& pivots = reduced.colsPermutation().indices();
  const Eigen::MatrixXd sums = reduced.matrixR()
                                   .topLeftCorner(rank, rank)
                                   .triangularView<Eigen::Upper>()
                                   .solve(reduced.matrixR().topRightCorner(rank, n_channels - rank));
  rows_.resize(rank + 1, fine.cols());
  of_rows_ = Eigen::MatrixXd::Zero(n_channels, rank + 1);
  for (Index row = 0; row < rank; ++row) {
    const Index own = pivots[row];
    rows_.row(row) = (fine.row(own) - mean_[own]).matrix();
    of_rows_(own, row) = 1;
    for (Index i = rank; i < n_channels; ++i)
      if (const Index other = pivots[i]; scale[other] > 0)
        of_rows_(other, row) = sums(row, i - rank) * scale[own] / scale[other];
  }
  rows_.row(rank).setOnes();
  of_rows_.col(rank) = mean_;
}

StressBall AmplitudeBound::about_mean(const UnitStresses& unit_Pa) const {
  const Eigen::Matrix<double, 5, Eigen::Dynamic> unit = deviatoric_coordinates(unit_Pa).matrix();
  StressBall ball;
  ball.mean_Pa = (unit * mean_).norm();
  const Eigen::Matrix<double, 5, Eigen::Dynamic> p = unit * lines_.real(), q = unit * lines_.imag();
  Eigen::ArrayXd axes(lines_.cols());
  for (Index l = 0; l < lines_.cols(); ++l) {
    const double pp = p.col(l).squaredNorm(), qq = q.col(l).squaredNorm(), pq = p.col(l).dot(q.col(l));
    axes[l] = std::sqrt((pp + qq + std::hypot(pp - qq, 2 * pq)) / 2);
  }
  const double largest = axes.size() > 0 ? axes.maxCoeff() : 0;
  if (largest > 0) {
    double least = std::numeric_limits<double>::infinity();
    for (const double power : powers) {
      const Eigen::ArrayXd shares = (axes / largest).pow(power);
      Matrix5 sum = Matrix5::Zero();
      for (Index l = 0; l < lines_.cols(); ++l)
        if (shares[l] > 0)
          sum += (p.col(l) * p.col(l).transpose() + q.col(l) * q.col(l).transpose()) / shares[l];
      least = std::min(least, largest_eigenvalue(sum) * shares.sum());
    }
    ball.radius_Pa = std::sqrt(least) * (1 + rounding);
  }
  ball.radius_Pa += unit.colwise().norm().dot(rest_.matrix());
  return ball;
}

AmplitudeInBall AmplitudeBound::at_knots(const UnitStresses& unit_Pa, std::size_t level) const {
  const Index n_rows = rows_.rows() - 1;  // the last one is the mean
  const auto& knots = knots_[level];
  const UnitStresses of_rows = unit_Pa * of_rows_.leftCols(n_rows);
  const double off_line_Pa = von_mises_of_columns(of_rows).dot(knots.off_line.head(n_rows));
  const Eigen::ArrayXXd about_mean = (of_rows * knots.rows.topRows(n_rows)).array();
  AmplitudeInBall result;
  result.ball.mean_Pa = von_mises_of_columns(unit_Pa * mean_)[0];
  result.ball.radius_Pa = von_mises_of_columns(about_mean.matrix()).maxCoeff() + off_line_Pa;
  const double at_knots_Pa =
      largest_cycle(about_mean, slack_at_knots).amplitude_Pa * (1 + 2 * slack_at_knots);
  result.amplitude_Pa = std::min(at_knots_Pa + off_line_Pa, result.ball.radius_Pa);
  return result;
}

StressCourse AmplitudeBound::stress_of(const UnitStresses& unit_Pa, const FactorCourse& course) const {
  const UnitStresses of_rows = unit_Pa * of_rows_;
  return StressCourse::at_places((of_rows * rows_).array(), course);
}

}  // namespace pipelines
